"""Reads the results of ./wr mutate: the inserted faults, and the tests that found these faults."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.published import last_score
from traceability.reading.results import RESULTS, day_of, read_object
from traceability.schema import LastRecord, Mutant, Mutation, Place

RECORD = RESULTS / "mutation.json"


def last_mutation(root: Path, sources: str) -> LastRecord | None:
    """Returns the result of the last mutation test, even if the sources have changed since."""
    data = read_object(root / RECORD)
    if not data:
        return last_score(root, "mutation")
    last = _mutation(data)
    return LastRecord(
        command="mutate",
        commit=data.get("commit", ""),
        found=last.found,
        tried=len(last.tried),
        current=data.get("sources") == sources,
        date=day_of(root / RECORD),
        justified=last.justified,
        total=last.total,
    )


def read_mutation(root: Path, sources: str) -> Mutation | None:
    """Returns the faults that the mutation test tried in exactly the present sources. Returns None
    if there is no such run."""
    data = read_object(root / RECORD)
    return _mutation(data) if data.get("sources") == sources else None


def _mutation(data: dict[str, Any]) -> Mutation:
    tried = [Mutant(Place(item.pop("file"), item.pop("line")), **item) for item in data["tried"]]
    return Mutation(data["seed"], data["minutes"], data["total"], tried)
