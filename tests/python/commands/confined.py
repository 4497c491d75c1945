"""Difficult environments for ./wr: a full disk, a folder that cannot be written, a replaced
program, no network, and a user without the rights of root.

All environments except the last consist of Linux namespaces, and change nothing outside these
namespaces.
"""

from __future__ import annotations

import functools
import os
import shlex
import subprocess
from pathlib import Path

import pytest

NOBODY = 65534


@functools.cache
def namespaces() -> str:
    """Returns the reason why this system cannot create namespaces. If the system can create
    namespaces, returns an empty text."""
    words = ["unshare", "--map-root-user", "--mount", "--net", "true"]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return "the program unshare is missing"
    return done.stderr.strip()


def confined(*options: str, first: str, then: list[str | Path]) -> list[str]:
    """Returns a command that creates new namespaces. In these namespaces, the command executes
    ``first`` and then ``then``.

    If the system does not allow namespaces, skips the test with the reason.
    """
    if reason := namespaces():
        pytest.skip(f"this system cannot create namespaces: {reason}")
    words = shlex.join(map(str, then))
    return ["unshare", "--map-root-user", *options, "sh", "-ec", f"{first}\nexec {words}"]


def with_disk(folder: Path, size: str, then: list[str | Path]) -> list[str]:
    """Returns a command that executes ``then`` with a small disk, which is mounted at the
    folder."""
    first = f"mount -t tmpfs -o size={size} none {shlex.quote(str(folder))}"
    return confined("--mount", first=first, then=then)


def read_only(folder: Path, then: list[str | Path]) -> list[str]:
    """Returns a command that executes ``then`` with a folder that cannot be written."""
    name = shlex.quote(str(folder))
    first = f"mount --bind {name} {name}\nmount -o remount,ro,bind {name}"
    return confined("--mount", first=first, then=then)


def with_program(program: str, replacement: Path, then: list[str | Path]) -> list[str]:
    """Returns a command that executes ``then`` with a replacement of an installed program."""
    first = f"mount --bind {shlex.quote(str(replacement))} $(readlink -f {program})"
    return confined("--mount", first=first, then=then)


def without_network(then: list[str | Path]) -> list[str]:
    return confined("--net", first="", then=then)


def without_rights(then: list[str | Path]) -> list[str]:
    """Returns a command that executes ``then`` without the rights of root."""
    if os.geteuid() != 0:
        return [str(word) for word in then]
    group = str(NOBODY)
    user = ["setpriv", "--reuid", group, "--regid", group, "--clear-groups", "--inh-caps=-all"]
    return [*user, *map(str, then)]
