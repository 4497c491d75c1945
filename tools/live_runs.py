"""Plays the example scenarios in Node and in a browser, with the simulator as a WebAssembly module.
Compares these runs with native runs.

Two runs are equal if their reports are equal, and the hashes of all events of the board are equal.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TextIO

from tools.browser import find_browser, result_of
from tools.cmake_build import BOARD_PROGRAM, build, sources_of
from tools.steps import FailureError
from tools.task_graph import Outcome
from traceability.reading.closed_loop_record import EXAMPLES
from traceability.reading.products import PAPER, image_of
from traceability.reading.results import LIVE, LIVE_MODULE
from traceability.whole_file import write_json

COMPILER = "clang++-19"
PRESET, TARGET = "web", "live"
SCRIPT = Path("site/theme/static/live/module.js")
DATA = Path("build/site/live/live.json")
SECONDS = 600  # time limit for all scenarios in one engine
TRACE = re.compile(r"^trace: (?P<count>\d+) events, hash (?P<hash>[0-9a-f]{16})$", re.MULTILINE)
NODE = """
const fs = require("fs");
const { LiveModule } = require(process.argv[1]);
const compiled = new WebAssembly.Module(fs.readFileSync(process.argv[2]));
const image = fs.readFileSync(process.argv[3]);
for (const file of process.argv.slice(4)) {
  const run = LiveModule.play(compiled, image, fs.readFileSync(file, "utf8"));
  process.stdout.write(JSON.stringify(run) + "\\n");
}
"""
PAGE = """<!doctype html><title>live</title><script src="module.js"></script><script>
const send = (path, value) => fetch(path, { method: "POST", body: JSON.stringify(value) });
const bytes = async (path) => new Uint8Array(await (await fetch(path)).arrayBuffer());
(async () => {
  const begin = performance.now();
  const compiled = await WebAssembly.compile(await bytes("live.wasm"));
  const image = await bytes("image.bin");
  const names = %NAMES%;
  const texts = await Promise.all(names.map(async (n) => (await fetch(n)).text()));
  const first = new LiveModule(compiled);
  first.start({ image, scenario: texts[0] });
  first.cycle();
  const ready = (performance.now() - begin) / 1000;
  const runs = [];
  for (const text of texts) runs.push(LiveModule.play(compiled, image, text));
  await send("result", { ready, runs });
})().catch((error) => send("result", { error: String(error) }));
</script>"""


def build_module(root: Path, log: TextIO) -> Outcome:
    """Builds the module, if the compiler of the module is installed. Returns its sources."""
    if shutil.which(COMPILER) is None:
        return Outcome(f"not built, because {COMPILER} is not installed", values={"file_dep": []})
    build(root, PRESET, log, TARGET)
    size = (root / LIVE_MODULE).stat().st_size
    return Outcome(f"{size} bytes", values={"file_dep": sources_of(root, PRESET, TARGET)})


def examples(root: Path) -> list[Path]:
    return sorted((root / EXAMPLES).glob("*.scenario"))


def play_native(root: Path, scenario: Path) -> dict[str, Any]:
    """Plays a scenario with the native program for the host. Returns the reports with the true
    values, and the number and the hash of all events. A run of the WebAssembly module returns a
    result of the same form."""
    with tempfile.TemporaryDirectory() as folder:
        reports = Path(folder) / "reports.csv"
        words: list[str | Path] = [root / "build/host/sim" / BOARD_PROGRAM]
        words += ["--image", root / image_of(PAPER, ".bin"), "--scenario", scenario]
        words += ["--reports", reports, "--trace", "/dev/null"]
        run = subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False)
        trace = TRACE.search(run.stdout)
        if trace is None:
            raise FailureError(f"{scenario.name}: {run.stdout}{run.stderr}")
        events = {"count": int(trace["count"]), "hash": trace["hash"]}
        return {"reports": reports.read_text(encoding="utf-8"), "events": events}


def play_in_node(root: Path, scenarios: Iterable[Path]) -> list[dict[str, Any]]:
    """Plays scenarios with the module in Node."""
    files = [root / SCRIPT, root / LIVE_MODULE, root / image_of(PAPER, ".bin"), *scenarios]
    words = ["node", "--eval", NODE, "--", *map(str, files)]
    run = subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False)
    if run.returncode != 0:
        raise FailureError(f"Node: {run.stderr.strip()[-500:]}")
    return [json.loads(line) for line in run.stdout.splitlines()]


def play_in_browser(root: Path, browser: str, scenarios: list[Path]) -> dict[str, Any]:
    """Plays scenarios in a headless browser. The result contains the runs, and the time ``ready``
    until the first cycle [s]."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for source, target in (
            (SCRIPT, "module.js"),
            (LIVE_MODULE, "live.wasm"),
            (image_of(PAPER, ".bin"), "image.bin"),
        ):
            shutil.copyfile(root / source, folder / target)
        for scenario in scenarios:
            shutil.copyfile(scenario, folder / scenario.name)
        names = json.dumps([scenario.name for scenario in scenarios])
        result, _ = result_of(browser, folder, PAGE.replace("%NAMES%", names))
    if "error" in result:
        raise FailureError(f"the browser: {result['error']}")
    return result


