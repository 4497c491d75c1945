"""Reads the files that the last run wrote: the results of the tests, and the sizes of the
modules."""

from __future__ import annotations

import json
import re
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import cattrs

from traceability.reading import task_record
from traceability.schema import HOST, VIRTUAL_K64, BindingResult, DriverFault
from traceability.sources import file_hash, source_hash

T = TypeVar("T")
RECORDS = cattrs.Converter(forbid_extra_keys=True)
RESULTS = Path("build/results")
METRICS = Path("build/metrics.json")
# target -> name of the test run whose results are used
RUNS = {HOST: "trace", VIRTUAL_K64: "board"}
TASKS = {HOST: task_record.TESTS_TRACE, VIRTUAL_K64: task_record.TESTS_BOARD}
TYPE = re.compile(r"/\d+$")  # a suite of typed tests ends with "/" and the number of the type
PLAIN = "plain"  # name of the test run without recordings
# file with the flash and RAM sizes of the firmware image
TOTALS = RESULTS / "image_k64.json"
RELEASE = RESULTS / "release.json"  # comparison of the files of a release that was built twice
# the WebAssembly module that runs the firmware images in a web page, and its measurements
LIVE_MODULE, LIVE = Path("build/web/sim/live.wasm"), RESULTS / "live.json"
# The results of gcovr: the totals, and the executed lines of each file.
COVERAGE = RESULTS / "coverage.json"
COVERAGE_LINES = RESULTS / "coverage_lines.json"
TIMES = RESULTS / "times.json"  # durations of commands, for the metrics
BOARD_ONLY = (
    *("tests/sim/emulator/", "tests/sim/faults/", "tests/sim/web/", "tests/torture/"),
    "tests/k64/",
    "tests/system/board/",
)
HOST_ONLY = "tests/system/host/"
BOTH = "tests/system/"
# Only the comparison of the two designs runs the tests in this folder.
COMPARED = "tests/usual_design/"


def read_times(root: Path) -> dict[str, float]:
    return read_object(root / TIMES)


