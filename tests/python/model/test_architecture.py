"""The page "Architecture" shows the chain of calls of a connection."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from traceability.model.architecture import calls_between
from traceability.schema import Connection, Place

CALLS = {
    "Main::Main": ["Motor::start"],
    "Main::stop": ["Motor::cut"],
    "Main::cycle": ["Pool::control", "Pool::check"],
    "Pool::control": ["Motor::read", "Motor::turn"],
    "Pool::check": ["Pool::control"],
}


@pytest.mark.parametrize(
    ("through", "way"),
    [
        ([], ["Main::stop", "Motor::cut"]),
        (["Pool::control"], ["Main::cycle", "Pool::control", "Motor::read"]),
        (["Pool::check"], ["Main::cycle", "Pool::check", "Pool::control", "Motor::read"]),
        (["Pool::control", "Motor::turn"], ["Main::cycle", "Pool::control", "Motor::turn"]),
        (["Pool::control", "Pool::check"], []),
    ],
)
def test_the_chain_contains_the_methods_that_the_connection_names(
    through: list[str], way: list[str]
) -> None:
    connection = Connection("call", "Main", "Motor", "", through, Place("a.toml", 1))
    references = SimpleNamespace(
        own_bodies=lambda method: [SimpleNamespace(calls=CALLS.get(method, []))],
        targets=lambda call: [call],
    )
    bodies = [SimpleNamespace(id=method) for method in CALLS]
    facts: Any = SimpleNamespace(references=references, syntax=SimpleNamespace(bodies=bodies))
    assert calls_between(facts, connection) == way
