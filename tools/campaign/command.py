"""./wr campaign: a long run of random cases in chunks. Each finished chunk is stored."""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path
from typing import Any

from tools.campaign.chunks import Chunk, Store, chunks_of, identity_of, whole_part
from tools.campaign.kinds import KINDS, Kind
from tools.campaign.workers import run_here, run_on_dask
from tools.cmake_build import build
from tools.lock import only_one
from tools.steps import FailureError, Steps, UsageError
from traceability.model.build import commit
from traceability.reading.published import publish
from weeding_robot_client.options import positive

SHOWN_EVERY = 10.0  # seconds


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "campaign",
        description="Runs many random cases, in chunks on all cores. Each finished chunk is stored "
        "in build/campaign. An interrupted campaign continues with --resume, and has "
        "the same result as an uninterrupted campaign.",
    )
    parser.add_argument("kind", choices=("faults", "fuzz", "loads"), help="kind of the cases")
    parser.add_argument("--count", type=positive, help="number of cases (each kind has a default)")
    parser.add_argument(
        "--seed", type=int, default=1, help="seed that determines the cases (default: 1)"
    )
    parser.add_argument(
        "--workers",
        type=positive,
        default=os.cpu_count() or 1,
        help="number of worker processes (default: one for each core)",
    )
    parser.add_argument("--scheduler", help="address of a Dask scheduler, such as tcp://HOST:8786")
    parser.add_argument(
        "--resume", action="store_true", help="use the chunks that are already finished"
    )
    parser.add_argument(
        "--publish",
        action="store_true",
        help="write the result to tests/records. With --count, first run the cases. Without "
        "--count, use only the finished chunks",
    )
    parser.set_defaults(run=campaign)


def campaign(root: Path, options: argparse.Namespace) -> int:
    kind = KINDS[options.kind]
    with only_one(root, "campaign"):
        steps = Steps(root, 1)
        if not steps.run("build of the campaign", lambda log: build_all(root, kind, log)):
            return 1
    store = Store(root, kind.name, identity_of(root / file for file in kind.files), options.seed)
    if options.count or not options.publish:
        with store.only_one():
            chunks = run(root, kind, store, options)
    else:
        chunks = whole_part(store.finished())
    if not chunks:
        raise FailureError(
            "no chunk of this program and this seed is finished; run the campaign without --publish"
        )
    result = merged(root, kind, store, chunks)
    print(json.dumps(result["outcomes"]))
    if options.publish:
        command = f"./wr campaign {kind.name} --count {result['cases']} --seed {options.seed}"
        path = publish(root, kind.name, command, commit(root), result)
        print(f"{result['cases']} {kind.unit} published in {path.relative_to(root)}")
    failures = result.get("failures", [])
    for failure in failures:
        print(*(f"{name}: {value}" for name, value in failure.items()), sep="\n")
    if failures:
        print(f"the full results are in {store.folder.relative_to(root)}")
    return 1 if failures else 0


def build_all(root: Path, kind: Kind, log: Any) -> None:
    for preset, targets in kind.targets:
        build(root, preset, log, *targets)


def run(root: Path, kind: Kind, store: Store, options: argparse.Namespace) -> list[Chunk]:
    """Runs the chunks that are not finished, and returns all chunks of the campaign."""
    chunks = chunks_of(options.seed, options.count or kind.usual, kind.size)
    finished = {chunk for chunk in chunks if store.read(chunk) is not None}
    if finished and not options.resume:
        raise UsageError(
            f"{len(finished)} chunks of this campaign are already finished. Use --resume to "
            f"continue, or remove {store.folder.relative_to(root)} to run them again"
        )
    left = [chunk for chunk in chunks if chunk not in finished]
    progress = Progress(kind, len(chunks), sum(chunk.count for chunk in left))
    results = (
        run_on_dask(kind, root, left, options.scheduler, store.identity)
        if options.scheduler
        else run_here(kind, root, left, options.workers)
    )
    for chunk, cases in results:
        if len(cases) != chunk.count:
            raise FailureError(f"chunk {chunk.number} has {len(cases)} cases, not {chunk.count}")
        store.keep(chunk, cases)
        progress.show(chunk)
    return chunks


def merged(root: Path, kind: Kind, store: Store, chunks: list[Chunk]) -> dict[str, Any]:
    """Returns the summary of the chunks. Each chunk is counted once."""
    cases = [case for chunk in chunks for case in store.read(chunk) or []]
    return {
        "identity": store.identity,
        "chunks": len(chunks),
        "cases": len(cases),
        **kind.summarise(root, cases),
    }


class Progress:
    """Prints the progress periodically: the number of finished cases and the remaining time."""

    def __init__(self, kind: Kind, chunks: int, cases: int) -> None:
        self.kind, self.chunks, self.cases = kind, chunks, cases
        self.done = 0
        self.start = self.shown = time.monotonic()
        print(f"{cases} {kind.unit} to run, in {chunks} chunks in total", flush=True)

    def show(self, chunk: Chunk) -> None:
        self.done += chunk.count
        now = time.monotonic()
        if now - self.shown < SHOWN_EVERY and self.done < self.cases:
            return
        self.shown = now
        rate = self.done / (now - self.start)
        left = round((self.cases - self.done) / rate)
        print(
            f"  {self.done} of {self.cases} {self.kind.unit}, {rate:.1f} a second, "
            f"{left // 3600}:{left // 60 % 60:02}:{left % 60:02} left",
            flush=True,
        )
