"""./wr flash: the ways to a board, and images that are not written."""

import contextlib
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

import pytest

from tools import cli, flash, usb_drive
from tools.image import WANTED, lock_problems
from tools.task_graph import Graph, Task
from tools.tasks import K64_FIRMWARE

CODE = bytes(0x400) + WANTED + bytes(100)


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine without tools, probes or drives: all that PATH holds is this folder."""
    folder = tmp_path / "tools"
    folder.mkdir()
    (tmp_path / "usb").mkdir()
    (tmp_path / "mounts").touch()
    (tmp_path / "image.bin").write_bytes(CODE)
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setattr(flash, "USB", tmp_path / "usb")
    monkeypatch.setattr(usb_drive, "MOUNTS", tmp_path / "mounts")
    monkeypatch.setattr(usb_drive, "GOES_WITHIN", 0.3)
    monkeypatch.setattr(usb_drive, "COMES_WITHIN", 0.3)
    monkeypatch.setattr(usb_drive, "LOOK", 0.01)
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    return folder


def add_tool(tools: Path, name: str, end: str = "exit 0") -> None:
    """A tool that notes its words, one a line."""
    program = tools / name
    program.write_text(f'#!/bin/sh\nprintf "%s\\n" {name} "$@" >"{tools.parent}/called"\n{end}\n')
    program.chmod(0o755)


def add_pyocd(tools: Path, read_back: str = "flashed") -> None:
    """A pyOCD that notes its words of ``flash``; what it reads back is what it wrote, or a file."""
    folder = tools.parent
    program = tools / "pyocd"
    program.write_text(
        "#!/bin/sh\n"
        'for word; do case "$word" in "savemem "*)'
        f' exec /bin/cp "{folder}/{read_back}" "${{word##* }}";; esac; done\n'
        f'/bin/cp "$word" "{folder}/flashed"\n'
        f'printf "%s\\n" pyocd "$@" >"{folder}/called"\n'
    )
    program.chmod(0o755)


def add_probe(tools: Path, vendor: str = "0d28", product: str = "DAPLink CMSIS-DAP") -> None:
    device = tools.parent / "usb" / "1-2"
    device.mkdir()
    (device / "idVendor").write_text(f"{vendor}\n")
    (device / "product").write_text(f"{product}\n")


def add_drive(tools: Path, name: str = "DAPLINK", mode: str = "Interface") -> Path:
    """A mounted drive as that of the board."""
    drive = tools.parent / name
    drive.mkdir()
    (drive / "DETAILS.TXT").write_text(f"# DAPLink Firmware\nDaplink Mode: {mode}\n")
    place = str(drive).replace(" ", r"\040")
    with (tools.parent / "mounts").open("a") as mounts:
        mounts.write(f"/dev/sdb {place} vfat rw,relatime 0 0\n")
    return drive


@contextlib.contextmanager
def board(drive: Path, failure: str = "", comes: bool = True) -> Iterator[None]:
    """A debug probe that takes what is copied: its drive goes, and comes with the outcome."""
    end = threading.Event()

    def take() -> None:
        while not (image := drive / "image.bin").exists() or image.read_bytes() != CODE:
            if end.wait(0.005):
                return
        gone = drive.rename(drive.with_name("gone"))
        time.sleep(0.05)
        (gone / "image.bin").rename(drive.with_name("written"))
        (gone / "FAIL.TXT").unlink(missing_ok=True)
        if failure:
            (gone / "FAIL.TXT").write_text(failure)
        if comes:
            gone.rename(drive)

    thread = threading.Thread(target=take)
    thread.start()
    try:
        yield
    finally:
        end.set()
        thread.join()


def run(tools: Path, *options: str) -> int:
    return cli.main(["flash", "--image", str(tools.parent / "image.bin"), *options])


def called(tools: Path) -> list[str]:
    file = tools.parent / "called"
    return file.read_text().splitlines() if file.exists() else []


def said(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    return captured.out + captured.err


def test_pyocd_is_the_first_way(tools: Path) -> None:
    add_pyocd(tools)
    add_tool(tools, "openocd")
    add_probe(tools)
    add_drive(tools)
    assert run(tools) == 0
    assert called(tools)[:4] == ["pyocd", "flash", "-t", "k64f"]
    assert called(tools)[-1] == str(tools.parent / "image.bin")


def test_openocd_is_the_second_way(tools: Path) -> None:
    add_tool(tools, "openocd")
    add_probe(tools, vendor="1fc9", product="LPC-LINK2 CMSIS-DAP")
    add_drive(tools)
    assert run(tools) == 0
    assert called(tools)[:4] == ["openocd", "-f", "board/nxp_frdm-k64f.cfg", "-c"]
    script = f"init; kinetis fcf_source write; program {{{tools.parent}/image.bin}}"
    assert called(tools)[4] == f"{script} verify reset exit 0x0"


def test_the_drive_of_the_board_is_the_third_way(
    tools: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    drive = add_drive(tools, "FRDM K64F")
    (drive / "FAIL.TXT").write_text("error: of an earlier copy")
    with board(drive):
        assert run(tools) == 0
    assert (tools.parent / "written").read_bytes() == CODE
    assert "flash (drive) ... the board took the image" in said(capsys)


@pytest.mark.parametrize("way", ["pyocd", "openocd"])
def test_the_way_can_be_chosen(tools: Path, way: str) -> None:
    add_pyocd(tools)
    add_tool(tools, "openocd")
    assert run(tools, "--with", way) == 0
    assert called(tools)[0] == way


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (CODE[:0x420] + b"\1" + CODE[0x421:], "flash at 0x420 holds 0x01, not 0x00"),
        (CODE[:-4], f"only {len(CODE) - 4} of {len(CODE)} bytes"),
        (None, "could not be read back"),
    ],
)
def test_pyocd_reads_the_flash_back(
    tools: Path, capsys: pytest.CaptureFixture[str], content: bytes | None, words: str
) -> None:
    """pyOCD itself does not compare what it wrote."""
    add_probe(tools)
    if content is None:
        add_tool(tools, "pyocd")
    else:
        add_pyocd(tools, "other.bin")
        (tools.parent / "other.bin").write_bytes(content)
    assert run(tools) == 1
    assert words in said(capsys)


@pytest.mark.parametrize(
    ("way", "text", "code", "words"),
    [
        ("pyocd", "no answer", 1, "pyocd ended with exit code 9"),
        ("openocd", "no answer", 1, "openocd ended with exit code 9"),
        ("pyocd", "No connected debug probes", 3, "pyocd found no debug probe"),
        (
            "openocd",
            "Error: unable to find a matching CMSIS-DAP device",
            3,
            "openocd found no debug probe",
        ),
    ],
)
def test_a_tool_that_fails_fails_the_command(
    tools: Path, capsys: pytest.CaptureFixture[str], way: str, text: str, code: int, words: str
) -> None:
    add_tool(tools, way, f"echo '{text}' >&2; exit 9")
    assert run(tools, "--with", way) == code
    printed = said(capsys)
    assert words in printed
    assert ("Connect a USB cable" if code == 3 else text) in printed


@pytest.mark.parametrize(
    ("installed", "probe", "options", "words"),
    [
        ([], False, [], ["pyocd: not installed\n", "openocd: not installed\n"]),
        ([], False, [], ["drive: none is mounted\n", "debug probe on USB: none\n"]),
        (["pyocd"], False, [], ["pyocd: installed\n"]),
        (["pyocd"], True, ["--with", "openocd"], ["openocd: not installed"]),
    ],
)
def test_without_a_way_it_says_what_was_looked_for(
    tools: Path,
    capsys: pytest.CaptureFixture[str],
    installed: list[str],
    probe: bool,
    options: list[str],
    words: list[str],
) -> None:
    for name in installed:
        add_tool(tools, name)
    if probe:
        add_probe(tools)
    assert run(tools, *options) == 3
    printed = said(capsys)
    assert [one for one in (*words, "Connect a USB cable") if one not in printed] == []
    assert called(tools) == []


def test_two_drives_need_a_choice(tools: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first = add_drive(tools, "DAPLINK")
    add_drive(tools, "DAPLINK1")
    assert run(tools) == 3
    assert "choose with --drive" in said(capsys)
    with board(first):
        assert run(tools, "--drive", str(first)) == 0


def test_other_drives_are_not_written(tools: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stick = tools.parent / "STICK"
    stick.mkdir()
    (tools.parent / "mounts").write_text(f"/dev/sdc {stick} vfat rw 0 0\n")
    assert run(tools) == 3
    assert run(tools, "--drive", str(stick)) == 3
    assert "neither DETAILS.TXT nor MBED.HTM" in said(capsys)
    assert list(stick.iterdir()) == []


@pytest.mark.parametrize(("name", "mode"), [("MAINTENANCE", "Interface"), ("DISK", "Bootloader")])
def test_a_probe_that_waits_for_its_own_software_gets_no_image(
    tools: Path, capsys: pytest.CaptureFixture[str], name: str, mode: str
) -> None:
    drive = add_drive(tools, name, mode)
    assert run(tools, "--with", "drive") == 3
    assert "without its reset button" in said(capsys)
    assert not (drive / "image.bin").exists()


@pytest.mark.parametrize(
    ("failure", "comes", "code", "words"),
    [
        ("error: FAILED to reset/halt the target MCU", True, 1, "FAILED to reset/halt"),
        ("", False, 0, "not mounted again"),
    ],
)
def test_the_outcome_of_a_copy_is_shown(
    tools: Path,
    capsys: pytest.CaptureFixture[str],
    failure: str,
    comes: bool,
    code: int,
    words: str,
) -> None:
    with board(add_drive(tools), failure, comes):
        assert run(tools) == code
    assert words in said(capsys)


@pytest.mark.parametrize(("writable", "words"), [(True, "did not react"), (False, "cannot write")])
def test_a_drive_that_takes_no_image_is_a_failure(
    tools: Path, capsys: pytest.CaptureFixture[str], writable: bool, words: str
) -> None:
    drive = add_drive(tools)
    if not writable:
        (drive / "image.bin").mkdir()
    assert run(tools) == 1
    assert words in said(capsys)


def test_a_dry_run_writes_nothing(tools: Path, capsys: pytest.CaptureFixture[str]) -> None:
    drive = add_drive(tools)
    add_tool(tools, "openocd")
    assert run(tools, "--dry-run", "--with", "openocd") == 0
    assert "would run openocd -f board/nxp_frdm-k64f.cfg" in said(capsys)
    assert run(tools, "--dry-run") == 0
    assert f"image.bin to {drive}" in said(capsys)
    assert called(tools) == []
    assert not (drive / "image.bin").exists()


@pytest.mark.parametrize(
    ("address", "value", "why"),
    [
        (0x40C, 0xFF, "only a mass erase opens it again"),
        (0x40C, 0xEF, "locked for ever"),
        (0x40C, 0xEE, "mass erase would be off"),
        (0x40C, 0x7E, "keys"),
        (0x408, 0xFE, "protected"),
        (0x40D, 0xFB, "other options"),
        (0x400, 0x00, "backdoor key"),
    ],
)
def test_an_image_that_could_lock_the_chip_is_not_written(
    tools: Path, capsys: pytest.CaptureFixture[str], address: int, value: int, why: str
) -> None:
    image = bytearray(CODE)
    image[address] = value
    (tools.parent / "image.bin").write_bytes(image)
    add_tool(tools, "pyocd")
    add_probe(tools)
    assert run(tools) == 1
    printed = said(capsys)
    assert f"byte 0x{address:X} is 0x{value:02X}" in printed
    assert why in printed
    assert called(tools) == []


@pytest.mark.parametrize("image", [b"", bytes(0x40F), bytes(0x100001)])
def test_an_image_must_hold_the_field_and_fit_the_chip(image: bytes) -> None:
    (problem,) = lock_problems(image)
    assert f"{len(image)} bytes" in problem


def test_an_image_that_is_not_there_is_said(
    tools: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tools.parent / "image.bin").unlink()
    assert run(tools) == 1
    assert "No such file" in said(capsys)


def test_a_drive_and_another_way_contradict_each_other(
    tools: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        run(tools, "--with", "pyocd", "--drive", str(tools))
    assert ended.value.code == 2
    assert "--with pyocd" in said(capsys)


def test_the_image_of_a_product_is_built_and_written(
    tools: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def build(_log: TextIO) -> None:
        image = tools.parent / "build/k64/weeding_robot_warning.bin"
        image.parent.mkdir(parents=True)
        image.write_bytes(CODE)

    built = Task(K64_FIRMWARE, build, always=True)
    monkeypatch.setattr(flash, "graph", lambda root: Graph(root, [built]))
    add_pyocd(tools)
    add_probe(tools)
    assert cli.main(["flash", "--product", "weeding_robot_warning"]) == 0
    assert called(tools)[-1] == str(tools.parent / "build/k64/weeding_robot_warning.bin")
