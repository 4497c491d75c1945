"""Runs chunks on all cores of this machine, or on the workers of a Dask scheduler."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any

from tools.campaign.chunks import Chunk
from tools.campaign.kinds import Kind
from tools.steps import FailureError, stoppable

Result = tuple[Chunk, list[dict[str, Any]]]
NICE = "15"  # a campaign leaves the processor to other work
RETRIES = 3  # of a chunk whose worker ended


def execute(words: Sequence[str]) -> list[dict[str, Any]]:
    """Runs the command of a chunk; returns its cases."""
    program = subprocess.Popen(
        ["nice", "-n", NICE, *words],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        process_group=0,
    )
    with stoppable(program):
        output, errors = program.communicate()
    if program.returncode != 0:
        raise FailureError(f"{words[0]} ended with exit code {program.returncode}: {errors[-500:]}")
    return [json.loads(line) for line in output.splitlines()]


def run_here(kind: Kind, root: Path, chunks: Sequence[Chunk], workers: int) -> Iterator[Result]:
    """Yields each chunk when it is finished."""
    files = [root / file for file in kind.files]
    with ThreadPoolExecutor(workers) as pool:
        waiting = iter(chunks)
        running: dict[Future[list[dict[str, Any]]], Chunk] = {}
        try:
            while True:
                while len(running) < workers and (chunk := next(waiting, None)):
                    running[pool.submit(execute, kind.words(files, chunk))] = chunk
                if not running:
                    return
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(future), future.result()
        finally:
            _stop()


def _stop() -> None:
    from tools.steps import stop_programs

    stop_programs()


def execute_copy(
    kind: str, identity: str, contents: Sequence[bytes], chunk: Chunk
) -> list[dict[str, Any]]:
    """Runs a chunk on a worker, with a copy of the files that each worker writes once."""
    from tools.campaign.kinds import KINDS

    folder = Path(tempfile.gettempdir()) / f"campaign-{identity}"
    files = [folder / file.name for file in KINDS[kind].files]
    if not folder.is_dir():
        draft = Path(tempfile.mkdtemp(prefix="campaign-"))
        for file, content in zip(files, contents, strict=True):
            (draft / file.name).write_bytes(content)
            (draft / file.name).chmod(0o700)
        try:
            draft.rename(folder)
        except OSError:  # another worker of this machine was first
            if not folder.is_dir():
                raise
    return execute(KINDS[kind].words(files, chunk))


def run_on_dask(
    kind: Kind, root: Path, chunks: Sequence[Chunk], scheduler: str, identity: str
) -> Iterator[Result]:
    """Yields each chunk when a worker has finished it; a chunk of a lost worker runs again.

    The workers need this project's tools: they are started in its folder, with its Python.
    """
    from distributed import Client, as_completed

    with Client(scheduler, timeout="20s") as client:  # type: ignore[no-untyped-call]
        contents = client.scatter(
            [(root / file).read_bytes() for file in kind.files], broadcast=True
        )
        futures = {
            client.submit(
                execute_copy,
                kind.name,
                identity,
                contents,
                chunk,
                key=f"{identity}-{chunk.number}-{chunk.count}-{chunk.seed}",
                retries=RETRIES,
            ): chunk
            for chunk in chunks
        }
        for future in as_completed(list(futures)):  # type: ignore[no-untyped-call]
            yield futures[future], future.result()
            future.release()