def differences(native: dict[str, Any], run: dict[str, Any]) -> list[str]:
    """Returns the differences between a run of the WebAssembly module and the native run. Also
    returns the failures of the run of the module."""
    problems = [run["end"]] if run["end"] != "ended" else []
    problems += run["failures"].splitlines()
    return [*problems, *(part for part in native if run[part] != native[part])]


def measure_live(root: Path, log: TextIO) -> Outcome:
    """Compares the runs of all example scenarios, and measures the speed in the browser."""
    browser = find_browser()
    if not (root / LIVE_MODULE).exists():
        write_json(root / LIVE, {})
        return Outcome("not run, because there is no module")
    scenarios = examples(root)
    engines: dict[str, list[dict[str, Any]]] = {}
    values: dict[str, Any] = {"scenarios": len(scenarios), "bytes": _bytes(root)}
    if shutil.which("node"):
        engines["Node"] = play_in_node(root, scenarios)
    if browser is not None:
        result = play_in_browser(root, browser, scenarios)
        engines["browser"] = result["runs"]
        factors = sorted(run["factor"] for run in result["runs"])
        values["ready_s"] = round(result["ready"], 2)
        values["real_time_factor"] = round(factors[len(factors) // 2], 1)
        values["factors"] = {
            scenario.stem: round(run["factor"], 1)
            for scenario, run in zip(scenarios, result["runs"], strict=True)
        }
    wrong = _wrong(root, scenarios, engines)
    log.writelines(f"{line}\n" for line in wrong)
    values["engines"] = sorted(engines)
    if engines:
        different = {line.partition(":")[0] for line in wrong}
        values["scenarios_equal"] = len(scenarios) - len(different)
    write_json(root / LIVE, values)
    if wrong:
        return Outcome(f"a run differs from the native run: {wrong[0]}", failed=True)
    speed = values.get("real_time_factor")
    summary = (
        f"{len(scenarios)} scenarios with equal results in {' and '.join(engines) or 'no engine'}"
    )
    return Outcome(f"{summary}, {speed} times as fast as real time" if speed else summary)


def _wrong(
    root: Path, scenarios: list[Path], engines: dict[str, list[dict[str, Any]]]
) -> list[str]:
    if not engines:
        return []
    problems = []
    for number, scenario in enumerate(scenarios):
        native = play_native(root, scenario)
        for engine, runs in engines.items():
            problems += [
                f"{scenario.stem}: {part} in {engine}" for part in differences(native, runs[number])
            ]
    return problems


def _bytes(root: Path) -> int:
    """Returns the number of bytes that the page loads before the robot starts. These are the
    bytes of the module, of a firmware image and of the data of the page, if these files exist."""
    loaded = (root / path for path in (LIVE_MODULE, image_of(PAPER, ".bin"), DATA))
    return sum(path.stat().st_size for path in loaded if path.exists())
