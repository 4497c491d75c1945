"""Computes the metrics of a run. If this run did not measure a metric, the metric is null in
``build/metrics.json``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from traceability import schema
from traceability.model.design_model import Model
from traceability.model.made_changes import proven
from traceability.model.report import Report
from traceability.model.response_times import CLOCK
from traceability.reading import task_record
from traceability.reading.bench_record import IMAGE, MANUAL, bench_metrics
from traceability.reading.lint_record import read_prose
from traceability.reading.products import HAS, intruders
from traceability.reading.proof_record import PROVE
from traceability.reading.published import LOADS, Published, campaign_metrics
from traceability.reading.published import METRICS as CAMPAIGNS
from traceability.reading.results import (
    COVERAGE,
    LIVE,
    RELEASE,
    TOTALS,
    read_fresh,
    read_object,
    read_recording_factor,
    read_times,
)
from traceability.reading.traces import nodes_of
from traceability.sources import file_hash, files_below
from weeding_robot_client.layout import LAYOUTS

# file of a task -> the task, and the key of each metric in this file
OF_TASKS = {
    TOTALS: (
        task_record.IMAGES,
        {"firmware.flash_bytes": "flash", "firmware.ram_bytes": "ram"},
    ),
    COVERAGE: (
        task_record.COVERAGE,
        {"coverage.line": "line_percent", "coverage.branch": "branch_percent"},
    ),
    LIVE: (
        task_record.LIVE,
        {
            f"live.{key}": key
            for key in ("ready_s", "bytes", "real_time_factor", "scenarios_equal", "scenarios")
        },
    ),
}
METHODS = ("test", "analysis", "measurement", "inspection")  # methods of verification
OF_OTHER_STEPS = (  # metrics that are null until a step measures them
    *(metric for _, keys in OF_TASKS.values() for metric in keys),
    *("firmware.forbidden_parts", "firmware.needless_modules"),
    *("firmware.largest_flash_bytes", "firmware.largest_ram_bytes"),
    *("bench.scenarios", "bench.image_sha256", "sim.real_time_factor"),
    *("drift.seeded", "drift.caught", "portal.axe_violations", "portal.search_first_hit"),
    "portal.search_unseen_first_hit",
    *("site.pages", "site.dead_links", "build.first_page_s"),
    *("changes.proven", "bench.wcet_cycle_ms", "bench.wcet_ratio", "bench.longest_lock_us"),
    *("bench.wcet_cycle_with_noise_ms", "bench.wcet_ratio_with_noise", "bench.paths_ms"),
    *("build.cold_s", "build.edit_s", "build.ci_s", "release.reproducible"),
    *("tools.python_lines", "tools.python_test_lines", "tools.design_lines"),
    *CAMPAIGNS,
)


def read_measured(root: Path, model: Model) -> dict[str, Any]:
    """Reads the metrics that other steps measured with the present sources."""
    tests = {"tests.recording_factor": read_recording_factor(root, model.sources_hash)}
    if not model.stale_on(schema.HOST):
        tests |= of_task(root, COVERAGE)
    times: dict[str, Any] = {"bench.scenarios": bench_metrics(model.bench)}
    if model.bench is not None:
        speeds = (scenario.runs[MANUAL].speed for scenario in model.bench.values())
        times |= {
            "bench.image_sha256": file_hash(root / IMAGE),
            "sim.real_time_factor": min((speed for speed in speeds if speed), default=None),
        }
    prose = {"prose.findings": read_prose(root)}
    recorded = of_task(root, TOTALS) | of_task(root, LIVE) | release(root, model.commit)
    values = drift(model) | recorded | times | forbidden(model) | tests | prose
    return values | changes(model) | sizes(root) | read_times(root)


def of_task(root: Path, file: Path) -> dict[str, Any]:
    """Returns the metrics in the file of a task. Returns no metric if the inputs of the task have
    changed since the task wrote the file."""
    task, keys = OF_TASKS[file]
    record = read_fresh(root, file, task)
    return {metric: record.get(key) for metric, key in keys.items()} if record else {}


def release(root: Path, commit: str) -> dict[str, Any]:
    """Returns a metric that states whether the files of the two builds of this commit are equal
    byte by byte. Returns no metric if the builds were not compared."""
    record = read_object(root / RELEASE)
    if not record or not commit or not record["commit"].startswith(commit):
        return {}
    return {"release.reproducible": record["reproducible"]}


def sizes(root: Path) -> dict[str, int]:
    """Returns three numbers of lines: in the Python files of the tools, in the Python tests, and in
    the TOML files of the design."""
    parts = {
        "tools.python_lines": (("traceability", "site", "tools"), ".py"),
        "tools.python_test_lines": (("tests/python",), ".py"),
        "tools.design_lines": (("design",), ".toml"),
    }
    return {
        name: sum(file.read_bytes().count(b"\n") for file in files_below(root, folders, (suffix,)))
        for name, (folders, suffix) in parts.items()
    }


def changes(model: Model) -> dict[str, Any]:
    """Returns the number of made changes for which all tests passed. Returns no metric if a test of
    a made change did not run with the present sources."""
    made = [change.made for change in model.changes.values()]
    ran = all(test.result for change in made if change for test in change.tests)
    return {"changes.proven": sum(map(proven, made))} if ran else {}


def drift(model: Model) -> dict[str, Any]:
    """Returns the number of seeded faults, and the number of seeded faults that a check found.
    Returns no metric if files have changed since the faults were seeded."""
    if model.outcomes is None:
        return {}
    return {
        "drift.seeded": len(model.outcomes),
        "drift.caught": sum(outcome.caught for outcome in model.outcomes),
    }


def forbidden(model: Model) -> dict[str, Any]:
    """Counts the forbidden parts in the firmware images of all products, and the modules that do
    not belong to the product of their image. Also returns the greatest flash and RAM of an image.
    """
    products = model.products
    if products is None:
        return {}
    images = products.values()
    return {
        "firmware.forbidden_parts": sum(len(image.forbidden) for image in images),
        "firmware.needless_modules": sum(
            len(intruders(image.modules, HAS[name])) for name, image in products.items()
        ),
        "firmware.largest_flash_bytes": max((image.flash for image in images), default=None),
        "firmware.largest_ram_bytes": max((image.ram for image in images), default=None),
    }


def metrics(model: Model, report: Report) -> dict[str, Any]:
    """Returns all metrics: the metrics of the model, and the numbers of verdicts of this run."""
    fresh = not model.results_stale
    states = Counter(verdict.state for verdict in report.requirements.values())
    return {
        **figures(model, report.clauses),
        "requirements.verified": states["verified"] if fresh else None,
        **safety(model.safety, report, fresh=fresh),
    }


def figures(model: Model, clauses: Mapping[str, Sequence[schema.Clause]]) -> dict[str, Any]:
    """Returns the metrics that do not depend on verdicts of requirements."""
    written = [module for module in model.modules.values() if not module.datatype]
    designs = [module for module in written if not module.extension]
    requirements = list(model.requirements.values())
    trees = [nodes_of(item.tree) for item in requirements if item.tree is not None]
    fresh = not model.results_stale
    runs = [run for test in model.tests.values() for run in test.results.values() if run.result]
    applications = list(model.patterns.values())
    decided = all(clauses.get(application.id) for application in applications)
    missed, lines = driver_lines(model)

    def conforms(application: schema.PatternApplication) -> bool:
        return all(clause.holds for clause in clauses[application.id])

    return {
        "modules.design": len(designs),
        "modules.extensions": len(written) - len(designs),
        "modules.with_secret": sum(1 for module in designs if module.secret),
        "patterns.applications": len(applications),
        "patterns.conforming": sum(map(conforms, applications)) if decided else None,
        "changes.total": len(model.changes),
        "changes.existing_lines_touched": sum(
            change.made.outside_lines for change in model.changes.values() if change.made
        ),
        "patterns.by_pattern": dict(Counter(item.pattern for item in applications)),
        "requirements.total": len(requirements),
        **methods(requirements),
        "requirements.suspect": sum(bool(item.suspicions) for item in requirements),
        "trees.total": len(trees),
        "trees.static": sum(all(node.reachable for node in nodes) for nodes in trees),
        "trees.one_node": sum(len(nodes) == 1 for nodes in trees),
        "trees.executed": sum(_is_executed(item) for item in requirements) if fresh else None,
        "tests.total": len(runs) if fresh else None,
        "tests.passed": sum(run.result == "passed" for run in runs) if fresh else None,
        "tests.skipped": sum(run.result == "skipped" for run in runs) if fresh else None,
        "coverage.drivers_on_board": round(100 * (lines - missed) / lines, 1) if lines else None,
        "firmware.stack_bytes": model.stack.total if model.stack and model.stack.proven else None,
        "patterns.price": {name: asdict(price) for name, price in model.prices.items()} or None,
        "bench.seen_cycle_ms": model.times.seen_ms if model.times else None,
        "mutation.tried": len(model.mutation.tried) if model.mutation else None,
        "mutation.found": model.mutation.found if model.mutation else None,
        "mutation.justified": model.mutation.justified if model.mutation else None,
        "protocol.report_bytes": LAYOUTS["Report"].size,
        "proofs.properties": len(model.proofs.properties),
        "proofs.proven": None if model.proofs.recorded else model.proofs.proven,
        "last": {
            **{name: with_others(record) for name, record in model.last.items()},
            **campaign_metrics(model.campaigns),
            **recorded_metric(model.proofs),
        },
        **dict.fromkeys(OF_OTHER_STEPS),
        **_proven_times(model.times, model.campaigns.get(LOADS)),
        **model.measured,
    }


def with_others(record: schema.LastRecord) -> dict[str, Any]:
    """Returns a record with the number of faults that the tests did not find, and with a sentence
    that states whether the run tried all possible faults."""
    return {**asdict(record), "others": record.tried - record.found, "extent": record.extent}


def recorded_metric(proofs: schema.Proofs) -> dict[str, Any]:
    """Returns the number of proofs for which this build used the record of an earlier run. The
    metric also contains the command, the commit and the date of the earlier run."""
    if not proofs.recorded:
        return {}
    first = proofs.recorded[0]
    record = {"command": PROVE, "commit": first.recorded, "date": first.recorded_on}
    return {"proofs.proven": {**record, "value": len(proofs.recorded)}}


def _proven_times(proof: schema.TimeProof | None, drives: Published | None) -> dict[str, Any]:
    """Returns upper bounds of times: of a cycle without noise, of a cycle with noise at all inputs,
    of each path, and of a lock of the interrupts. Also returns two ratios: each bound of a cycle,
    divided by the longest measured time of this cycle."""
    if proof is None or not proof.proven:
        return {}
    outcomes = drives.result["outcomes"] if drives else {}
    longest = max(proof.seen_ms or 0, outcomes.get("longest_ms") or 0)
    noisy = outcomes.get("noise_ms")
    paths = {
        path.name: {
            "bound": round(path.ms, 3),
            "seen": None if path.seen_ms is None else round(path.seen_ms, 3),
        }
        for path in proof.paths
    }
    return {
        "bench.wcet_cycle_ms": round(proof.cycle_ms, 3),
        "bench.wcet_ratio": round(proof.cycle_ms / longest, 2) if longest else None,
        "bench.longest_lock_us": round(1000 * proof.locked / CLOCK, 2),
        "bench.wcet_cycle_with_noise_ms": round(proof.noise_ms, 3),
        "bench.wcet_ratio_with_noise": round(proof.noise_ms / noisy, 2) if noisy else None,
        "bench.paths_ms": paths,
    }


def _is_executed(requirement: schema.Requirement) -> bool:
    """Returns true if a recorded test contains all calls of the requirement's invocation tree. The
    result is false for a tree with only one node, because such a tree has no call to record."""
    tree = requirement.tree
    return bool(requirement.runs and tree is not None and tree.children)


def safety(case: schema.SafetyCase, report: Report, *, fresh: bool) -> dict[str, Any]:
    """Counts all safety goals and fault scenarios, and those that this run verified.
    Also returns the number of existing lines that were edited for safety functions."""
    goals = Counter(goal.state for goal in report.goals.values())
    scenarios = Counter(report.scenarios.values())
    return {
        "safety.goals": len(case.goals),
        "safety.goals_verified": goals["verified"] if fresh else None,
        "safety.fault_scenarios": len(case.scenarios),
        "safety.fault_scenarios_passed": scenarios["verified"] if fresh else None,
        "safety.existing_lines_touched": case.cost.for_safety if case.cost else None,
    }


def methods(requirements: Iterable[schema.Requirement]) -> dict[str, Any]:
    """Returns the number of requirements for each method of verification, the number of partly
    verified requirements, and the number of requirements that a person has reviewed."""
    listed = list(requirements)
    counts = Counter(item.method for item in listed)
    return {
        **{f"requirements.by_{name}": counts[name] for name in METHODS},
        "requirements.partly": sum(bool(item.partly) for item in listed),
        "requirements.reviewed_by_person": sum(item.reviewed for item in listed),
    }


def driver_lines(model: Model) -> tuple[int, int]:
    """The image with recorded lines contains drivers. Returns two numbers for the source lines of
    these drivers: the lines that were not executed, and all lines. Both numbers are 0 if the lines
    were not measured."""
    hits = [hit for lines in (model.board_lines or {}).values() for hit in lines.values()]
    return hits.count(False), len(hits)
