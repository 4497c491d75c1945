"""./wr flash: writes the firmware image into the flash of the board."""

from __future__ import annotations

import argparse
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from tools import usb_drive
from tools.firmware import add_product
from tools.image import lock_problems
from tools.lock import only_one
from tools.radio_key import ADVICE as KEY_ADVICE
from tools.radio_key import KeyFileError, read_key, with_key
from tools.steps import FailureError, MissingError, Steps, UsageError, log_of, need_file, run
from tools.tasks import K64_FIRMWARE, graph
from traceability.reading.products import image_of
from weeding_robot_client.exit_codes import MISSING

USB = Path("/sys/bus/usb/devices")
ARM = "0d28"  # vendor of the debug probe on the FRDM-K64F
# Messages of pyOCD and OpenOCD when they find no debug probe.
NO_PROBE = ("No connected debug probes", "unable to find a matching CMSIS-DAP device")
ADVICE = """\
Connect a USB cable to the socket with the mark SDA on the board, and try again. Or name the folder
where the board's drive is mounted: ./wr flash --drive FOLDER. docs/bring_up.rst explains each
way."""


@dataclass(frozen=True)
class Way:
    """A way to write to the board. If the way is not available, ``missing`` is the reason.
    Otherwise, ``missing`` is empty."""

    missing: str
    does: str
    write: Callable[[TextIO], str | None]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "flash",
        description="Builds the firmware image for the K64, checks that it would not lock the "
        "chip, and writes it into a FRDM-K64F. The command uses pyOCD or OpenOCD, or copies the "
        f"image to the drive of the board. The exit code {MISSING} means that the command found "
        "no board, or that a file with the given name does not exist.",
    )
    parser.add_argument(
        "--with",
        dest="way",
        choices=("pyocd", "openocd", "drive"),
        help="the way to write to the board (default: the first available way)",
    )
    parser.add_argument(
        "--drive",
        type=Path,
        metavar="PATH",
        help="folder at which the drive of the board is mounted",
    )
    add_product(parser, "build and write the firmware image of this product")
    parser.add_argument(
        "--image", type=Path, metavar="BIN", help="write this firmware image, and build nothing"
    )
    parser.add_argument(
        "--bluetooth-key",
        type=Path,
        metavar="FILE",
        help="write this key (32 hexadecimal digits) into the firmware image of "
        "weeding_robot_pc_bluetooth",
    )
    parser.add_argument(
        "--dry-run",
        action="store_true",
        help="check the firmware image, and then only print the steps",
    )
    parser.set_defaults(run=flash)


def flash(root: Path, options: argparse.Namespace) -> int:
    name = "drive" if options.drive else options.way
    if options.way not in (None, name):
        raise UsageError(f"--drive cannot be combined with --with {options.way}")
    for file in (options.image, options.bluetooth_key):
        if file:
            need_file(
                file,
                f"name an existing file. {KEY_ADVICE}"
                if file == options.bluetooth_key
                else "build the image with ./wr firmware, or name another file",
            )
    image: Path = options.image or root / image_of(options.product, ".bin")
    steps = Steps(root, 2 + bool(options.bluetooth_key))
    if not options.image:
        with only_one(root, "flash"):
            if graph(root).run([K64_FIRMWARE]).failed:
                return 1
    if not steps.run("image", lambda _log: checked(image)):
        return 1
    with tempfile.TemporaryDirectory() as folder:
        if options.bluetooth_key:
            keyed = Path(folder) / f"{image.stem}.keyed.bin"
            if not steps.run("key", lambda _log: add_key(image, options.bluetooth_key, keyed)):
                return 1
            image = keyed
        return write_to_board(steps, image, options, name)


def write_to_board(steps: Steps, image: Path, options: argparse.Namespace, name: str | None) -> int:
    """Writes the firmware image to the board, or prints the steps if this is a dry run."""
    name, way = choose(ways(image, options.drive), name)
    if options.dry_run:
        steps.skip(f"flash ({name})", f"dry run, would {way.does}")
        return 0
    if steps.run(f"flash ({name})", way.write):
        return 0
    log = log_of(steps.root, f"flash ({name})").read_text(errors="replace")
    if any(text in log for text in NO_PROBE):
        raise MissingError(f"{name} found no debug probe\n{ADVICE}")
    return 1


def checked(image: Path) -> str:
    """Returns the size of a firmware image, as a text. Raises FailureError if the image would lock
    the chip."""
    try:
        content = image.read_bytes()
    except OSError as error:
        raise FailureError(f"cannot read {image}: {error.strerror}") from error
    if problems := lock_problems(content):
        raise FailureError(
            "not written, because the image could lock the chip: " + "; ".join(problems)
        )
    return f"{len(content)} bytes; the image does not lock the chip"


