"""Builds a firmware image with seeded faults in its drivers, and runs this image on the virtual
K64."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

from tests.python.firmware.contents import BUILD, ROOT

BOARD = ROOT / "build" / "host" / "sim" / "weeding_robot_board"
FOUND = 4  # exit code of the board program if the run ends with a finding
SOURCES = ROOT / "src" / "k64"

# A drive of two seconds, in which the robot sends reports and receives orders.
DRIVE = """\
at 300 connect
from 640 to 1940 every 100 order velocity 300 steering 150
at 1950 expect state Working
at 1950 expect set_point0 300
at 2000 end
"""


@dataclass(frozen=True)
class Change:
    """A text in a source file of src/k64, and the text that replaces it."""

    file: str
    before: str
    after: str


@dataclass(frozen=True)
class Run:
    code: int
    finding: str  # id of the finding, or empty
    text: str


@dataclass(frozen=True)
class Program:
    """The commands that build the firmware image again after a change of a driver. Only the changed
    driver is compiled, because the drivers are not optimised at link time."""

    compiled: dict[str, list[str]]  # source of src/k64 -> the command that compiles it
    link: list[str]

    def seeded(self, folder: Path, changes: tuple[Change, ...]) -> Path:
        """Compiles copies of the changed sources, and links them with the other objects.

        Returns the name of the firmware image without its suffix.
        """
        link = list(self.link)
        for file in {change.file for change in changes}:
            source = folder / file
            source.parent.mkdir(exist_ok=True)
            source.write_text(changed(file, changes), encoding="utf-8")
            words = list(self.compiled[file])
            original = words[words.index("-o") + 1]
            words[words.index("-c") + 1] = str(source)
            # With this option, findings show the source line of the original file.
            prefix = f"-ffile-prefix-map={folder}=src/k64"
            made = compiled_to(source.with_suffix(".obj"), [*words, prefix])
            link[link.index(original)] = made
        image = folder / "weeding_robot_paper"
        linked_to(f"{image}.elf", link)
        words = ["arm-none-eabi-objcopy", "-O", "binary", f"{image}.elf", f"{image}.bin"]
        subprocess.run(words, check=True, timeout=60)
        return image


def link_once(folder: Path) -> Program:
    """Compiles the drivers without optimisation at link time. Optimises all other parts of the
    firmware at link time. This optimisation runs only once, for all changes of drivers."""
    link = link_command()
    compiled = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        source, words = Path(entry["file"]), [*shlex.split(entry["command"]), "-fno-lto"]
        original = words[words.index("-o") + 1]
        if SOURCES in source.parents and original in link:
            made = compiled_to(folder / f"{source.name}.obj", words)
            link[link.index(original)] = made
            words[words.index("-o") + 1] = made
            compiled[str(source.relative_to(SOURCES))] = words
    # -g0 omits the debug information, because this information would refer to intermediate files
    # of the compiler.
    linked_to(f"{folder / 'all'}.elf", [*link, "-g0", "-save-temps"])
    (optimised,) = folder.glob("all.elf.*.ltrans.o")
    link.insert(link.index("-o"), str(optimised))  # This object must be before the libraries.
    others = [word for word in link if not word.startswith("-flto")]
    return Program(compiled, [*others, "-fno-use-linker-plugin"])


def compiled_to(target: Path, words: list[str]) -> str:
    """Runs a compile command of the build with a different output file. Returns the path of this
    file."""
    words = list(words)
    words[words.index("-o") + 1] = str(target)
    subprocess.run(words, check=True, cwd=BUILD, timeout=60)
    return str(target)


def linked_to(target: str, words: list[str]) -> None:
    """Runs the link command of the build with a different output file."""
    words = list(words)
    words[words.index("-o") + 1] = target
    subprocess.run(words, check=True, cwd=BUILD, timeout=60)


def changed(file: str, changes: tuple[Change, ...]) -> str:
    text = (SOURCES / file).read_text(encoding="utf-8")
    for change in changes:
        if change.file == file:
            assert text.count(change.before) == 1, (
                f"{file} must contain this text exactly once: {change.before}"
            )
            text = text.replace(change.before, change.after)
    return text


def link_command() -> list[str]:
    """Returns the command that links the firmware image. The command writes no map file."""
    ninja = ["ninja", "-C", str(BUILD), "-t", "commands", "weeding_robot_paper.elf"]
    done = subprocess.run(ninja, check=True, capture_output=True, text=True, timeout=60)
    line = done.stdout.splitlines()[-1].removeprefix(": && ")
    words = shlex.split(line[: line.index(" && ")])
    # With this option, the compiler would write intermediate files into the folder of the build.
    place = words.index("-dumpdir")
    del words[place : place + 2]
    return [word for word in words if not word.startswith("-Wl,-Map=")]


def driven(image: Path, folder: Path) -> Run:
    """Runs a firmware image for two seconds of the robot's time. The name of the image is given
    without its suffix."""
    scenario = folder / "drive.scenario"
    scenario.write_text(DRIVE, encoding="utf-8")
    words: list[str | Path] = [BOARD, "--image", f"{image}.bin", "--elf", f"{image}.elf"]
    words += ["--scenario", scenario]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    text = done.stdout + done.stderr
    found = re.search(r"^finding: ([a-z-]+): .*$", text, re.MULTILINE)
    return Run(done.returncode, found[1] if found else "", found[0] if found else text.strip())
