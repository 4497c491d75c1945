"""The simulated robot on the pages other than "Run the robot". The firmware drives the robot, and
the pages highlight the calls of the firmware."""

from __future__ import annotations

import json
import re
import subprocess
from itertools import pairwise
from typing import Any

import pytest

from portal.live_view import in_registers
from tests.python.site.browser import BROWSER, needs_browser, needs_node
from tests.python.site.content import SITE
from tools.browser import result_of
from weeding_robot_client import frames
from weeding_robot_client.layout import read_frames

SCRIPTS = SITE / "_static" / "live"
STATES = ["OperationState", "Working", "Waiting", "WaitingN", "Reconnecting", "MainController"]
# The worker runs in Node. Its scripts and files are read from the site.
NODE = """
const fs = require("fs"), vm = require("vm"), path = require("path");
const [scripts, site, orders, cycles] = process.argv.slice(1);
const sent = [];
const read = (name) => fs.readFileSync(path.join(site, name));
const context = vm.createContext({
  postMessage: (message) => sent.push(message), performance, setTimeout, clearTimeout,
  WebAssembly, TextEncoder, TextDecoder, console,
  importScripts: (...names) => names.forEach((name) =>
    vm.runInContext(fs.readFileSync(path.join(scripts, name), "utf8"), context)),
  fetch: async (name) => ({
    ok: true, arrayBuffer: async () => Uint8Array.from(read(name)).buffer,
    json: async () => JSON.parse(read(name)),
  }),
});
context.self = context;
vm.runInContext(fs.readFileSync(path.join(scripts, "worker.js"), "utf8"), context);
(async () => {
  for (const order of JSON.parse(orders)) context.onmessage({ data: order });
  for (let i = 0; i < Number(cycles); i += 1) context.onmessage({ data: { do: "playCycle" } });
  context.onmessage({ data: { do: "end" } });
  const ended = () => sent.some((message) => message.kind === "error");
  while (!ended()) await new Promise((done) => setTimeout(done, 20));
  process.stdout.write(JSON.stringify(sent.filter((message) => message.kind !== "loaded")));
})();
"""
# The drive is started in a page. After ten cycles, the drive is paused, and the highlighted
# elements are collected.
PROBE = """<!doctype html><meta charset="utf-8">
<iframe style="width:1200px;height:900px"></iframe>
<script>
const frame = document.querySelector("iframe");
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
frame.onload = async () => {
  const doc = frame.contentDocument, one = (selector) => doc.querySelector(selector);
  const button = one("[data-go]");
  button.click();
  const at = () => (one(".lv-at") || {}).textContent || "";
  const cycle = () => Number(at().replace(/.*cycle (\\d+).*/, "$1"));
  while (!(cycle() >= 10)) await wait(50);
  button.click();
  await wait(300);
  const paused = cycle();
  await wait(400);
  const marked = (selector) => [...doc.querySelectorAll(selector)].map((link) => link.dataset.m);
  const found = {
    paused: cycle() === paused, button: button.textContent,
    active: marked("svg a.lv-active"), present: marked("svg a.lv-present"),
    lines: [...doc.querySelectorAll("path.lv-call")].map((path) => path.id),
  };
  await fetch("/", { method: "POST", body: JSON.stringify(found) });
};
frame.src = "patterns/operation-states.html";
</script>"""

LANES = """
const lanes = require(process.argv[1]);
const { contexts, switches, lasted, at } = JSON.parse(require("fs").readFileSync(0, "utf8"));
const activations = lanes.activationsOf(switches, lasted);
const found = lanes.lanesOf(contexts, activations);
process.stdout.write(JSON.stringify({
  activations,
  counts: found.map((lane) => lane.counts.map(({ context, count }) => [context.id, count])),
  active: at.map((instant) => lanes.activeAt(found, instant).map((context) => context.id)),
}));
"""
# The page "Execution" plays ten cycles. Then the drive is paused, and two instants of the last
# cycle are selected: 0.001 ms and 1 ms after the clock pulse.
LANES_OF_PAGE = """<!doctype html><meta charset="utf-8">
<iframe style="width:1200px;height:900px"></iframe>
<script>
const frame = document.querySelector("iframe");
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
frame.onload = async () => {
  const doc = frame.contentDocument, one = (selector) => doc.querySelector(selector);
  const button = one("[data-go]");
  button.click();
  const at = () => (one(".lv-at") || {}).textContent || "";
  while (!(Number(at().replace(/.*cycle (\\d+).*/, "$1")) >= 10)) await wait(50);
  button.click();
  await wait(300);
  const slider = one("#lanes-instant"), span = one("#lanes-window"), instants = [];
  span.value = "1";
  for (const value of [1, 1000]) {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
    instants.push(one(".lv-instant").textContent);
  }
  const found = {
    instants,
    lanes: [...doc.querySelectorAll(".lv-lane svg")].map((svg) => svg.getAttribute("aria-label")),
    active: [...doc.querySelectorAll("tr.lv-active")].map((row) => row.id),
    sizes: [],
  };
  for (const width of [1200, 375]) {
    frame.style.width = `${width}px`;
    await wait(100);
    found.sizes.push(doc.documentElement.scrollWidth - width);
  }
  await fetch("/", { method: "POST", body: JSON.stringify(found) });
};
frame.src = "execution.html";
</script>"""

