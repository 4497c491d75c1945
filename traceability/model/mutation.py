"""Reads what ./wr mutate left: which seeded faults the tests found."""

from __future__ import annotations

from pathlib import Path

from traceability.model.results import RESULTS, read_json
from traceability.model.schema import Model, Mutant, Mutation, Place


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


def mutants_of(model: Model, requirement: str) -> list[Mutant]:
    """The faults in the methods of its tree, where it is known whether its own tests find them."""
    tried = model.mutation.tried if model.mutation else []
    return [mutant for mutant in tried if requirement in mutant.own]
