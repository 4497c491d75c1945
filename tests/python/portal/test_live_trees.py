"""The checks find invocation trees in recorded calls. The JavaScript of the pages finds the same
trees."""

from __future__ import annotations

import json
import random
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import pytest

from traceability.reading.traces import EXIT, Row, Traces, embed
from traceability.schema import TreeNode

SCRIPT = Path(__file__).parents[3] / "site/theme/static/live/trees.js"
METHODS, HARDWARE = 6, 6  # There are methods 0 to 5. Only the hardware calls method 6.
NODE = """
const trees = require(process.argv[1]);
const cases = JSON.parse(require("fs").readFileSync(0, "utf8"));
const methodAt = new Map(cases.methods.map((method) => [16 * (method + 1), method]));
const has = new Set(cases.methods);
process.stdout.write(JSON.stringify(cases.runs.map(({ calls, tree }) => {
  const rows = trees.rowsOf(calls, methodAt, new Set([cases.hardware]));
  const declared = trees.prepared({ id: "FR-1", text: "", tree }, has);
  return [rows, trees.treesIn([declared], rows).length > 0];
})));
"""

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")


@dataclass
class Node:
    """The parts of a tree node that embed() reads."""

    methods: set[str]
    kind: str = "call"
    children: list[Node] = field(default_factory=list)


class Recorded(Traces):
    """Random calls in the form of recorded calls."""

    def __init__(self, calls: list[int]) -> None:
        names = {16 * (number + 1): f"M{number}" for number in range(METHODS)}
        super().__init__(Path(), symbols=names | {16 * (HARDWARE + 1): "interrupt"})
        self.vectors = {"interrupt"}
        self.calls_of_run = calls

    def events(self, _test: str) -> Any:
        return [call & ~1 | (EXIT if call & 1 else 0) for call in self.calls_of_run]


def random_calls(chance: random.Random) -> list[int]:
    """Returns random calls. Sometimes the record contains the exit of a call without its entry."""
    found: list[int] = []
    open_calls: list[int] = []
    for _ in range(chance.randrange(4, 60)):
        if open_calls and chance.random() < 0.45:
            found.append(open_calls.pop() | 1)
        elif chance.random() < 0.03:
            found.append(16 * (chance.randrange(METHODS) + 1) | 1)
        else:
            open_calls.append(16 * (chance.randrange(METHODS + 1) + 1))
            found.append(open_calls[-1])
    return found


def random_tree(chance: random.Random, depth: int = 0) -> dict[str, Any]:
    wanted = sorted(chance.sample(range(METHODS), chance.randrange(1, 3)))
    children = [random_tree(chance, depth + 1) for _ in range(chance.randrange(0, 3 - depth))]
    found: dict[str, Any] = {"n": "", "m": wanted, "c": children}
    if depth and chance.random() < 0.2:
        found["post"] = 1
    if not children and depth and chance.random() < 0.1:
        found["m"] = []  # No recorded method implements this node.
    return found


def node_of(tree: dict[str, Any]) -> Node:
    kind = "post" if tree.get("post") else "call"
    methods = {f"M{number}" for number in tree["m"]}
    return Node(methods, kind, [node_of(child) for child in tree["c"]])


def in_python(calls: list[int], tree: dict[str, Any]) -> tuple[list[Row], bool]:
    recorded = Recorded(calls)
    rows = recorded.rows("", {16 * (number + 1) for number in range(METHODS)})
    root = cast(TreeNode, node_of(tree))
    found = embed(root, rows, lambda node: cast(Node, node).methods)
    return rows, found.failed is None


def test_the_page_finds_the_trees_that_the_checks_find() -> None:
    chance = random.Random(15)
    runs = [{"calls": random_calls(chance), "tree": random_tree(chance)} for _ in range(400)]
    cases = {"methods": list(range(METHODS + 1)), "hardware": HARDWARE, "runs": runs}
    run = subprocess.run(
        ["node", "--eval", NODE, "--", str(SCRIPT)],
        input=json.dumps(cases),
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    found = 0
    for case, (rows, embedded) in zip(runs, json.loads(run.stdout), strict=True):
        own, wanted = in_python(case["calls"], case["tree"])
        got = [(f"M{r['method']}", r["depth"], r["end"], r["activation"]) for r in rows]
        assert got == [(row.method, row.depth, row.end, row.activation) for row in own]
        assert embedded == wanted, case
        found += wanted
    assert 40 < found < 360, "too few or too many runs contain their tree"
