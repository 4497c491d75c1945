"""Searches in graphs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TypeVar

Node = TypeVar("Node")


def reached_from(starts: Iterable[Node], next_of: Callable[[Node], Iterable[Node]]) -> list[Node]:
    """Returns the nodes ``starts`` and all nodes that follow them directly or indirectly. Each node
    occurs once."""
    reached = dict.fromkeys(starts)
    waiting = list(reached)
    while waiting:
        for node in next_of(waiting.pop()):
            if node not in reached:
                reached[node] = None
                waiting.append(node)
    return list(reached)


def descendants(start: Node, graph: Mapping[Node, Collection[Node]]) -> set[Node]:
    """Returns all nodes to which one or more edges of ``graph`` lead. ``start`` is one of them only
    if it is in a cycle."""
    return set(reached_from(graph.get(start, ()), lambda node: graph.get(node, ())))
