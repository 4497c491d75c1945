"""Reads the results and sizes that the test run wrote."""

from __future__ import annotations

import json
import re
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import cattrs

from traceability.reading import task_record
from traceability.schema import HOST, VIRTUAL_K64, DriverFault
from traceability.sources import file_hash, source_hash

T = TypeVar("T")
RECORDS = cattrs.Converter(forbid_extra_keys=True)
RESULTS = Path("build/results")
RUNS = {HOST: "trace", VIRTUAL_K64: "board"}  # target -> the run of the tests whose results count
TASKS = {HOST: task_record.TESTS_TRACE, VIRTUAL_K64: task_record.TESTS_BOARD}
TYPE = re.compile(r"/\d+$")  # suffix of a suite of typed tests
PLAIN = "plain"  # the run that records nothing
# The results of gcovr. They are the totals, and the lines of each file.
COVERAGE = RESULTS / "coverage.json"
COVERAGE_LINES = RESULTS / "coverage_lines.json"
BOARD_ONLY = (
    *("tests/sim/emulator/", "tests/sim/faults/", "tests/sim/web/", "tests/torture/"),
    "tests/k64/",
    "tests/system/board/",
)
HOST_ONLY = "tests/system/host/"
BOTH = "tests/system/"
COMPARED = "tests/usual_design/"  # Only the comparison of the designs runs these tests.


@dataclass
class Result:
    result: str  # "passed", "failed", "skipped"
    milliseconds: float
    message: str
    recordings: list[str] = field(default_factory=list)  # names of the files of recorded calls
    measured: str = ""  # text of the property "measured" that the test reports
    # instance of a parameterised test -> result
    instances: dict[str, str] = field(default_factory=dict)
    images: list[str] = field(default_factory=list)  # products whose images the test ran


