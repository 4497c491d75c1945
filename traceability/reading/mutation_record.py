"""Reads what ./wr mutate left: which seeded faults the tests found."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.results import RESULTS, read_json
from traceability.schema import Mutant, Mutation, Place


def read_mutation(root: Path, sources: str) -> Mutation | None:
    """The faults that were tried in these very sources."""
    data = read_json(root / RESULTS / "mutation.json")
    if not isinstance(data, dict) or data.get("sources") != sources:
        return None
    tried = [
        Mutant(
            Place(item["file"], item["line"]),
            item["method"],
            item["kind"],
            item["change"],
            item["killed_by"],
            item["own"],
        )
        for item in data["tried"]
    ]
    return Mutation(data["seed"], data["minutes"], data["total"], tried)
