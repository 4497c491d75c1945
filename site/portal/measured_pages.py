"""Pages with measurements, such as the pages of the virtual K64, of the control performance, of the
mutants and of the baseline design."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from portal import plots
from portal.portal import Portal
from portal.safety_pages import SAFE_MODULE, images_of
from traceability.model.design_model import Model
from traceability.model.made_changes import proven, unproven
from traceability.model.not_shown import unmeasured_drivers
from traceability.reading import baseline_record, closed_loop_record
from traceability.reading.change_kits import touched_lines
from traceability.reading.fault_kinds import fault_kinds, sensor_faults
from traceability.reading.plain_constants import plain_constants
from traceability.reading.products import DEFAULT, HAS, PAPER, PRODUCTS, RECORDED
from traceability.reading.published import FAULTS, FUZZ, OUTCOMES
from traceability.schema import Place

TORTURE = "tests/torture/"
PLAYS_EXAMPLES = "ClosedLoopOfRobot."  # tests that play the scenarios of the closed loop
# Smallest shown difference [instructions in a cycle] between a function of this design and the same
# function of the baseline design.
LEAST_DIFFERENCE = 20


@dataclass
class MissedLines:
    """Source lines of a driver that were not executed, with the functions that contain them.

    ``requirements`` are the requirements of the methods. A function outside classes has the
    requirements of the methods that it calls."""

    place: Place
    functions: list[str]
    requirements: list[str]


@dataclass
class DriverFile:
    """A source file of the drivers, and its source lines that were not executed on the virtual
    K64."""

    path: str
    executed: int
    lines: int
    missed: list[MissedLines]


def virtual_k64(portal: Portal) -> dict[str, Any]:
    return {
        "drivers": driver_coverage(portal),
        "recorded": RECORDED,
        "recorded_product": PAPER,
        "unmeasured": unmeasured_drivers(portal.model),
        "torture": [t for t in portal.model.tests.values() if t.place.file.startswith(TORTURE)],
    }


def driver_coverage(portal: Portal) -> list[DriverFile] | None:
    if portal.model.board_lines is None:
        return None
    return [
        DriverFile(
            path,
            sum(lines.values()),
            len(lines),
            [missed_lines(portal.model, place) for place in missed_runs(path, lines)],
        )
        for path, lines in sorted(portal.model.board_lines.items())
    ]


def missed_lines(model: Model, place: Place) -> MissedLines:
    methods = {m.id: m for m in model.methods if m.body and overlap(m.body, place)}
    functions = [one for one in model.functions.values() if overlap(one.place, place)]
    called = {target for one in functions for call in one.calls for target in call.targets}
    serving = [*methods.values(), *(method for method in model.methods if method.id in called)]
    requirements = {name: None for method in serving for name in method.satisfies}
    return MissedLines(place, [*methods, *(one.id for one in functions)], list(requirements))


def overlap(one: Place, other: Place) -> bool:
    first, last = max(one.line, other.line), min(one.end or one.line, other.end or other.line)
    return one.file == other.file and first <= last


def missed_runs(path: str, lines: dict[int, bool]) -> list[Place]:
    """Returns the ranges of source lines that were not executed. Lines without code do not end a
    range."""
    runs: list[Place] = []
    missed_before = False
    for line, hit in sorted(lines.items()):
        if not hit:
            first = runs.pop().line if missed_before else line
            runs.append(Place(path, first, line))
        missed_before = not hit
    return runs


def closed_loop(portal: Portal) -> dict[str, Any]:
    scenarios = portal.model.closed_loop

    def within(binding: str) -> tuple[int | None, int]:
        """Returns two numbers for a target: the number of metrics within their limits, and the
        number of all metrics. The first number is None if nothing was measured on this target."""
        every = [figure for scenario in scenarios for figure in scenario.figures]
        ran = [figure for figure in every if binding in figure.values]
        return sum(figure.holds(binding) for figure in ran) if ran else None, len(every)

    tests = [t for name, t in portal.model.tests.items() if name.startswith(PLAYS_EXAMPLES)]
    product = closed_loop_record.PRODUCT
    return {
        "product": product,
        "safe": SAFE_MODULE in HAS[product],
        "also": [name for name in images_of(tests) if name in PRODUCTS and name != product],
        "scenarios": scenarios,
        "drawings": {scenario.name: plots.draw_all(scenario.plots) for scenario in scenarios},
        "within": within,
        "number": lambda value: f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}",
    }


def mutation(portal: Portal) -> dict[str, Any]:
    tried = portal.model.mutation.tried if portal.model.mutation else []
    return {
        "rows": [(r, portal.model.mutants_of(r.id)) for r in portal.model.requirements.values()],
        "kinds": Counter(mutant.kind for mutant in tried),
        "survivors": [mutant for mutant in tried if not mutant.killed_by],
    }


MOST_SHOWN = 12  # number of modules in the first table of the page "Evidence of robustness"


def robustness(portal: Portal) -> dict[str, Any]:
    faults = portal.model.campaigns.get(FAULTS)
    return {
        "faults": faults,
        "fuzz": portal.model.campaigns.get(FUZZ),
        "outcomes": OUTCOMES,
        "product": DEFAULT,
        "kinds": fault_kinds(portal.root),
        "sensor_faults": sensor_faults(portal.root),
        "judged": Place("sim/faults/Verdict.hpp", 1),
        "limits": limits_of_outputs(portal.root),
        "wide": True,
        "top": MOST_SHOWN,
        "modules": by_silence(faults.result["modules"]) if faults else [],
    }


def limits_of_outputs(root: Path) -> dict[str, float]:
    """Returns limits of the outputs: the greatest deviations of an output, and the longest times of
    a deviation. The campaign of injected faults compares the outputs with these limits. The result
    is empty if a limit is not found."""
    names = {
        "drive": "kWrongDrive",  # fraction of the supply voltage
        "angle": "kWrongAngle",  # [degree]
        "short": "kShort",  # [ms]
        "late": "kSafeWithin",  # [ms]
    }
    constants = plain_constants(root)
    found = {key: constants.get(f"faults::Verdict::{name}") for key, name in names.items()}
    limits = {key: constant.number for key, constant in found.items() if constant}
    return limits if limits.keys() == names.keys() else {}


def by_silence(modules: dict[str, dict[str, int]]) -> list[tuple[str, dict[str, int]]]:
    """Returns the modules, sorted: first the module with the most silent faults. Among modules with
    the same number of silent faults, the module with the most faults is first. A silent fault makes
    the outputs wrong, but causes no reset and no fault in a report."""
    return sorted(
        modules.items(), key=lambda item: (-item[1]["silent"], -sum(item[1].values()), item[0])
    )


def made_changes(portal: Portal) -> dict[str, Any]:
    """Returns the values for the page of likely changes: the changes that have an example. If a
    change was made in this design and in the baseline design, also returns the number of changed
    source lines in each design."""
    done = [change.made for change in portal.model.changes.values() if change.made]
    return {
        "made": done,
        "unproven": unproven,
        "proven_count": sum(map(proven, done)),
        "makes": Counter(one.extension for one in done),
        "compared": {
            change: {design: touched_lines(text) for design, text in patches.items()}
            for change, patches in patches_of(portal.root).items()
        },
        "titles": baseline_record.TITLES,
        "wide": True,
    }


def patches_of(root: Path) -> dict[str, dict[str, str]]:
    """Returns the text of the patch for each change and each design."""
    return {
        change: {
            design: (root / baseline_record.patch_of(change, design)).read_text("utf-8")
            for design in baseline_record.DESIGNS
        }
        for change in baseline_record.changes_of(root)
    }


def usual_design(portal: Portal) -> dict[str, Any]:
    comparison = baseline_record.read_comparison(portal.root)
    patches = patches_of(portal.root)
    functions = (
        baseline_record.beside(comparison["functions"], LEAST_DIFFERENCE) if comparison else []
    )
    return {
        "found": comparison,
        "record": baseline_record,
        "patches": patches,
        "functions": functions,
        "least": LEAST_DIFFERENCE,
        "parts": costs_of_parts(portal, comparison) if comparison else [],
    }


def costs_of_parts(portal: Portal, comparison: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns the costs of each part of the robot in both designs: the bytes of flash, and the
    number of instructions in a cycle. Also returns the pattern applications of the part. The last
    part contains the other code."""
    parts = portal.model.baseline_parts
    part_of = baseline_record.PartOfLine(portal.root, parts)
    home = {
        app.id: part_of(app.place.file, app.place.line) for app in portal.model.patterns.values()
    }
    rows = [(part.title, part.why) for part in parts] + [("", "")]
    return [
        {
            "title": title,
            "why": why,
            "applications": [name for name, part in home.items() if part == title],
            **{
                design: comparison["parts"][design].get(title, [0, 0])
                for design in baseline_record.DESIGNS
            },
        }
        for title, why in rows
    ]
