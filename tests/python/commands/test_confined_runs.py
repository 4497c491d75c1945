"""./wr on a full disk, in a folder that cannot be written, without a network, without the rights of
root, with an old Python, during another set-up, and in a path with blanks.

A run that fails ends with a message. After a full disk, the next run succeeds.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.commands.confined import (
    read_only,
    with_disk,
    with_program,
    without_network,
    without_rights,
)
from tests.python.commands.small_command import RESULT, expected, write_sources
from tests.python.commands.test_killed_runs import COMMAND
from tools.cmake_build import sources_of
from tools.lock import HOLDER
from traceability.reading.result_cache import cached_result
from weeding_robot_client.exit_codes import MISSING

pytestmark = pytest.mark.runs_tools

SOURCE = Path(__file__).resolve().parents[3]
LOCK = "no-such-package==1 --hash=sha256:" + 64 * "0" + "\n"


def run(words: list[str], **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name != HOLDER}
    return subprocess.run(
        words,
        capture_output=True,
        text=True,
        check=False,
        cwd=SOURCE,
        env=environment | variables,
        stdin=subprocess.DEVNULL,
        timeout=120,
    )


def command(root: Path) -> list[str | Path]:
    return [sys.executable, "-c", COMMAND, root]


@pytest.fixture
def copy() -> Iterator[Path]:
    """Returns a folder with a copy of ./wr and without Python packages. Each user can read this
    folder. Its name contains a blank.
    """
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder) / "a copy"
        (root / "setup").mkdir(parents=True)
        shutil.copy(SOURCE / "wr", root / "wr")
        (root / "setup/python.lock").write_text(LOCK)
        for path in (Path(folder), root, root / "setup"):
            path.chmod(0o755)
        yield root


# ---- a full disk -----------------------------------------------------------------


@pytest.mark.parametrize("size", ["4k", "8k", "12k", "16k", "20k", "24k", "28k"])
def test_a_full_disk_is_named_and_the_run_after_it_is_right(tmp_path: Path, size: str) -> None:
    """The small disk is mounted at the folder build. The sources are not on this disk."""
    write_sources(tmp_path, "text")
    (tmp_path / "build").mkdir()
    keep = tmp_path / "kept"
    script = '"$@"; code=$?; cp -a build/. "$KEPT" 2>/dev/null; exit $code'
    words = ["sh", "-c", f"cd {tmp_path}; {script}", "sh", *command(tmp_path)]
    keep.mkdir()
    full = run(with_disk(tmp_path / "build", size, words), KEPT=str(keep), PYTHONPATH=str(SOURCE))
    assert "Traceback" not in full.stdout + full.stderr
    assert full.returncode in (1, MISSING)
    assert "No space left on device" in full.stdout + full.stderr
    (tmp_path / "build").rmdir()
    # The files of the full disk were copied. Their copy becomes the folder build.
    keep.rename(tmp_path / "build")
    assert run([*map(str, command(tmp_path))]).returncode == 0
    assert (tmp_path / RESULT).read_text() == expected(tmp_path)


CACHE = """
import sys
from pathlib import Path
from traceability.reading.result_cache import cached_result
print(cached_result(Path(sys.argv[1]), [1], lambda: ["text" * 1000]))
"""


def test_a_cache_that_could_not_be_written_whole_is_not_read(tmp_path: Path) -> None:
    cache = tmp_path / "disk"
    cache.mkdir()
    words: list[str | Path] = [sys.executable, "-c", CACHE, cache / "cache"]
    with_copy = ["sh", "-c", f'"$@"; cp {cache}/* {tmp_path}', "sh", *words]
    full = run(with_disk(cache, "4k", [*with_copy]))
    assert "No space left on device" in full.stderr
    assert cached_result(tmp_path / "cache", [1], lambda: ["new"]) == ["new"]


# ---- a folder that cannot be written ---------------------------------------------


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    write_sources(tmp_path, "text")
    done = run(read_only(tmp_path, command(tmp_path)))
    assert done.returncode == MISSING
    assert done.stderr == (
        f"cannot write {tmp_path}/build: Read-only file system; "
        "make it writable, or copy the project to a folder that is writable\n"
    )


def test_the_real_command_names_the_folder_that_it_cannot_write() -> None:
    done = run(read_only(SOURCE, [SOURCE / "wr", "check"]), WR_HAS_PACKAGES="1")
    assert done.returncode == MISSING
    assert done.stderr.startswith(f"wr check: cannot write {SOURCE}/build/lock: Read-only")


def test_set_up_of_a_user_without_rights_names_the_folder(copy: Path) -> None:
    done = run(without_rights([copy / "wr", "setup"]), WR_HAS_PACKAGES="1")
    if os.geteuid() == 0:
        assert done.returncode == MISSING
        assert done.stderr == (
            f"wr: {copy} cannot be written. Copy the project to a folder that you may write.\n"
        )


# ---- no network ------------------------------------------------------------------


def test_after_set_up_no_network_is_needed(tmp_path: Path) -> None:
    """All packages are installed. Therefore neither the set-up nor the tasks need a network."""
    write_sources(tmp_path, "text")
    for words in ([SOURCE / "wr", "setup"], command(tmp_path)):
        done = run(without_network(words))
        assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / RESULT).read_text() == expected(tmp_path)


def test_set_up_without_network_says_so_and_begins_anew(copy: Path) -> None:
    for _ in range(2):
        done = run(without_network([copy / "wr", "setup"]), WR_HAS_PACKAGES="1", PIP_RETRIES="0")
        assert done.returncode == MISSING
        assert done.stderr.splitlines()[-1] == (
            "wr: the Python packages are not installed. Check the network and the space on the "
            "disk, then run the command again."
        )
        assert not (copy / ".venv/stamp").exists()


# ---- an old Python ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ('[ "$1" = -c ]', "wr: python3 made no folder .venv. "),
        ("echo Python 3.9.2; exit 1", "wr: Python 3.11 or newer is needed; this computer has "),
    ],
)
def test_only_a_newer_python_of_the_path_is_used(copy: Path, answer: str, message: str) -> None:
    """The program /usr/bin/python3 is too old. The program python3 in PATH is new enough in the
    first case, and too old in the second case."""
    tools = copy / "tools"
    tools.mkdir()
    (copy / "old").write_text("#!/bin/sh\nexit 1\n")
    (tools / "python3").write_text(f"#!/bin/sh\n{answer}\n")
    for path in (copy / "old", tools / "python3"):
        path.chmod(0o755)
    done = run(
        with_program("/usr/bin/python3", copy / "old", [copy / "wr", "setup"]),
        WR_HAS_PACKAGES="1",
        PATH=f"{tools}:{os.environ['PATH']}",
    )
    assert done.returncode == MISSING
    assert done.stderr.startswith(message)


# ---- two set-ups at once, and a set-up after a killed set-up -------------------------


def test_a_set_up_waits_for_another_and_does_not_repeat_it(copy: Path) -> None:
    """While the first set-up has the lock, it makes .venv/bin/python and the stamp."""
    (copy / ".venv/bin").mkdir(parents=True)
    begin = "exec 9>>.venv/lock; flock 9; echo begun; read -r _; ln -s /bin/true .venv/bin/python"
    stamp = 'printf "%s\\n" "$(sha256sum <setup/python.lock) $PWD" >.venv/stamp'
    first = subprocess.Popen(
        ["sh", "-c", f"{begin}; {stamp}"],
        cwd=copy,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert first.stdout is not None and first.stdin is not None
    assert first.stdout.readline() == "begun\n"
    environment = {**os.environ, "WR_HAS_PACKAGES": "1"}
    second = subprocess.Popen(
        [copy / "wr", "setup"], stdout=subprocess.PIPE, text=True, env=environment
    )
    assert second.stdout is not None
    assert "waits for another command" in second.stdout.readline()
    first.stdin.write("go\n")
    first.stdin.close()
    assert (first.wait(60), second.wait(60)) == (0, 0)
    assert second.stdout.read() == ""


def test_an_interrupted_set_up_is_never_taken_for_a_whole_one(copy: Path) -> None:
    """The folder of the packages has the stamp of another lock file. The set-up therefore removes
    these packages first. During this removal, the test kills the set-up."""
    (copy / ".venv/bin").mkdir(parents=True)
    (copy / ".venv/stamp").write_text("of another lock file\n")
    tools = copy / "tools"
    tools.mkdir()
    (tools / "find").write_text("#!/bin/sh\nkill -KILL $PPID\n")
    (tools / "find").chmod(0o755)
    done = run(
        [str(copy / "wr"), "setup"],
        WR_HAS_PACKAGES="1",
        PATH=f"{tools}:{os.environ['PATH']}",
    )
    assert done.returncode == -9
    assert not (copy / ".venv/stamp").exists()


# ---- a path with blanks ----------------------------------------------------------


def test_the_sources_of_a_program_are_found_below_a_path_with_blanks(tmp_path: Path) -> None:
    root = tmp_path / "a path with blanks"
    (root / "src").mkdir(parents=True)
    (root / "src/main.cpp").write_text("int main() {}\n")
    (root / "src/table.txt").write_text("1\n")
    (root / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(small CXX)\n"
        "add_custom_command(OUTPUT table.hpp DEPENDS ${CMAKE_SOURCE_DIR}/src/table.txt\n"
        "  COMMAND cp ${CMAKE_SOURCE_DIR}/src/table.txt table.hpp VERBATIM)\n"
        "add_executable(small src/main.cpp table.hpp)\n"
    )
    for words in (
        ["-G", "Ninja", "-S", root, "-B", root / "build/host"],
        ["--build", root / "build/host"],
    ):
        subprocess.run(["cmake", *words], check=True, stdout=subprocess.DEVNULL)
    assert sources_of(root, "host", "small") == ["CMakeLists.txt", "src/main.cpp", "src/table.txt"]


def test_a_command_runs_below_a_path_with_blanks(tmp_path: Path) -> None:
    root = tmp_path / "a path with blanks"
    write_sources(root, "text")
    done = run([*map(str, command(root))])
    assert (done.returncode, done.stderr) == (0, "")
    assert (root / RESULT).read_text() == expected(root)
