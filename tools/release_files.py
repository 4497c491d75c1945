"""Writes archives and lists of hashes. Two archives with equal contents have equal bytes. The same
applies to two lists."""

from __future__ import annotations

import gzip
import hashlib
import io
import tarfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from traceability.sources import file_hash


def write_archive(path: Path, files: Mapping[str, bytes | Path], when: int) -> None:
    """Writes a tar.gz with the files, sorted by their names.

    ``when`` is the time of each file [s since 1970]. Owners and permissions are always the same."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with (
        path.open("wb") as raw,
        gzip.GzipFile(filename="", fileobj=raw, mode="wb", mtime=when) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive,
    ):
        for name in sorted(files):
            content = files[name]
            data = content.read_bytes() if isinstance(content, Path) else content
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime, entry.mode = len(data), when, 0o644
            archive.addfile(entry, io.BytesIO(data))


def sums_text(folder: Path, names: Iterable[str]) -> str:
    """Returns the SHA-256 of each file, in the form that ``sha256sum --check`` reads."""
    return "".join(f"{file_hash(folder / name)}  {name}\n" for name in sorted(names))


def below(folder: Path, *without: str) -> dict[str, Path]:
    """Returns the files of a folder, by their paths in this folder. Files whose names end with
    a text of ``without`` are left out."""
    return {
        str(path.relative_to(folder)): path
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.endswith(without)
    }


def different_members(first: Path, second: Path) -> list[str]:
    """Returns the names of the files that have different contents in two archives, and the names
    that only one archive contains."""
    here, there = (_members(path) for path in (first, second))
    return sorted(name for name in here.keys() | there.keys() if here.get(name) != there.get(name))


def _members(path: Path) -> dict[str, bytes]:
    with tarfile.open(path) as archive:
        return {
            entry.name: hashlib.sha256(content.read()).digest()
            for entry in archive
            if (content := archive.extractfile(entry))
        }
