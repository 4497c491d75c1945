"""The drive of the debug probe of the FRDM-K64F. If a firmware image is copied to the drive, the
probe writes the image into the flash."""

from __future__ import annotations

import os
import re
import shutil
import time
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

from tools.steps import FailureError

MOUNTS = Path("/proc/mounts")
MARKS = ("DETAILS.TXT", "MBED.HTM")
FAILURE = "FAIL.TXT"
LABEL_OF_PROBE = re.compile(r"^(BOOTLOADER|MAINTENANCE)$", re.IGNORECASE)
GOES_WITHIN = 10.0  # longest time until the drive disappears after the image was copied [s]
COMES_WITHIN = 10.0  # longest time until the drive appears again with the result [s]
LOOK = 0.1


def mounted() -> list[Path]:
    """Returns the folders at which drives of boards are mounted."""
    lines = MOUNTS.read_text(errors="replace").splitlines() if MOUNTS.exists() else []
    fat = [fields[1] for line in lines if (fields := line.split())[2] in ("vfat", "msdos")]
    folders = [Path(unescaped(name)) for name in fat]
    return [folder for folder in folders if file_of(folder, MARKS) is not None]


def unescaped(name: str) -> str:
    """Returns the decoded name of a mount point. In /proc/mounts, octal numbers represent
    blanks."""
    return re.sub(r"\\([0-7]{3})", lambda match: chr(int(match[1], 8)), name)


def file_of(folder: Path, names: tuple[str, ...]) -> Path | None:
    """Searches a folder for files with one of the given names. Returns the first of these files.
    The comparison ignores case."""
    try:
        files = sorted(folder.iterdir())
    except OSError:
        return None
    return next((file for file in files if file.name.upper() in names), None)


def problem(folder: Path) -> str:
    """Returns the reason why no firmware image can be copied to this folder. The reason is empty
    if a firmware image can be copied."""
    if not folder.is_dir():
        return f"{folder} is not a folder"
    if file_of(folder, MARKS) is None:
        return (
            f"{folder} is not the drive of a board, because it contains no file "
            f"{' or '.join(MARKS)}"
        )
    details = file_of(folder, ("DETAILS.TXT",))
    text = details.read_text(errors="replace") if details else ""
    if LABEL_OF_PROBE.match(folder.name) or re.search(r"Mode:\s*Bootloader", text, re.IGNORECASE):
        return (
            f"{folder} accepts software for the debug probe, but not for the K64. Disconnect the "
            "board, and connect it again without pressing its reset button"
        )
    return ""


def copy(image: Path, folder: Path, log: TextIO) -> str:
    """Copies the firmware image, and waits until the drive appears again. Then reads the result."""
    old = failure(folder)
    log.write(f"copies {image} to {folder}\n")
    try:
        with image.open("rb") as source, (folder / image.name).open("wb") as target:
            shutil.copyfileobj(source, target)
            target.flush()
            os.fsync(target.fileno())
    except OSError as error:
        raise FailureError(f"cannot write to {folder}: {error.strerror}") from error
    went = wait(lambda: file_of(folder, MARKS) is None or failure(folder) != old, GOES_WITHIN)
    came = went and wait(lambda: file_of(folder, MARKS) is not None, COMES_WITHIN)
    if came and (text := failure(folder)):
        raise FailureError(f"the board did not accept the image: {text}")
    if came:
        return "the board accepted the image"
    if went:
        return (
            "the image was copied, but the drive was not mounted again; mount it and look for a "
            "file FAIL.TXT"
        )
    raise FailureError(
        "the image was copied, but the board did not react, and the content of its "
        "drive is unchanged; disconnect the board, connect it again, and repeat the command"
    )


def failure(folder: Path) -> str:
    """Returns the message of the probe after a failed copy."""
    file = file_of(folder, (FAILURE,))
    try:
        return " ".join(file.read_text(errors="replace").split()) if file else ""
    except OSError:
        return ""


def wait(holds: Callable[[], bool], seconds: float) -> bool:
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            return False
        time.sleep(LOOK)
    return True
