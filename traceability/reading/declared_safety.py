"""Reads ``design/safety_case.toml`` and the fault scenarios."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from traceability import schema
from traceability.reading.formulas import value_of
from traceability.reading.toml_reader import Entries
from traceability.sources import files_below

FILE = Path("design/safety_case.toml")
SCENARIOS = Path("sim/scenario/safety")
GOAL_LINE = re.compile(r"#\s*goals?:?\s+(SG-\d+(?:[\s,]+SG-\d+)*)\s*$")
EXPECT = re.compile(r"[^#]*\bexpect\b[^#]*")
COLUMNS, ROWS = ("C0", "C1", "C2", "C3"), ("E0", "E1", "E2", "E3", "E4")


def read_safety_case(root: Path, entries: Entries) -> schema.SafetyCase:
    """Returns the declared safety case with its fault scenarios. Returns an empty safety case if
    the file does not exist."""
    path = root / FILE
    if not path.exists():
        return schema.SafetyCase()
    item: dict[str, Any] = entries.value(path, "item", {})
    risk: dict[str, Any] = entries.value(path, "risk", {})

    of_goal = ["exceptions", "open_points", "parts", "velocity"]
    return linked(
        schema.SafetyCase(
            base=str(entries.value(path, "base", "")),
            says=str(item.get("says", "")),
            conditions=list(item.get("conditions", [])),
            limits=list(item.get("limits", [])),
            risk_source=str(risk.get("source", "")),
            levels=list(risk.get("levels", [])),
            graph={name: rows for name, rows in risk.items() if re.fullmatch(r"S\d", name)},
            words=dict(risk.get("words", {})),
            priorities=dict(risk.get("priority", {})),
            data_sheets=list(entries.value(path, "data_sheets", [])),
            scenarios=read_scenarios(root),
            safe_states=entries.named(path, "safe_state", schema.SafeState, "id"),
            assumptions=entries.named(path, "assumption", schema.Assumption, "id"),
            goals=entries.named(path, "goal", schema.SafetyGoal, "id", may=of_goal),
            hazards=entries.named(path, "hazard", schema.Hazard, "id", may=["scenarios"]),
            corrections=entries.records(path, "correction", schema.Correction, may=["for_safety"]),
        )
    )


def linked(case: schema.SafetyCase) -> schema.SafetyCase:
    """Returns the safety case with computed values: the levels, the values of the formulas, the
    hazards and scenarios of each goal, and the hazards of each assumption."""
    hazards = {
        name: replace(
            hazard, level=level_of(case, hazard.severity, hazard.exposure, hazard.avoidance)
        )
        for name, hazard in case.hazards.items()
    }
    goals: dict[str, schema.SafetyGoal] = {}
    for name, goal in case.goals.items():
        names = [hazard.id for hazard in hazards.values() for word in hazard.goals if word == name]
        level = highest(case, [hazards[name].level for name in names])
        goals[name] = replace(
            goal,
            hazards=names,
            computed=value_of(goal.formula, {}),
            level=level,
            scenarios=[each.name for each in case.scenarios.values() if name in each.goals],
        )
    assumptions = {
        name: replace(
            assumption,
            hazards=[hazard.id for hazard in hazards.values() if name in hazard.assumptions],
        )
        for name, assumption in case.assumptions.items()
    }
    return replace(case, hazards=hazards, goals=goals, assumptions=assumptions)


def level_of(case: schema.SafetyCase, severity: str, exposure: str, avoidance: str) -> str:
    """Returns the performance level that the risk graph requires for these parameters. Returns ""
    if the graph has no such entry."""
    rows = case.graph.get(severity, [])
    if exposure not in ROWS or avoidance not in COLUMNS or len(rows) != len(ROWS):
        return ""
    levels = rows[ROWS.index(exposure)].split()
    return levels[COLUMNS.index(avoidance)] if len(levels) == len(COLUMNS) else ""


def highest(case: schema.SafetyCase, levels: Iterable[str]) -> str:
    valid = [level for level in levels if level in case.levels]
    return max(valid, key=case.levels.index) if valid else ""


def words_of(texts: Iterable[str]) -> list[str]:
    """Returns the single names in texts such as "SG-1, SG-2"."""
    return [word for text in texts for word in re.split(r"[\s,]+", text.strip(" .")) if word]


def read_sources(text: str) -> list[schema.SourceReference]:
    """Returns the references in a text such as "goal: SG-2; paper: Section VII". If a reference
    does not begin with a valid kind and a colon, its kind is ""."""
    sources: list[schema.SourceReference] = []
    for part in filter(None, (reference.strip() for reference in text.split(";"))):
        kind, colon, name = part.partition(":")
        known = kind.strip() if colon and kind.strip() in schema.SOURCE_KINDS else ""
        name = name.strip().rstrip(".") if known else part
        sources.append(schema.SourceReference(known, name))
    return sources


# ---- fault scenarios ------------------------------------------------------------


def read_scenarios(root: Path) -> dict[str, schema.FaultScenario]:
    """Returns the fault scenarios by name. The first comment in a scenario file is the title. A
    comment "# goal SG-1" names a safety goal."""
    paths = files_below(root, (str(SCENARIOS),), (".scenario",))
    return {path.stem: _scenario(root, path) for path in paths}


def _scenario(root: Path, path: Path) -> schema.FaultScenario:
    lines = path.read_text(encoding="utf-8").splitlines()
    goals = [match[1] for line in lines if (match := GOAL_LINE.match(line))]
    first = itertools.takewhile(lambda line: line.startswith("#"), lines)
    title = " ".join(line.strip("# ") for line in first if not GOAL_LINE.match(line))
    place = schema.Place(str(path.relative_to(root)), 1)
    expects = {
        number: match[0].strip()
        for number, line in enumerate(lines, 1)
        if (match := EXPECT.match(line))
    }
    return schema.FaultScenario(path.stem, title or path.stem, words_of(goals), place, expects)
