"""A summary of the recorded calls. It contains only the calls from one module to another module."""

from __future__ import annotations

from traceability.reading.traces import Row
from traceability.schema import FoldedCall, TreeNode

# calling module and called module -> requirements whose invocation trees contain such a call
Edges = dict[tuple[str, str], list[str]]
# the called methods, and the requirements whose invocation trees contain a call between the modules
Folded = tuple[list[str], list[str]]


def starts(nodes: list[TreeNode], placed: dict[int, int]) -> list[int]:
    """Returns the numbers of the rows at which a part of an invocation tree begins in a recording.
    A part begins at the root of the tree, and at each method that a thread executes after a
    post."""
    return [
        placed[id(node)]
        for node in nodes
        if id(node) in placed and (node is nodes[0] or node.kind == "post")
    ]


def fold(rows: list[Row], firsts: list[int], edges: Edges) -> list[FoldedCall]:
    """Inside the calls at the rows ``firsts``, modules call other modules. Returns these inner
    calls. If an interrupt occurs during these calls, the calls of its handler are left out."""
    paths: dict[tuple[str, ...], Folded] = {}
    end = 0
    for first in firsts:
        if first < end and rows[first].activation == rows[firsts[0]].activation:
            continue  # This call is inside an earlier call in ``firsts``.
        end = max(end, rows[first].end)
        _fold_one(rows, first, edges, paths)
    numbers = {path: number for number, path in enumerate(paths)}
    order = sorted(paths, key=lambda path: [numbers[path[:n]] for n in range(1, len(path) + 1)])
    return [
        FoldedCall(len(path) - 1, path[-1], list(dict.fromkeys(methods)), len(methods), declared)
        for path in order
        for methods, declared in [paths[path]]
    ]


def _fold_one(
    rows: list[Row], first: int, edges: Edges, paths: dict[tuple[str, ...], Folded]
) -> None:
    path_of: dict[int, tuple[str, ...]] = {}
    for index in range(first, rows[first].end):
        row = rows[index]
        if row.activation != rows[first].activation:
            continue
        module = row.method.split("::")[0]
        above = path_of.get(row.parent, ())
        if above and above[-1] == module:
            path_of[index] = above
            continue
        path = path_of[index] = (*above, module)
        if path not in paths:
            declared = edges.get((above[-1], module), []) if above else []
            paths[path] = [], declared
        paths[path][0].append(row.method)
