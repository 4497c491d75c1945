"""The page of the safety case, and the page of the cost of the safety extensions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from portal.portal import Page, Portal
from portal.recorded_calls import recordings_of
from traceability.model.safety_case import scenarios_of
from traceability.reading import bench_record, call_record, closed_loop_record
from traceability.reading.products import CALLS_SUFFIX, DEFAULT, HAS, PAPER, PRODUCTS, RECORDED
from traceability.reading.published import FAULTS, FUZZ
from traceability.schema import BenchScenario, FaultScenario, SafetyGoal, Test

TIMING = "no-wait-states"
SAFE_MODULE = "SafeSystem"  # Only the products with safety functions contain this module.
MEASURED = f"{bench_record.IMAGE.stem}; without the slow flash also {PAPER}"
LOOP = closed_loop_record.PRODUCT
RECORDINGS = f"{call_record.IMAGE.stem}{CALLS_SUFFIX}"
ON_HOST = "the code on the host, without the code for the K64"


def safety(portal: Portal) -> dict[str, Any]:
    case = portal.model.safety
    levels = Counter(hazard.level for hazard in case.hazards.values())
    return {
        "case": case,
        "figures": portal.metrics,
        "by_level": [(level, levels[level]) for level in reversed(case.levels)],
        "open_points": list(open_points(portal)),
        "tested": product_runs(portal),
        "evidence": evidence(portal),
        "played_on": played_on(portal, case.scenarios.values()),
    }


def evidence(portal: Portal) -> tuple[tuple[str, str, str, object], ...]:
    """Returns the evidence besides the tests: its title, the page that shows it, the firmware image
    or code to which it applies, and a result. The result is None or empty if the pages show no
    result."""
    model = portal.model
    played = any(scenario.runs for scenario in model.closed_loop)
    drivers, lines = model.board_lines, portal.metrics["coverage.line"]
    return (
        ("longest control cycle, calculated", "bench.html#bound", DEFAULT, model.times),
        ("control cycle, measured", "bench.html", MEASURED, model.bench),
        ("stack, calculated", "execution.html#stack", DEFAULT, model.stack),
        ("stack, measured", "execution.html#stack", LOOP, model.stack and model.stack.seen),
        ("distances, settling times and other values", "closed_loop.html", LOOP, played),
        ("recorded calls and chains", "cycle.html", RECORDINGS, recordings_of(portal)),
        ("random faults", "robustness.html", DEFAULT, model.campaigns.get(FAULTS)),
        ("random inputs", "robustness.html#fuzz", ON_HOST, model.campaigns.get(FUZZ)),
        ("model checking", "proofs.html#scope", f"a model of {DEFAULT}", model.proofs.results),
        ("coverage of the code for the K64", "virtual_k64.html#drivers", RECORDED, drivers),
        ("coverage of the other code", "requirements/index.html#module-coverage", ON_HOST, lines),
        ("mutation test", "mutation.html", ON_HOST, model.last.get("mutation")),
    )


def open_points(portal: Portal) -> Iterator[tuple[str, str, str]]:
    """Yields the known exceptions and the open points of the safety goals. Also yields the missing
    part of each partly verified requirement. Each item has an id, a kind and a text."""
    for goal in portal.model.safety.goals.values():
        yield from ((goal.id, "known exception", text) for text in goal.exceptions)
        yield from ((goal.id, "open point", text) for text in goal.open_points)
    for requirement in portal.model.requirements.values():
        if requirement.partly:
            yield requirement.id, "partly verified", requirement.partly


@dataclass
class ProductRuns:
    """A product, and the numbers of tests and fault scenarios that ran its firmware image on the
    virtual board."""

    name: str
    safe: bool  # whether the product has safety functions
    tests: int
    scenarios: int


def product_runs(portal: Portal) -> list[ProductRuns]:
    tests = portal.model.tests.values()
    scenarios = portal.model.safety.scenarios.values()
    return [
        ProductRuns(
            name,
            SAFE_MODULE in HAS[name],
            sum(name in images_of([test]) for test in tests),
            sum(name in played_on(portal, [scenario]) for scenario in scenarios),
        )
        for name in PRODUCTS
    ]


def played_on(portal: Portal, scenarios: Iterable[FaultScenario]) -> list[str]:
    """Returns the firmware images with which the tests played these scenarios."""
    names = {name for scenario in scenarios for name in scenario.tests}
    return images_of(portal.model.tests[name] for name in sorted(names))


def images_of(tests: Iterable[Test]) -> list[str]:
    """Returns the firmware images on which the tests ran."""
    return sorted(
        {image for test in tests for run in test.results.values() for image in run.images}
    )


def hazards_page(portal: Portal) -> Page:
    return portal.page("safety/hazards", "Hazards", "safety", "hazards", case=portal.model.safety)


def goal_page(portal: Portal, goal: SafetyGoal) -> Page:
    model = portal.model
    return portal.page(
        f"safety/{goal.id}",
        goal.id,
        "safety",
        "safety_goal",
        case=model.safety,
        goal=goal,
        verdict=portal.report.goals[goal.id],
        requirements=[model.requirements[name] for name in goal.requirements],
        scenarios=scenarios_of(model, goal),
        played_on=played_on(portal, scenarios_of(model, goal)),
    )


@dataclass
class Compared:
    """A measured value of two products: with and without the safety functions."""

    title: str
    unit: str
    safe: float | None
    paper: float | None

    @property
    def difference(self) -> float | None:
        return None if self.safe is None or self.paper is None else self.safe - self.paper


def cost(portal: Portal) -> dict[str, Any]:
    return {
        "case": portal.model.safety,
        "cost": portal.model.safety.cost,
        "compared": [*sizes(portal), *cycles(portal)],
        "products": (DEFAULT, PAPER),
    }


def sizes(portal: Portal) -> Iterator[Compared]:
    products = portal.model.products or {}
    safe, paper = products.get(DEFAULT), products.get(PAPER)
    kinds = {"flash": "flash of the image", "ram": "RAM of the image, stack included"}
    for key, title in kinds.items():
        yield Compared(title, "bytes", getattr(safe, key, None), getattr(paper, key, None))


def cycles(portal: Portal) -> Iterator[Compared]:
    """Yields the longest time from the clock pulse to the report in each scenario of the bench."""
    safe, paper = portal.model.bench, portal.model.bench_paper
    names = list(safe or {}) or ["any scenario of the bench"]
    for name in names:
        title = f"longest control cycle, {name.replace('_', ' ')}"
        yield Compared(title, "ms", longest(safe, name), longest(paper, name))


def longest(record: Mapping[str, BenchScenario] | None, name: str) -> float | None:
    """Returns the longest time in a scenario of the bench [ms], or ``None`` when it was not
    measured."""
    run = record[name].runs.get(TIMING) if record and name in record else None
    return run.report_ms.maximum if run else None