def read_json(path: Path) -> Any:
    """Returns the content. Returns None if the file is missing or incomplete."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def day_of(record: Path) -> str:
    """Returns the day (UTC) on which a run wrote its record."""
    return time.strftime("%Y-%m-%d", time.gmtime(record.stat().st_mtime))


def numbers_reported(root: Path, binding: str, name: str, image: str) -> list[int]:
    """Returns the numbers about an image that tests of a target report in a property with this
    name.
    """
    content = read_json(root / RESULTS / f"{RUNS[binding]}.json") or {}
    tests = (test for suite in content.get("testsuites", []) for test in suite["testsuite"])
    return [int(test[name]) for test in tests if name in test and test.get("image") == image]


def read_record(path: Path, kind: type[T]) -> T | None:
    """Returns the content as typed records. Returns None if the content is missing, is incomplete
    or has another form.
    """
    content = read_json(path)
    try:
        return RECORDS.structure(content, kind) if isinstance(content, dict) else None
    except cattrs.BaseValidationError:
        return None


def bindings_of(file: str) -> list[str]:
    """Returns the targets for which a test of the firmware is built. The folder of the test decides
    this."""
    if file.startswith(COMPARED):
        return []
    if file.startswith(BOARD_ONLY):
        return [VIRTUAL_K64]
    if file.startswith(BOTH) and not file.startswith(HOST_ONLY):
        return [HOST, VIRTUAL_K64]
    return [HOST]


def cost_of(root: Path, run_name: str) -> Path:
    """Returns the file that contains the processor time of a run of the tests."""
    return root / RESULTS / f"{run_name}.cost.json"


def read_recording_factor(root: Path, sources: str) -> float | None:
    """Returns the durations of two runs of the tests of these sources. One run recorded everything,
    and the other run recorded nothing.
    """
    costs = [read_json(cost_of(root, name)) for name in (RUNS[HOST], PLAIN)]
    if any(not isinstance(cost, dict) or cost.get("sources") != sources for cost in costs):
        return None
    recorded, plain = (float(cost["seconds"]) for cost in costs)
    return round(recorded / plain, 2)


def run_hash(root: Path, binding: str) -> str:
    """Returns a hash that identifies the last run of the tests by its time."""
    return file_hash(root / RESULTS / f"{RUNS[binding]}.json")


def read_totals(root: Path) -> dict[str, float] | None:
    """Returns the totals of gcovr, if they belong to the last run on this machine."""
    return count_totals(root) if task_record.is_fresh(root, task_record.COVERAGE) else None


def count_totals(root: Path) -> dict[str, float] | None:
    """Returns the totals of gcovr, if it found a line of the design."""
    record = read_json(root / COVERAGE)
    if not isinstance(record, dict) or not record["line_total"]:
        return None
    return {name: record[name] for name in ("line_percent", "branch_percent")}


def read_results_hash(root: Path, binding: str) -> str | None:
    """Returns the hash of the present sources if the results belong to them. Otherwise, returns a
    different text.
    """
    if not (root / RESULTS / f"{RUNS[binding]}.json").exists():
        return None
    return source_hash(root) if task_record.is_fresh(root, TASKS[binding]) else "other sources"


def read_results(root: Path, binding: str) -> dict[str, Result]:
    """Returns the results by ``Suite.Name``. The instances of a parameterised test count as one
    test.
    """
    return results_in(read_json(root / RESULTS / f"{RUNS[binding]}.json") or {})


def results_in(data: dict[str, Any]) -> dict[str, Result]:
    """Returns the results in the content of a file of results."""
    results: dict[str, Result] = {}
    for suite in data.get("testsuites", []):
        for test in suite.get("testsuite", []):
            name = plain_name(suite["name"], test["name"])
            result = _result(test)
            own = f"{suite['name']}.{test['name']}".replace("/", "_")
            result.recordings.append(own)
            if "/" in test["name"] or TYPE.search(suite["name"]):
                result.instances[own] = result.result
            results[name] = _together(results[name], result) if name in results else result
    return results


def _together(earlier: Result, result: Result) -> Result:
    """Returns the common result of several instances, or of a test with several images. If one
    result is a failure, the common result is a failure.
    """
    worst = earlier if earlier.result == "failed" else result
    failed = {
        name: instance for name, instance in earlier.instances.items() if instance == "failed"
    }
    return Result(
        worst.result,
        earlier.milliseconds + result.milliseconds,
        worst.message,
        list(dict.fromkeys(earlier.recordings + result.recordings)),
        result.measured,
        earlier.instances | result.instances | failed,
        sorted({*earlier.images, *result.images}),
    )


def plain_name(suite: str, name: str) -> str:
    """Removes the prefix and the number of a parameterised test, and the number of a type, from a
    name."""
    whole = TYPE.sub("", suite)
    return f"{whole.rsplit('/', maxsplit=1)[-1]}.{name.split('/', maxsplit=1)[0]}"


def _result(test: dict[str, Any]) -> Result:
    milliseconds = 1000 * float(re.sub("s$", "", str(test.get("time", "0"))))
    images = [str(test["image"])] if "image" in test else []
    failures = [str(item.get("failure", "")) for item in test.get("failures", [])]
    if failures:
        return Result("failed", milliseconds, failures[0], images=images)
    if test.get("status") != "RUN" or test.get("result") == "SKIPPED":
        return Result("skipped", milliseconds, "")
    measured = str(test.get("measured", ""))
    return Result("passed", milliseconds, "", measured=measured, images=images)


def read_driver_faults(root: Path, sources: str) -> list[DriverFault] | None:
    """Returns the faults that were seeded in the drivers of these sources."""
    data = read_json(root / RESULTS / "driver_faults.json")
    if not isinstance(data, dict) or data.get("sources") != sources:
        return None
    return [DriverFault(**item) for item in data["faults"]]


def read_sizes(root: Path) -> dict[str, tuple[int, int]]:
    """Returns the bytes of flash and of RAM of each module."""
    data = read_json(root / RESULTS / "size_k64.json")
    if not isinstance(data, dict):
        return {}
    return {
        name: (int(size["flash"]), int(size["ram"]))
        for name, size in data.items()
        if isinstance(size, dict) and "flash" in size
    }
