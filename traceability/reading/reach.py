"""Follows the edges of a graph."""

from __future__ import annotations

from collections.abc import Collection, Mapping


def reached_from(start: str, graph: Mapping[str, Collection[str]]) -> set[str]:
    """Returns all nodes to which one or more edges lead. ``start`` is one of them only if it is in
    a cycle."""
    reached: set[str] = set()
    work = [start]
    while work:
        following = set(graph.get(work.pop(), ())) - reached
        reached |= following
        work += following
    return reached
