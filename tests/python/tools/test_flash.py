"""./wr flash: the ways to write a firmware image to a board, and images that are not written."""

import contextlib
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

import pytest

from tools import cli, flash, usb_drive
from tools.image import WANTED, lock_problems
from tools.radio_key import ERASED, KEY_AT, read_key
from tools.task_graph import Graph, Task
from tools.tasks import K64_FIRMWARE
from weeding_robot_client.exit_codes import MISSING

CODE = bytes(0x400) + WANTED + bytes(100)


class Desk:
    """A computer without tools, probes and drives. A test can add some of them."""

    def __init__(self, root: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.root = root
        self.capsys = capsys
        self.tools = root / "tools"  # the only folder in PATH of the simulated computer
        self.image = root / "image.bin"
        self.tools.mkdir()
        (root / "usb").mkdir()
        (root / "mounts").touch()
        self.image.write_bytes(CODE)

    def add_program(self, name: str, script: str) -> None:
        (self.tools / name).write_text(f"#!/bin/sh\n{script}\n")
        (self.tools / name).chmod(0o755)

    def add_tool(self, name: str, end: str = "exit 0") -> None:
        """Adds a stub of a tool. The stub records its arguments, one on each line."""
        self.add_program(name, f'printf "%s\\n" {name} "$@" >"{self.root}/called"\n{end}')

    def add_pyocd(self, read_back: str = "flashed") -> None:
        """Adds a stub of pyOCD. For ``flash``, the stub records its arguments and copies the
        firmware image to the file ``flashed``. For ``savemem``, the stub copies the file
        ``read_back``, as if this file were the content of the flash."""
        self.add_program(
            "pyocd",
            'for word; do case "$word" in "savemem "*)'
            f' exec /bin/cp "{self.root}/{read_back}" "${{word##* }}";; esac; done\n'
            f'/bin/cp "$word" "{self.root}/flashed"\n'
            f'printf "%s\\n" pyocd "$@" >"{self.root}/called"',
        )

    def add_probe(self, vendor: str = "0d28", product: str = "DAPLink CMSIS-DAP") -> None:
        device = self.root / "usb" / "1-2"
        device.mkdir()
        (device / "idVendor").write_text(f"{vendor}\n")
        (device / "product").write_text(f"{product}\n")

    def add_drive(self, name: str = "DAPLINK", mode: str = "Interface") -> Path:
        """Adds a mounted drive like the drive of the board."""
        drive = self.root / name
        drive.mkdir()
        (drive / "DETAILS.TXT").write_text(f"# DAPLink Firmware\nDaplink Mode: {mode}\n")
        place = str(drive).replace(" ", r"\040")
        with (self.root / "mounts").open("a") as mounts:
            mounts.write(f"/dev/sdb {place} vfat rw,relatime 0 0\n")
        return drive

    def run(self, *options: str) -> int:
        return cli.main(["flash", "--image", str(self.image), *options])

    def called(self) -> list[str]:
        file = self.root / "called"
        return file.read_text().splitlines() if file.exists() else []

    def said(self) -> str:
        captured = self.capsys.readouterr()
        return captured.out + captured.err


@pytest.fixture
def desk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Desk:
    found = Desk(tmp_path, capsys)
    monkeypatch.setenv("PATH", str(found.tools))
    monkeypatch.setattr(flash, "USB", tmp_path / "usb")
    monkeypatch.setattr(usb_drive, "MOUNTS", tmp_path / "mounts")
    monkeypatch.setattr(usb_drive, "GOES_WITHIN", 0.3)
    monkeypatch.setattr(usb_drive, "COMES_WITHIN", 0.3)
    monkeypatch.setattr(usb_drive, "LOOK", 0.01)
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    return found


@contextlib.contextmanager
def board(drive: Path, failure: str = "", comes: bool = True) -> Iterator[None]:
    """Acts as a debug probe. After a firmware image was copied to the drive of the probe, the drive
    disappears. If ``comes`` is true, the drive is mounted again. If there is a ``failure``, the
    drive then contains this text in the file FAIL.TXT."""
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


def test_pyocd_is_the_first_way(desk: Desk) -> None:
    desk.add_pyocd()
    desk.add_tool("openocd")
    desk.add_probe()
    desk.add_drive()
    assert desk.run() == 0
    assert desk.called()[:4] == ["pyocd", "flash", "-t", "k64f"]
    assert desk.called()[-1] == str(desk.image)


def test_the_copy_of_the_image_with_the_key_is_deleted(desk: Desk) -> None:
    desk.image.write_bytes(CODE[:KEY_AT] + ERASED)
    key = desk.root / "robot.key"
    key.write_text("0123456789abcdef" * 2)
    desk.add_pyocd()
    assert desk.run("--with", "pyocd", "--bluetooth-key", str(key)) == 0
    assert (desk.root / "flashed").read_bytes() == CODE[:KEY_AT] + read_key(key)
    assert not Path(desk.called()[-1]).exists()


def test_openocd_is_the_second_way(desk: Desk) -> None:
    desk.add_tool("openocd")
    desk.add_probe(vendor="1fc9", product="LPC-LINK2 CMSIS-DAP")
    desk.add_drive()
    assert desk.run() == 0
    assert desk.called()[:4] == ["openocd", "-f", "board/nxp_frdm-k64f.cfg", "-c"]
    script = f"init; kinetis fcf_source write; program {{{desk.root}/image.bin}}"
    assert desk.called()[4] == f"{script} verify reset exit 0x0"


def test_the_drive_of_the_board_is_the_third_way(desk: Desk) -> None:
    drive = desk.add_drive("FRDM K64F")
    (drive / "FAIL.TXT").write_text("error: of an earlier copy")
    with board(drive):
        assert desk.run() == 0
    assert (desk.root / "written").read_bytes() == CODE
    assert "flash (drive) ... the board accepted the image" in desk.said()


@pytest.mark.parametrize("way", ["pyocd", "openocd"])
def test_the_way_can_be_chosen(desk: Desk, way: str) -> None:
    desk.add_pyocd()
    desk.add_tool("openocd")
    assert desk.run("--with", way) == 0
    assert desk.called()[0] == way


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (CODE[:0x420] + b"\1" + CODE[0x421:], "flash at 0x420 is 0x01, but the image has 0x00"),
        (CODE[:-4], f"only {len(CODE) - 4} of {len(CODE)} bytes"),
        (None, "could not be read back"),
    ],
)
def test_pyocd_reads_the_flash_back(desk: Desk, content: bytes | None, words: str) -> None:
    """pyOCD itself does not compare the flash with the firmware image."""
    desk.add_probe()
    if content is None:
        desk.add_tool("pyocd")
    else:
        desk.add_pyocd("other.bin")
        (desk.root / "other.bin").write_bytes(content)
    assert desk.run() == 1
    assert words in desk.said()


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
    desk: Desk, way: str, text: str, code: int, words: str
) -> None:
    desk.add_tool(way, f"echo '{text}' >&2; exit 9")
    assert desk.run("--with", way) == code
    printed = desk.said()
    assert words in printed
    assert ("Connect a USB cable" if code == 3 else text) in printed


