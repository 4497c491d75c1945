"""The browser of this computer, for the tests of the pages."""

from __future__ import annotations

import shutil
import subprocess

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def find_browser() -> str | None:
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def works(browser: str | None) -> bool:
    """Returns whether the browser starts. In some packages, the command of the browser only prints
    a message.
    """
    if browser is None:
        return False
    try:
        return (
            subprocess.run(
                [browser, "--version"], capture_output=True, timeout=60, check=False
            ).returncode
            == 0
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