def add_key(image: Path, key_file: Path, keyed: Path) -> str:
    """Writes a copy of the firmware image with the key. Raises FailureError if the key cannot
    be used, or if the image has no place for a key."""
    try:
        keyed.write_bytes(with_key(image.read_bytes(), read_key(key_file)))
    except KeyFileError as error:
        raise FailureError(str(error)) from error
    return "the key is in a copy of the image. The command deletes this copy when it ends"


def ways(image: Path, folder: Path | None) -> dict[str, Way]:
    """Returns all ways to write a firmware image, in the order in which they are tried."""
    file = image.resolve()
    flags = ("-t", "k64f", "--no-wait", "--format", "bin", "--base-address", "0")
    # In a script of OpenOCD, braces around the path are necessary, because the path can contain
    # blanks. Without fcf_source, OpenOCD writes a different flash configuration field, and the
    # comparison fails. The field was checked before.
    script = f"init; kinetis fcf_source write; program {{{file}}} verify reset exit 0x0"
    return {
        "pyocd": pyocd(file, flags),
        "openocd": tool("openocd", "-f", "board/nxp_frdm-k64f.cfg", "-c", script),
        "drive": copy(file, folder),
    }


def tool(name: str, *arguments: str) -> Way:
    missing = "" if shutil.which(name) else "not installed"
    words = [name, *arguments]

    def write(log: TextIO) -> None:
        run(log, words)

    return Way(missing, f"run {' '.join(words)}", write)


def pyocd(image: Path, flags: tuple[str, ...]) -> Way:
    """Writes the firmware image with pyOCD. Then reads the flash and compares it with the image,
    because pyOCD does not compare."""
    missing = "" if shutil.which("pyocd") else "not installed"
    words = ["pyocd", "flash", *flags, str(image)]

    def write(log: TextIO) -> str | None:
        run(log, words)
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "read_back.bin"
            commands = ("reset halt", f"savemem 0 {image.stat().st_size} {copy}", "reset")
            read = ["pyocd", "commander", "-t", "k64f", "--no-wait"]
            run(log, [*read, *(word for line in commands for word in ("-c", line))])
            return compared(image, copy)

    return Way(missing, f"run {' '.join(words)}, read the flash back and compare", write)


def compared(image: Path, copy: Path) -> str:
    """Returns a text which states that flash and image are equal. Raises FailureError for the first
    byte that differs."""
    expected = image.read_bytes()
    try:
        read_back = copy.read_bytes()
    except OSError as error:
        raise FailureError("the flash could not be read back; write the image again") from error
    for address, (byte, other) in enumerate(zip(expected, read_back, strict=False)):
        if byte != other:
            differs = f"flash at 0x{address:X} is 0x{other:02X}, but the image has 0x{byte:02X}"
            raise FailureError(f"{differs}; write the image again")
    if len(read_back) < len(expected):
        raise FailureError(
            f"only {len(read_back)} of {len(expected)} bytes were read back: try again"
        )
    return f"{len(expected)} bytes read back, equal to the image"


def copy(image: Path, folder: Path | None) -> Way:
    drives = [folder] if folder else usb_drive.mounted()
    if len(drives) != 1:
        many = f"several drives are mounted: {', '.join(map(str, drives))}; choose one with --drive"
        return Way(many if drives else "no drive of a board is mounted", "", lambda _log: None)
    drive = drives[0]
    missing = usb_drive.problem(drive)
    return Way(missing, f"copy {image} to {drive}", lambda log: usb_drive.copy(image, drive, log))


def choose(available: dict[str, Way], name: str | None) -> tuple[str, Way]:
    """Returns the chosen way. If no way is chosen, returns the first way that finds a board."""
    probe = name is not None or has_probe()
    for other, way in available.items():
        if name in (None, other) and not way.missing and (probe or other == "drive"):
            return other, way
    said = [f"{other}: {way.missing or 'installed'}" for other, way in available.items()]
    if name:
        raise MissingError(f"{name}: {available[name].missing}\n{ADVICE}")
    said.append(f"debug probe on USB: {'connected' if probe else 'not connected'}")
    looked = "\n  ".join(said)
    raise MissingError(f"no board was found. The command searched here:\n  {looked}\n{ADVICE}")


def has_probe() -> bool:
    """Returns whether a debug probe of the FRDM-K64F is connected."""

    def text(file: Path) -> str:
        try:
            return file.read_text(errors="replace").strip()
        except OSError:
            return ""

    devices = list(USB.iterdir()) if USB.is_dir() else []
    return any(
        text(device / "idVendor") == ARM or "CMSIS-DAP" in text(device / "product")
        for device in devices
    )
