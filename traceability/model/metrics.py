"""The metrics of a run. What this run did not measure is null."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from traceability.model.design_model import Model
from traceability.reading.bench_record import bench_metrics, read_bench
from traceability.reading.image_record import read_image
from traceability.reading.products import HAS, intruders, read_products
from traceability.reading.results import read_recording_factor, read_totals
from traceability.reading.seeded_fault_record import read_record
from traceability.reading.traces import nodes_of
from traceability.schema import HOST, Requirement, SafetyCase

METHODS = ("test", "analysis", "measurement", "inspection")  # of verification


def figures(root: Path, model: Model) -> dict[str, Any]:
    """What this run measured of the present sources."""
    tests = {"tests.recording_factor": read_recording_factor(root, model.sources_hash)}
    if not model.stale_on(HOST):
        tests |= coverage(root)
    return metrics(model) | drift(root) | image(root) | bench(root) | forbidden(root) | tests


def coverage(root: Path) -> dict[str, Any]:
    """What the last run of the tests on this machine executed, when gcovr counted it."""
    totals = read_totals(root)
    if totals is None:
        return {}
    return {"coverage.line": totals["line_percent"], "coverage.branch": totals["branch_percent"]}


def drift(root: Path) -> dict[str, Any]:
    """The seeded faults, when they were seeded in the present state of the project."""
    outcomes = read_record(root)
    if outcomes is None:
        return {}
    return {
        "drift.seeded": len(outcomes),
        "drift.caught": sum(outcome.caught for outcome in outcomes),
    }


def image(root: Path) -> dict[str, Any]:
    """The bytes of the image, when it was built from the present sources."""
    record = read_image(root)
    if record is None:
        return {}
    return {"firmware.flash_bytes": record["flash"], "firmware.ram_bytes": record["ram"]}


def forbidden(root: Path) -> dict[str, Any]:
    """How many kinds of what no image may hold are in one, and modules that a product has not."""
    products = read_products(root)
    if products is None:
        return {}
    found = {name: intruders(one["modules"], HAS[name]) for name, one in products.items()}
    return {
        "firmware.forbidden_parts": sum(len(one["forbidden"]) for one in products.values()),
        "firmware.needless_modules": sum(len(one) for one in found.values()),
    }


def bench(root: Path) -> dict[str, Any]:
    """The times of the paper's scenarios, when they were measured with these sources."""
    return {"bench.scenarios": bench_metrics(read_bench(root))}


def metrics(model: Model) -> dict[str, Any]:
    written = [module for module in model.modules.values() if not module.datatype]
    designs = [module for module in written if not module.extension]
    requirements = list(model.requirements.values())
    trees = [nodes_of(item.tree) for item in requirements if item.tree is not None]
    fresh = not model.results_stale
    runs = [run for test in model.tests.values() for run in test.results.values() if run.result]
    applications = list(model.patterns.values())
    decided = all(application.clauses for application in applications)
    return {
        "modules.design": len(designs),
        "modules.extensions": len(written) - len(designs),
        "modules.with_secret": sum(1 for module in designs if module.secret),
        "patterns.applications": len(applications),
        "patterns.conforming": (
            sum(all(clause.holds for clause in item.clauses) for item in applications)
            if decided
            else None
        ),
        "patterns.by_pattern": dict(Counter(item.pattern for item in applications)),
        "requirements.total": len(requirements),
        "requirements.verified": (
            sum(item.state == "verified" for item in requirements) if fresh else None
        ),
        **methods(requirements),
        **safety(model.safety, fresh=fresh),
        "requirements.suspect": sum(bool(item.suspicions) for item in requirements),
        "trees.total": len(trees),
        "trees.static": sum(all(node.reachable for node in nodes) for nodes in trees),
        "trees.executed": (sum(bool(item.runs) for item in requirements) if fresh else None),
        "tests.total": len(runs) if fresh else None,
        "tests.passed": sum(run.result == "passed" for run in runs) if fresh else None,
        "coverage.line": None,
        "coverage.branch": None,
        "coverage.drivers_on_board": _executed(model.board_lines),
        "firmware.flash_bytes": None,
        "firmware.ram_bytes": None,
        "firmware.stack_bytes": model.stack.total if model.stack and model.stack.proven else None,
        "firmware.forbidden_parts": None,
        "firmware.needless_modules": None,
        "bench.scenarios": None,
        "mutation.tried": len(model.mutation.tried) if model.mutation else None,
        "mutation.found": model.mutation.found if model.mutation else None,
        "drift.seeded": None,
        "drift.caught": None,
        "site.pages": None,
        "site.dead_links": None,
        "build.first_page_s": None,
        "build.cold_s": None,
        "build.edit_s": None,
    }


def safety(case: SafetyCase, *, fresh: bool) -> dict[str, Any]:
    """Goals and fault scenarios, with the verdict of this run, and what the functions touched."""
    goals, scenarios = list(case.goals.values()), list(case.scenarios.values())
    return {
        "safety.goals": len(goals),
        "safety.goals_verified": (
            sum(goal.state == "verified" for goal in goals) if fresh else None
        ),
        "safety.fault_scenarios": len(scenarios),
        "safety.fault_scenarios_passed": (
            sum(one.state == "verified" for one in scenarios) if fresh else None
        ),
        "safety.existing_lines_touched": case.cost.for_safety if case.cost else None,
    }


def methods(requirements: Iterable[Requirement]) -> dict[str, Any]:
    """How each requirement is verified. No person independent of the authors has reviewed one."""
    listed = list(requirements)
    counts = Counter(item.method for item in listed)
    return {
        **{f"requirements.by_{name}": counts[name] for name in METHODS},
        "requirements.partly": sum(bool(item.partly) for item in listed),
        "requirements.reviewed_by_person": 0,
    }


def _executed(files: dict[str, dict[int, bool]] | None) -> float | None:
    """In per cent, with one digit."""
    hits = [hit for lines in (files or {}).values() for hit in lines.values()]
    return round(100 * sum(hits) / len(hits), 1) if hits else None
