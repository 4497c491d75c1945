"""Finds the calls in the code that implement each connection of the architecture diagram."""

from __future__ import annotations

import itertools
from dataclasses import replace

from traceability.model.design_model import Model
from traceability.reading.graphs import way_to, ways_from
from traceability.reading.source_facts import Facts, is_constructor
from traceability.schema import Connection

POST = "ControlThread::post"  # method that requests the later execution of the command of a thread
BODIES = "field ControlThread::body_"  # data member that refers to the command of a thread


def connections_of(model: Model, facts: Facts) -> list[Connection]:
    return [
        replace(connection, way=way_of(model, facts, connection))
        for connection in facts.declared.connections
    ]


def way_of(model: Model, facts: Facts, connection: Connection) -> list[str]:
    if connection.kind == "pipe":
        return pipe_between(model, connection)
    return [] if connection.kind == "physical" else calls_between(facts, connection)


def is_outside(connection: Connection) -> bool:
    """Returns true if the connection is physical, or if one of its ends is outside the
    microcontroller."""
    physical = connection.kind == "physical"
    outside = {"PC", "Remote control"} & {connection.source, connection.target}
    return physical or bool(outside)


def pipe_between(model: Model, connection: Connection) -> list[str]:
    """Returns two methods: a method of the source module that writes a pipe, and a method of the
    target module that reads the same pipe. Returns an empty list if there is no such pipe."""
    for pipe in model.pipes:
        writers = [writer for writer in pipe.writers if writer.startswith(f"{connection.source}::")]
        readers = [reader for reader in pipe.readers if reader.startswith(f"{connection.target}::")]
        if writers and readers:
            return [writers[0], readers[0]]
    return []


def calls_between(facts: Facts, connection: Connection) -> list[str]:
    """Returns a chain of calls from the source module of a connection to its target module, as a
    list of methods. The chain contains the methods in ``through``. Between two of these methods,
    the chain is as short as possible. Returns an empty list if there is no such chain. A call of
    ``ControlThread::post`` is followed to the command that the thread executes later."""
    begin = f"{connection.source}::"
    own = {body.id for body in facts.syntax.bodies if body.id.startswith(begin)}
    starts = sorted(own - {begin + connection.source})
    way: list[str] = []
    for stop in (*connection.through, connection.target):
        if way and way[-1].startswith(f"{stop}::"):
            continue
        part = shortest(facts, starts, stop)
        if not part:
            return []
        way = [*way[:-1], *part]
        starts = [way[-1]]
    return way


def shortest(facts: Facts, starts: list[str], stop: str) -> list[str]:
    """Returns the shortest chain of calls from one of the methods ``starts`` to ``stop``, which is
    a method or a module. Returns an empty list if there is no such chain."""
    before = ways_from(
        starts, lambda method: itertools.filterfalse(is_constructor, called(facts, method))
    )
    for method, above in before.items():
        if above and (method == stop or method.startswith(f"{stop}::")):
            return way_to(method, before)
    return []


def called(facts: Facts, method: str) -> list[str]:
    """Returns the methods that ``method`` calls. If ``method`` calls ``ControlThread::post``, the
    result also contains the ``execute`` method of each thread command that is declared in the same
    module as ``method``."""
    methods = [
        target
        for body in facts.references.own_bodies(method)
        for call in body.calls
        for target in facts.references.targets(call)
    ]
    if POST in methods:
        own = method.rpartition("::")[0]
        bodies = facts.references.objects([BODIES], "Command")
        methods += sorted(
            f"{body.kind}::execute" for body in bodies if body.kind.startswith(f"{own}::")
        )
    return methods