pytestmark = pytest.mark.skipif(
    not (SITE / "live" / "live.wasm").exists(), reason="live/live.wasm was not built"
)


def in_node(program: str, *words: object, given: object = None) -> Any:
    """Runs a program in Node with the words as arguments and ``given`` as input. Returns the
    output."""
    command = ["node", "-e", program, *map(str, words)]
    text = json.dumps(given)
    run = subprocess.run(
        command, input=text, capture_output=True, text=True, timeout=240, check=True
    )
    return json.loads(run.stdout)


def played(orders: list[dict[str, Any]], cycles: int) -> list[dict[str, Any]]:
    return list(in_node(NODE, SCRIPTS, SITE, json.dumps(orders), cycles))


@needs_node
def test_a_drive_shows_the_calls_and_the_present_state_of_each_cycle() -> None:
    play = {"do": "play", "folder": "live/", "modules": STATES, "scenario": "loss_of_the_pc"}
    sent = played([{"do": "load", "folder": "live/"}, play], 60)
    begun = next(message for message in sent if message["kind"] == "plays")
    assert begun["scenario"] == "loss_of_the_pc"
    cycles = [message for message in sent if message["kind"] == "playCycle"]
    assert [shown["cycle"] for shown in cycles] == sorted({shown["cycle"] for shown in cycles})

    states = [
        one["module"]
        for shown in cycles
        for one in shown["states"]
        if one["id"] == "operation-states"
    ]
    assert {"Working", "Waiting", "WaitingN", "Reconnecting"} <= set(states)
    # A module is highlighted in a cycle if this cycle contains calls of the module. In all other
    # cycles, the module is not highlighted.
    for before, shown in pairwise(cycles):
        risen = {name for name in STATES if shown["counts"][name] > before["counts"][name]}
        assert set(shown["active"]) == risen
        assert all({caller, called} <= set(STATES) for caller, called in shown["calls"])
    assert any(["MainController", "OperationState"] in shown["calls"] for shown in cycles)


@needs_node
def test_each_node_of_a_tree_has_the_time_and_the_arguments_of_its_last_call() -> None:
    sent = played(
        [{"do": "load", "folder": "live/"}, {"do": "find", "folder": "live/", "id": "FR-15"}], 0
    )
    found = next(message for message in sent if message["kind"] == "found")
    nodes = {node["name"]: node for node in found["nodes"]}
    read, change = nodes["MainController::read"], nodes["MainController::changeOpState"]
    # Both calls belong to one cycle. The next cycle begins 100 ms later.
    assert 0 < change["at"] - read["at"] < 100
    assert change["at"] <= found["at"] + 100
    (argument,) = change["values"]
    assert re.fullmatch(r"\w+ at 0x[12]f?f?[0-9a-f]{5,7}", argument), (
        "the value must be an object in RAM"
    )


@pytest.mark.parametrize(
    ("signature", "parameters"),
    [
        ("void set(std::int16_t value, bool now)", [["value", "i16"], ["now", "bool"]]),
        (
            "virtual bool order(Link& link, const Frame& frame)",
            [["link", "address"], ["frame", "address"]],
        ),
        ("void set(Velocity velocity, bool now)", []),
        ("void set(bool now, Velocity velocity)", [["now", "bool"]]),
        ("Decoded push(bool now)", []),
    ],
)
def test_a_parameter_has_a_kind_up_to_the_first_that_may_not_be_in_a_register(
    signature: str, parameters: list[list[str]]
) -> None:
    assert in_registers(signature) == parameters


@needs_node
def test_a_new_state_is_seen_only_in_the_product_that_has_it() -> None:
    """Both products play the same scenario. Only the product with the warning light enters the
    state WaitingK."""
    products = ["weeding_robot_paper", "weeding_robot_warning"]
    order = {"do": "compare", "folder": "live/", "products": products, "scenario": "loss_of_the_pc"}
    sent = played([{"do": "load", "folder": "live/"}, order], 0)
    before, after = next(message for message in sent if message["kind"] == "compared")["runs"]

    def states(run: dict[str, Any]) -> set[str]:
        return {one["state"] for cycle in run["cycles"] for one in cycle["states"]}

    assert states(after) - states(before) == {"WaitingK"}
    assert states(before) <= states(after)
    assert "WaitingK" in set(after["modules"]) - set(before["modules"])
    # Each product has its own module that composes the robot.
    assert set(before["modules"]) - set(after["modules"]) == {"RobotDirector"}


