"""Searches in graphs."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TypeVar

Node = TypeVar("Node")
# node -> the node before it on a shortest way; None for the starts of the ways
Ways = dict[Node, Node | None]


def reached_from(starts: Iterable[Node], next_of: Callable[[Node], Iterable[Node]]) -> list[Node]:
    """Returns the nodes ``starts`` and all nodes that follow them directly or indirectly. Each node
    occurs once."""
    return list(ways_from(starts, next_of))


def ways_from(starts: Iterable[Node], next_of: Callable[[Node], Iterable[Node]]) -> Ways[Node]:
    """Returns the shortest ways from the nodes ``starts`` to all nodes that follow them. The nodes
    have the order of their distance."""
    before: Ways[Node] = dict.fromkeys(starts)
    waiting = deque(before)
    while waiting:
        last = waiting.popleft()
        for node in next_of(last):
            if node not in before:
                before[node] = last
                waiting.append(node)
    return before


def way_to(node: Node, before: Ways[Node]) -> list[Node]:
    """Returns the nodes on the way to a node, from the start of the way to the node."""
    way = [node]
    while (above := before.get(way[0])) is not None:
        way.insert(0, above)
    return way


def descendants(start: Node, graph: Mapping[Node, Collection[Node]]) -> set[Node]:
    """Returns all nodes to which one or more edges of ``graph`` lead. ``start`` is one of them only
    if it is in a cycle."""
    return set(reached_from(graph.get(start, ()), lambda node: graph.get(node, ())))