@pytest.mark.parametrize(
    ("installed", "probe", "options", "words"),
    [
        ([], False, [], ["pyocd: not installed\n", "openocd: not installed\n"]),
        (
            [],
            False,
            [],
            ["drive: no drive of a board is mounted\n", "debug probe on USB: not connected\n"],
        ),
        (["pyocd"], False, [], ["pyocd: installed\n"]),
        (["pyocd"], True, ["--with", "openocd"], ["openocd: not installed"]),
    ],
)
def test_without_a_way_it_says_what_was_looked_for(
    desk: Desk,
    installed: list[str],
    probe: bool,
    options: list[str],
    words: list[str],
) -> None:
    for name in installed:
        desk.add_tool(name)
    if probe:
        desk.add_probe()
    assert desk.run(*options) == 3
    printed = desk.said()
    assert [one for one in (*words, "Connect a USB cable") if one not in printed] == []
    assert desk.called() == []


def test_two_drives_need_a_choice(desk: Desk) -> None:
    first = desk.add_drive("DAPLINK")
    desk.add_drive("DAPLINK1")
    assert desk.run() == 3
    assert "choose one with --drive" in desk.said()
    with board(first):
        assert desk.run("--drive", str(first)) == 0


def test_other_drives_are_not_written(desk: Desk) -> None:
    stick = desk.root / "STICK"
    stick.mkdir()
    (desk.root / "mounts").write_text(f"/dev/sdc {stick} vfat rw 0 0\n")
    assert desk.run() == 3
    assert desk.run("--drive", str(stick)) == 3
    assert "contains no file DETAILS.TXT or MBED.HTM" in desk.said()
    assert list(stick.iterdir()) == []


