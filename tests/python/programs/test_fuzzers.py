"""The fuzzer of short inputs finds faults that are seeded in the firmware."""

from __future__ import annotations

import json
import shlex
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from tools.campaign.fuzz_program import fuzz

ROOT = Path(__file__).parents[3]
BUILD = ROOT / "build" / "fuzz"
FUZZER = BUILD / "tests/fuzz/fuzz_frames"
INPUTS = 200_000  # number of inputs of a run; a run needs at most 10 s of processor time


@dataclass(frozen=True)
class Fault:
    """A seeded fault, and the rule that the firmware then breaks."""

    name: str
    file: str
    find: str
    put: str
    rule: str


FAULTS = [
    Fault(
        "an unchecked length of the payload",
        "src/communication/pc_connection/PcConnection.cpp",
        "frame.payload.size() < *length",
        "frame.payload.size() + 1 < *length",
        "the counts of dropped frames agree with the protocol",
    ),
    Fault(
        "an unchecked length of the frame",
        "src/communication/framing/FrameDecoder.cpp",
        "tooLong_ = true;",
        "tooLong_ = false;",
        "the counts of dropped frames agree with the protocol",
    ),
    Fault(
        "a stop that is lost while no PC is connected",
        "src/communication/pc_connection/PcConnection.cpp",
        "  orders_.heedStop(",
        "  if (connected()) orders_.heedStop(",
        "a stop is in force as the protocol demands",
    ),
    Fault(
        "a recorded frame of the signed line that is accepted again",
        "extensions/bluetooth/SignedPort.cpp",
        "*counter <= lastReceived_",
        "*counter < lastReceived_",
        "the counts of dropped frames|each dropped frame of the signed line",
    ),
]


@pytest.fixture(scope="module", autouse=True)
def built(build: Callable[..., None]) -> None:
    compiler = shutil.which("clang++-19")
    if compiler is None:
        pytest.skip("this system has no clang-19, an optional package")
    words = [compiler, "--rtlib=compiler-rt", "-print-libgcc-file-name"]
    runtime = subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    if not list(Path(runtime).parent.glob("libclang_rt.fuzzer*")):
        pytest.skip("this system has no libclang-rt-19-dev, an optional package")
    build("fuzz", "fuzz_frames")


def faulty(fault: Fault, folder: Path) -> Path:
    """Links the fuzzer with a copy of one file. The copy contains the fault."""
    source = ROOT / fault.file
    text = source.read_text(encoding="utf-8")
    assert text.count(fault.find) == 1
    changed = folder / source.name
    changed.write_text(text.replace(fault.find, fault.put), encoding="utf-8")
    commands = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    # The files of an extension are compiled twice: for the fuzzer, and for the library of the
    # extension. ``part`` selects the command for the fuzzer.
    part = "fuzz_frames.dir" if fault.file.startswith("extensions/") else ""
    (command,) = (
        one["command"] for one in commands if one["file"] == str(source) and part in one["command"]
    )
    words = shlex.split(command)
    (own,) = (n for n, word in enumerate(words) if word == "-o")
    replaced, changed_object = words[own + 1], folder / "changed.o"
    words[own + 1], words[-1] = str(changed_object), str(changed)
    subprocess.run(words, cwd=BUILD, check=True)
    listed = subprocess.run(
        ["ninja", "-C", str(BUILD), "-t", "commands", "-s", "tests/fuzz/fuzz_frames"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    link = shlex.split(listed.strip().splitlines()[-1].removeprefix(": && ").removesuffix(" && :"))
    program = folder / "fuzzer"
    link[link.index("-o") + 1] = str(program)
    if replaced in link:
        link[link.index(replaced)] = str(changed_object)
    else:
        # The linker uses this object file instead of the object file of the same name in a library.
        link.insert(link.index("-o"), str(changed_object))
    subprocess.run(link, cwd=BUILD, check=True)
    return program


@pytest.mark.long
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_seeded_fault_is_found(tmp_path: Path, fault: Fault) -> None:
    result = fuzz(faulty(fault, tmp_path), "frames", 1, INPUTS)
    assert result["failure"] is not None
    assert any(rule in result["failure"]["text"] for rule in fault.rule.split("|"))


@pytest.mark.long
def test_the_firmware_without_a_fault_passes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    result = fuzz(FUZZER, "frames", 1, INPUTS // 10)
    assert result == {"fuzzer": "frames", "inputs": INPUTS // 10, "failure": None}