def read_json(path: Path) -> Any:
    """Returns the content of a JSON file. Returns None if the file is missing or incomplete."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def read_object(path: Path) -> dict[str, Any]:
    """Returns the object in a JSON file. Returns an empty object if the file is missing or
    incomplete, or contains another value."""
    content = read_json(path)
    return content if isinstance(content, dict) else {}


def read_fresh(root: Path, path: Path, task: str) -> dict[str, Any] | None:
    """Returns the content of the JSON file that a task writes. Returns None if the file is missing
    or incomplete, or if the inputs of the task have changed since."""
    content = read_object(root / path)
    return content if content and task_record.is_fresh(root, task) else None


def read_branches(root: Path) -> dict[str, tuple[int, int]]:
    """Returns the number of executed branches and of all branches of each file, as gcovr counted
    them. Returns no file if gcovr did not count them with the present sources."""
    counted = read_fresh(root, COVERAGE, task_record.COVERAGE) or {"files": []}
    return {
        file["filename"]: (file["branch_covered"], file["branch_total"])
        for file in counted["files"]
    }


def read_image(root: Path) -> dict[str, Any] | None:
    """Returns the flash and RAM sizes of the firmware image. Returns None if the image was not
    built from the present sources."""
    return read_fresh(root, TOTALS, task_record.IMAGES)


def day_of(record: Path) -> str:
    """Returns the day (UTC) on which a run wrote its record."""
    return time.strftime("%Y-%m-%d", time.gmtime(record.stat().st_mtime))


def numbers_reported(root: Path, binding: str, name: str, image: str) -> list[int]:
    """Returns the numbers that the tests of a target reported in a property. A test is included
    only if it ran the named firmware image."""
    content = read_object(root / RESULTS / f"{RUNS[binding]}.json")
    tests = (test for suite in content.get("testsuites", []) for test in suite["testsuite"])
    return [int(test[name]) for test in tests if name in test and test.get("image") == image]


def read_record(path: Path, kind: type[T]) -> T | None:
    """Returns the content of a JSON file as an object of a type. Returns None if the file is
    missing or incomplete, or does not fit the type."""
    content = read_object(path)
    try:
        return RECORDS.structure(content, kind) if content else None
    except cattrs.BaseValidationError:
        return None


def bindings_of(file: str) -> list[str]:
    """Returns the targets for which a test is built. The folder of the test file determines these
    targets."""
    if file.startswith(COMPARED):
        return []
    if file.startswith(BOARD_ONLY):
        return [VIRTUAL_K64]
    if file.startswith(BOTH) and not file.startswith(HOST_ONLY):
        return [HOST, VIRTUAL_K64]
    return [HOST]


def cost_of(root: Path, run_name: str) -> Path:
    """Returns the path of the file with the processor time of a test run."""
    return root / RESULTS / f"{run_name}.cost.json"


def read_recording_factor(root: Path, sources: str) -> float | None:
    """Returns a quotient: the time of the tests with recordings, divided by their time without
    recordings. Returns None if one of the two runs used other sources than ``sources``."""
    costs = [read_object(cost_of(root, name)) for name in (RUNS[HOST], PLAIN)]
    if any(cost.get("sources") != sources for cost in costs):
        return None
    recorded, plain = (float(cost["seconds"]) for cost in costs)
    return round(recorded / plain, 2)


def run_hash(root: Path, binding: str) -> str:
    """Returns the hash of the result file of the last test run. Each run has another hash,
    because the file contains times."""
    return file_hash(root / RESULTS / f"{RUNS[binding]}.json")


def read_results_hash(root: Path, binding: str) -> str | None:
    """Returns the hash of the present sources if the test results belong to these sources. Returns
    "other sources" if the results belong to other sources, and None if there are no results."""
    if not (root / RESULTS / f"{RUNS[binding]}.json").exists():
        return None
    return source_hash(root) if task_record.is_fresh(root, TASKS[binding]) else "other sources"


def read_results(root: Path, binding: str) -> dict[str, BindingResult]:
    """Returns the test results of a target by ``Suite.Name``. All instances of a parameterised test
    have one common result."""
    return results_in(read_object(root / RESULTS / f"{RUNS[binding]}.json"))


def results_in(data: dict[str, Any]) -> dict[str, BindingResult]:
    """Returns the test results from the content of a GoogleTest result file."""
    results: dict[str, BindingResult] = {}
    for suite in data.get("testsuites", []):
        for test in suite.get("testsuite", []):
            name = plain_name(suite["name"], test["name"])
            own = f"{suite['name']}.{test['name']}".replace("/", "_")
            is_instance = "/" in test["name"] or TYPE.search(suite["name"]) is not None
            result = _result(test, own, is_instance)
            results[name] = _together(results[name], result) if name in results else result
    return results


def _together(earlier: BindingResult, result: BindingResult) -> BindingResult:
    """Combines two results of one test: results of two instances, or of runs with two firmware
    images. The combined result is "failed" if one of the two results is "failed"."""
    worst = earlier if earlier.result == "failed" else result
    failed = {name: "failed" for name, each in earlier.instances.items() if each == "failed"}
    return replace(
        worst,
        milliseconds=round((earlier.milliseconds or 0.0) + (result.milliseconds or 0.0), 3),
        recordings=list(dict.fromkeys([*earlier.recordings, *result.recordings])),
        measured=result.measured,
        instances={**earlier.instances, **result.instances, **failed},
        images=sorted({*earlier.images, *result.images}),
    )


def plain_name(suite: str, name: str) -> str:
    """Returns ``Suite.Name`` without the parts that GoogleTest adds: the prefix and the number of a
    parameterised test, and the number of a type."""
    whole = TYPE.sub("", suite)
    return f"{whole.rsplit('/', maxsplit=1)[-1]}.{name.split('/', maxsplit=1)[0]}"


def _result(test: dict[str, Any], name: str, is_instance: bool) -> BindingResult:
    failures = [str(item.get("failure", "")) for item in test.get("failures", [])]
    ran = test.get("status") == "RUN" and test.get("result") != "SKIPPED"
    result = "failed" if failures else "passed" if ran else "skipped"
    return BindingResult(
        result,
        round(1000 * float(str(test.get("time", "0")).removesuffix("s")), 3),
        failures[0] if failures else "",
        recordings=[name],
        measured=str(test.get("measured", "")) if result == "passed" else "",
        instances={name: result} if is_instance else {},
        images=[str(test["image"])] if "image" in test and result != "skipped" else [],
    )


def read_driver_faults(root: Path, sources: str) -> list[DriverFault] | None:
    """Returns the results of the faults that a test inserted in the drivers. Returns None if the
    test used other sources than ``sources``."""
    data = read_object(root / RESULTS / "driver_faults.json")
    if data.get("sources") != sources:
        return None
    return [DriverFault(**item) for item in data["faults"]]


def read_sizes(root: Path) -> dict[str, tuple[int, int]]:
    """Returns the size of each module in the firmware image: flash and RAM [byte]."""
    return {
        name: (int(size["flash"]), int(size["ram"]))
        for name, size in read_object(root / RESULTS / "size_k64.json").items()
        if isinstance(size, dict) and "flash" in size
    }