@pytest.mark.parametrize(("name", "mode"), [("MAINTENANCE", "Interface"), ("DISK", "Bootloader")])
def test_a_probe_that_waits_for_its_own_software_gets_no_image(
    desk: Desk, name: str, mode: str
) -> None:
    drive = desk.add_drive(name, mode)
    assert desk.run("--with", "drive") == 3
    assert "without pressing its reset button" in desk.said()
    assert not (drive / "image.bin").exists()


@pytest.mark.parametrize(
    ("failure", "comes", "code", "words"),
    [
        ("error: FAILED to reset/halt the target MCU", True, 1, "FAILED to reset/halt"),
        ("", False, 0, "not mounted again"),
    ],
)
def test_the_outcome_of_a_copy_is_shown(
    desk: Desk,
    failure: str,
    comes: bool,
    code: int,
    words: str,
) -> None:
    with board(desk.add_drive(), failure, comes):
        assert desk.run() == code
    assert words in desk.said()


@pytest.mark.parametrize(("writable", "words"), [(True, "did not react"), (False, "cannot write")])
def test_a_drive_that_takes_no_image_is_a_failure(desk: Desk, writable: bool, words: str) -> None:
    drive = desk.add_drive()
    if not writable:
        (drive / "image.bin").mkdir()
    assert desk.run() == 1
    assert words in desk.said()


def test_a_dry_run_writes_nothing(desk: Desk) -> None:
    drive = desk.add_drive()
    desk.add_tool("openocd")
    assert desk.run("--dry-run", "--with", "openocd") == 0
    assert "would run openocd -f board/nxp_frdm-k64f.cfg" in desk.said()
    assert desk.run("--dry-run") == 0
    assert f"image.bin to {drive}" in desk.said()
    assert desk.called() == []
    assert not (drive / "image.bin").exists()


@pytest.mark.parametrize(
    ("address", "value", "why"),
    [
        (0x40C, 0xFF, "only a mass erase could open it again"),
        (0x40C, 0xEF, "locked for ever"),
        (0x40C, 0xEE, "mass erase would be disabled"),
        (0x40C, 0x7E, "keys"),
        (0x408, 0xFE, "protected"),
        (0x40D, 0xFB, "other options"),
        (0x400, 0x00, "backdoor key"),
    ],
)
def test_an_image_that_could_lock_the_chip_is_not_written(
    desk: Desk, address: int, value: int, why: str
) -> None:
    image = bytearray(CODE)
    image[address] = value
    (desk.image).write_bytes(image)
    desk.add_tool("pyocd")
    desk.add_probe()
    assert desk.run() == 1
    printed = desk.said()
    assert f"byte 0x{address:X} is 0x{value:02X}" in printed
    assert why in printed
    assert desk.called() == []


@pytest.mark.parametrize("image", [b"", bytes(0x40F), bytes(0x100001)])
def test_an_image_must_hold_the_field_and_fit_the_chip(image: bytes) -> None:
    (problem,) = lock_problems(image)
    assert f"{len(image)} bytes" in problem


def test_an_image_that_is_not_there_is_said(desk: Desk) -> None:
    (desk.image).unlink()
    assert desk.run() == MISSING
    assert "./wr firmware" in desk.said()


def test_a_drive_and_another_way_contradict_each_other(desk: Desk) -> None:
    with pytest.raises(SystemExit) as ended:
        desk.run("--with", "pyocd", "--drive", str(desk.root))
    assert ended.value.code == 2
    assert "--with pyocd" in desk.said()


def test_the_image_of_a_product_is_built_and_written(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    def build(_log: TextIO) -> None:
        image = desk.root / "build/k64/weeding_robot_warning.bin"
        image.parent.mkdir(parents=True)
        image.write_bytes(CODE)

    built = Task(K64_FIRMWARE, build, always=True)
    monkeypatch.setattr(flash, "graph", lambda root: Graph(root, [built]))
    desk.add_pyocd()
    desk.add_probe()
    assert cli.main(["flash", "--product", "weeding_robot_warning"]) == 0
    assert desk.called()[-1] == str(desk.root / "build/k64/weeding_robot_warning.bin")
