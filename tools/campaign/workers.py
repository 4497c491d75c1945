"""Runs chunks on all cores of this computer, or on the workers of a Dask scheduler."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from tools.campaign.chunks import Chunk
from tools.campaign.kinds import Kind
from tools.steps import FailureError, stop_programs, stoppable

Result = tuple[Chunk, list[dict[str, Any]]]
NICE = "15"  # A campaign has low priority on the processor.
HERE = "{folder}"  # In the command of a worker, the folder of the copies replaces this text.
RETRIES = 3  # greatest number of repetitions of a chunk, if its worker is lost each time


def execute(words: Sequence[str]) -> list[dict[str, Any]]:
    """Runs the command of a chunk, and returns its cases."""
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
    """Yields each chunk as soon as it is finished."""
    files = [root / file for file in kind.files]
    with ThreadPoolExecutor(workers) as pool:
        futures = {pool.submit(execute, kind.words(files, chunk)): chunk for chunk in chunks}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            stop_programs()


def execute_copy(
    identity: str, contents: Mapping[str, bytes], words: Sequence[str]
) -> list[dict[str, Any]]:
    """Runs a command on a worker. Each computer writes the copies of the files only once."""
    folder = Path(tempfile.gettempdir()) / f"campaign-{os.getuid()}-{identity}"
    if not folder.is_dir():
        draft = Path(tempfile.mkdtemp(prefix="campaign-"))
        for name, content in contents.items():
            (draft / name).write_bytes(content)
            (draft / name).chmod(0o700)
        try:
            draft.rename(folder)
        except OSError:  # Another worker of this computer wrote the copies first.
            if not folder.is_dir():
                raise
            shutil.rmtree(draft)
    return execute([word.replace(HERE, str(folder)) for word in words])


def run_on_dask(
    kind: Kind, root: Path, chunks: Sequence[Chunk], scheduler: str, identity: str
) -> Iterator[Result]:
    """Yields each chunk as soon as a worker has finished it. If a worker is lost, its chunk runs
    again.

    The workers need the tools of the project. Start the workers in the folder of the project, with
    the Python of the project."""
    from distributed import Client
    from distributed import as_completed as completed_on

    with Client(scheduler, timeout="20s") as client:  # type: ignore[no-untyped-call]  # no types
        contents = client.scatter(
            {file.name: (root / file).read_bytes() for file in kind.files}, broadcast=True
        )
        copies = [Path(HERE) / file.name for file in kind.files]
        futures = {
            client.submit(
                execute_copy,
                identity,
                contents,
                kind.words(copies, chunk),
                key=f"{identity}-{chunk.number}-{chunk.count}-{chunk.seed}",
                retries=RETRIES,
            ): chunk
            for chunk in chunks
        }
        for future in completed_on(list(futures)):  # type: ignore[no-untyped-call]  # no types
            yield futures[future], future.result()
            future.release()
