"""The model and the report cannot be changed."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any, get_args, get_type_hints

import pytest

from traceability.model.design_model import Model
from traceability.model.report import Report


def reachable(kind: Any, known: set[type]) -> Iterator[type]:
    """Returns the record classes in a type annotation, and the record classes of their fields."""
    hints = get_args(kind)
    if dataclasses.is_dataclass(kind) and isinstance(kind, type) and kind not in known:
        known.add(kind)
        yield kind
        hints = tuple(get_type_hints(kind).values())
    for hint in hints:
        yield from reachable(hint, known)


@pytest.mark.parametrize("kind", [*reachable(Model, known := set()), *reachable(Report, known)])
def test_a_field_cannot_be_assigned(kind: type) -> None:
    for field in dataclasses.fields(kind):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(object.__new__(kind), field.name, None)
