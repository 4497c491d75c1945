"""A cache that stores results between runs of the tools. A result is valid as long as its inputs
are the same."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

from traceability.sources import file_hash
from traceability.whole_file import write_whole

Result = TypeVar("Result")


def cached_result(path: Path, parts: Iterable[object], make: Callable[[], Result]) -> Result:
    """Returns the result of ``make``, which depends only on ``parts``. If the cache does not
    contain the result, calls ``make`` and stores the result.

    Two parts are regarded as equal if their ``repr`` is equal."""
    key = hashlib.sha256("\0".join(map(repr, parts)).encode()).hexdigest()
    if path.exists():
        with path.open("rb") as stream:
            if pickle.load(stream) == key:
                stored: Result = pickle.load(stream)
                return stored
    result = make()
    write_whole(path, pickle.dumps(key) + pickle.dumps(result))
    return result


def code_of(*modules: str) -> list[str]:
    """Returns the hashes of the Python modules that compute a result, such as ``reading/traces``.
    After a change of a module, the stored result is no longer valid."""
    package = Path(__file__).parents[1]
    return [file_hash(package / f"{name}.py") for name in modules]
