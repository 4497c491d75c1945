"""Runs Doxygen, and reports its warnings as findings. Doxygen writes XML files, from which Breathe
generates the pages of the members."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.comments import SUFFIXES
from traceability.schema import Place
from traceability.sources import DESIGN, files_below, hash_of
from traceability.whole_file import write_whole

INPUTS = (*DESIGN, "sim/host", "tests", "requirements")
DOXYFILE = Path("traceability/doxygen/Doxyfile")
# Warnings with these words are ignored, because the reader of comments checks the ids of
# requirements and the names of tags.
NOT_OURS = re.compile(r"[Rr]equirement|satisfies|verifies|Found unknown command")


def doxygen_executable() -> str:
    """Returns the path of the Doxygen program. The program in the folder of the running Python is
    preferred to the program on PATH."""
    installed = Path(sys.executable).parent / "doxygen"
    return str(installed) if installed.exists() else (shutil.which("doxygen") or "doxygen")


@dataclass
class DoxygenRun:
    """A run of Doxygen in the background. If no input changed, the recorded output is still valid,
    and ``process`` is None."""

    root: Path
    xml: Path
    record: Path  # file with the output of Doxygen, and with the hash of the inputs
    state: str
    process: subprocess.Popen[bytes] | None = None

    def warnings(self) -> list[tuple[Place, str]]:
        """Waits until the run ends. Returns the warnings of this run, or of the recorded run if no
        input changed."""
        if self.process is not None:
            output = self.process.communicate()[1].decode()
            code, self.process = self.process.returncode, None
            if code != 0 or not self.xml.is_dir():
                raise RuntimeError(f"Doxygen failed with exit code {code}:\n{output[-2000:]}")
            record = {"state": self.state, "output": output.splitlines()}
            write_whole(self.record, json.dumps(record))
        lines = json.loads(self.record.read_text(encoding="utf-8"))["output"]
        return list(_warnings(self.root, lines))

    def stop(self) -> None:
        """Stops Doxygen if it still runs. The result is then lost."""
        if self.process is not None and self.process.poll() is None:
            self.process.kill()
            self.process.wait()


@contextmanager
def doxygen_beside(root: Path, build: Path) -> Iterator[DoxygenRun]:
    """Starts Doxygen in the background. Stops it at the end of the `with` block if it still
    runs."""
    run = start_doxygen(root, build)
    try:
        yield run
    finally:
        run.stop()


def start_doxygen(root: Path, build: Path) -> DoxygenRun:
    """Starts Doxygen if an input changed since the recorded run."""
    xml, record = build / "xml", build / "doxygen.json"
    doxyfile = root / DOXYFILE
    if not doxyfile.exists():
        doxyfile = Path(__file__).parents[2] / DOXYFILE
    settings = doxyfile.read_text(encoding="utf-8")
    inputs = [
        path
        for path in files_below(root, INPUTS, SUFFIXES)
        if root / "tests" / "python" not in path.parents
    ]
    run = DoxygenRun(root, xml, record, hash_of(root, inputs) + settings)
    last = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
    if xml.is_dir() and last.get("state") == run.state:
        return run
    # The record is removed before the run. If the run is interrupted, the incomplete folder then
    # has no valid record.
    record.unlink(missing_ok=True)
    shutil.rmtree(xml, ignore_errors=True)
    build.mkdir(parents=True, exist_ok=True)
    folders = " ".join(name for name in INPUTS if (root / name).exists())
    whole = build / "Doxyfile"
    whole.write_text(
        f'{settings}\nINPUT = {folders}\nEXCLUDE = tests/python\nOUTPUT_DIRECTORY = "{build}"\n',
        encoding="utf-8",
    )
    run.process = subprocess.Popen(
        [doxygen_executable(), str(whole)],
        cwd=root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env={**os.environ, "LC_ALL": "C.UTF-8"},
    )
    return run


def _warnings(root: Path, lines: list[str]) -> Iterator[tuple[Place, str]]:
    """Yields each warning with its place. Indented lines below a warning belong to its text."""
    for line in re.sub(r"\n +", " ", "\n".join(lines)).splitlines():
        match = re.match(r"(.+?):(\d+): (?:warning|error): (.*)", line)
        if match is not None and not NOT_OURS.search(match[3]):
            yield Place(match[1].removeprefix(f"{root}/"), int(match[2])), match[3]