def from_bytes(part: bytes, signed: bool = False) -> int:
    return int.from_bytes(part, "little", signed=signed)


PARTS = """
const frames = require(process.argv[1]);
const { lines, layouts } = JSON.parse(require("fs").readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify(lines.map((line) => frames.partsOf(line, layouts))));
"""


@needs_node
def test_the_parts_of_a_frame_are_those_that_the_client_decodes() -> None:
    """In each frame of a drive, the parts contain the bytes of the frame in their order. Each part
    contains the number that the client decodes from the field with the same name."""
    play = {"do": "play", "folder": "live/", "modules": [], "scenario": "loss_of_the_pc"}
    sent = played([{"do": "load", "folder": "live/"}, play], 20)
    lines = [frame["bytes"] for shown in sent for frame in shown.get("frames", ())]
    layouts = json.loads((SITE / "live" / "live.json").read_text(encoding="utf-8"))["frames"]
    all_parts = in_node(PARTS, SCRIPTS / "frames.js", given={"lines": lines, "layouts": layouts})
    table = read_frames((SITE.parents[1] / "design/frames.toml").read_text(encoding="utf-8"))
    known = {layout.kind: layout for layout in table.frames.values()}
    seen = set()
    for line, parts in zip(lines, all_parts, strict=True):
        frame = frames.decode(bytes(line[:-1]))
        layout = known[frame.kind]
        seen.add(layout.name)
        body = bytes([frame.version, frame.kind, frame.sequence]) + frame.payload
        shown = [byte for part in parts[1:-1] for byte in part["bytes"]]
        assert bytes(shown) == body + frames.crc16(body).to_bytes(2, "little")
        named = {part["name"]: bytes(part["bytes"]) for part in parts}
        for name, number in layout.unpack(frame.payload).items():
            assert number in (named[name], from_bytes(named[name]), from_bytes(named[name], True))
    assert {"Hello", "Welcome", "Confirm", "Order", "Report"} <= seen


@pytest.mark.browser
@needs_browser
def test_the_diagram_marks_the_called_modules_and_stops_when_paused() -> None:
    found, _ = result_of(BROWSER, SITE, PROBE)
    assert (found["paused"], found["button"]) == (True, "Continue")
    assert "MainController" in found["active"]
    assert len(set(found["present"])) == 1
    assert "pattern-operation-states-MainController-OperationState" in found["lines"]


@needs_node
def test_the_lanes_of_a_cycle_show_which_interrupt_runs_and_which_waits() -> None:
    """A timer preempts a thread that began before the cycle. A second thread does not end in the
    cycle."""

    def switch(line: int, entered: bool, at: int) -> dict[str, object]:
        return {"exception": 16 + line, "entered": entered, "at": at}

    contexts = [
        {"id": "timer", "name": "timer", "lines": [48], "priority": 2},
        {"id": "threads", "name": "threads", "lines": [70, 71], "priority": 5},
    ]
    switches = [
        switch(48, True, 0),
        switch(48, False, 100),
        switch(70, False, 300),
        switch(99, True, 400),  # an exception that belongs to no context
        switch(99, False, 420),
        switch(71, True, 500),
        switch(48, True, 600),
        switch(48, False, 650),
    ]
    given = {"contexts": contexts, "switches": switches, "lasted": 1000, "at": [50, 200, 450, 620]}
    found = in_node(LANES, SCRIPTS / "lanes.js", given=given)
    spans = [(one["exception"] - 16, one["begin"], one["end"]) for one in found["activations"]]
    assert sorted(spans) == [
        (48, 0, 100),
        (48, 600, 650),
        (70, 0, 300),
        (71, 500, 1000),
        (99, 400, 420),
    ]
    assert found["counts"] == [[["timer", 2]], [["threads", 2]]]
    assert found["active"] == [["timer", "threads"], ["threads"], [], ["timer", "threads"]]


@pytest.mark.browser
@needs_browser
def test_the_lanes_of_the_page_execution_show_the_cycle_that_runs() -> None:
    found, _ = result_of(BROWSER, SITE, LANES_OF_PAGE)
    assert {"cycle-timer", "tick-timer", "main-thread", "wheel-threads"} <= set(found["active"])
    # The interrupt of the cycle timer is the first activation of a cycle.
    assert found["instants"][0].startswith("0.001 ms: cycle timer")
    assert any("tick timer \u00d7" in lane for lane in found["lanes"])
    assert max(found["sizes"]) <= 0
