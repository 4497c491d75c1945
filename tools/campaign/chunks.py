"""The chunks of a campaign, and the files of the finished chunks.

The result of a chunk depends only on its seed and its count, and is the same on every computer."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.lock import BusyError

FOLDER = Path("build/campaign")
# Greatest number of chunks of a campaign. The seed of the campaign is multiplied by SEEDS. The sum
# of this product and the number of a chunk is the seed of this chunk.
SEEDS = 1 << 20


@dataclass(frozen=True)
class Chunk:
    """A part of a campaign: its number, the seed of its random choices, and its number of cases."""

    number: int
    seed: int
    count: int


def chunks_of(seed: int, count: int, size: int) -> list[Chunk]:
    """Returns the chunks of a campaign. A longer campaign with the same seed begins with the chunks
    of a shorter campaign. Only the last chunk of the shorter campaign may have fewer cases than the
    chunk with the same number in the longer campaign."""
    if count < 1 or count > size * SEEDS:
        raise ValueError(f"a campaign has from 1 to {size * SEEDS} cases")
    number = -(-count // size)
    return [Chunk(n, seed * SEEDS + n, min(size, count - n * size)) for n in range(number)]


def identity_of(files: Iterable[Path]) -> str:
    """Returns the hash of the files that a chunk needs, such as the program and the firmware
    image."""
    digest = hashlib.sha256()
    for path in files:
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:16]


class Store:
    """The finished chunks of a campaign. Each chunk has its own file."""

    def __init__(self, root: Path, kind: str, identity: str, seed: int) -> None:
        self.identity = identity
        self.folder = root / FOLDER / kind / f"{identity}-{seed}"

    @contextmanager
    def only_one(self) -> Iterator[None]:
        """Locks the chunks. Without the lock, a second campaign could run the same chunks at the
        same time."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / "lock").open("a", encoding="utf-8") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as error:
                raise BusyError(
                    "Another process runs this campaign. Wait until it has ended, or end it with "
                    "Ctrl-C"
                ) from error
            yield

    def keep(self, chunk: Chunk, cases: list[dict[str, Any]]) -> None:
        """Writes the result of a chunk. The file of the result is never incomplete."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / f"{chunk.number:06}-{chunk.count}.json"
        draft = path.with_suffix(f".{os.getpid()}.draft")
        content = {"identity": self.identity, "seed": chunk.seed, "cases": cases}
        with draft.open("w", encoding="utf-8") as file:
            json.dump(content, file)
            file.flush()
            os.fsync(file.fileno())
        draft.replace(path)

    def read(self, chunk: Chunk) -> list[dict[str, Any]] | None:
        """Returns the cases of a chunk. Returns None if the chunk is not finished. Raises an error
        if the file of the chunk belongs to another campaign."""
        path = self.folder / f"{chunk.number:06}-{chunk.count}.json"
        if not path.is_file():
            return None
        content = json.loads(path.read_text(encoding="utf-8"))
        if (content["identity"], content["seed"]) != (self.identity, chunk.seed):
            raise ValueError(f"{path} belongs to another campaign; remove this file")
        cases: list[dict[str, Any]] = content["cases"]
        return cases

    def finished(self) -> list[Chunk]:
        """Returns the finished chunks, sorted by their numbers. If several chunks have the same
        number, the result contains only the longest chunk."""
        seed = int(self.folder.name.rpartition("-")[2])
        longest: dict[int, int] = {}
        for path in self.folder.glob("*-*.json"):
            number, count = (int(part) for part in path.stem.split("-"))
            longest[number] = max(longest.get(number, 0), count)
        return [Chunk(n, seed * SEEDS + n, count) for n, count in sorted(longest.items())]


def whole_part(chunks: Sequence[Chunk]) -> list[Chunk]:
    """Returns the chunks before the first missing or incomplete chunk. These chunks are a
    shorter campaign."""
    whole: list[Chunk] = []
    for number, chunk in enumerate(chunks):
        if chunk.number != number or (whole and chunk.count > whole[0].count):
            break
        whole.append(chunk)
        if chunk.count < whole[0].count:
            break
    return whole
