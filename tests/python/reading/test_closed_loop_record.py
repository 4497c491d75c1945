"""Curves and values of the runs in closed loop."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.python.project_files import write_files
from tests.python.reading.task_records import record_task
from traceability.reading.closed_loop_record import csv_of, declared, measure, read_closed_loop
from traceability.reading.task_record import CLOSED_LOOP
from traceability.schema import HOST, VIRTUAL_K64
from weeding_robot_client.layout import LAYOUTS

pytestmark = pytest.mark.reads("design/closed_loop.toml", "sim/scenario/GroundTruth.cpp")

ROOT = Path(__file__).parents[3]

DECLARED = """\
[[scenario]]
name = "step"
title = "A step"
says = "It steps."

[[scenario.plot]]
title = "Velocity"
unit = "rpm"
scale = 0.1
set_point = "set_point0"
measured = "velocity0"
truth = "true_velocity0"

[[scenario.figure]]
title = "Peak"
kind = "peak"
column = "true_velocity0"
from = 100
to = 400
scale = 0.1
limit = 101
unit = "rpm"
requirement = "FR-1"
"""
HEADER = "time_ms,at_ms,measured,applied,set_point0,velocity0,true_velocity0\n"


def project(root: Path, rows: str) -> Path:
    runs = {"step": {HOST: {"passed": True, "said": ""}}}
    files = {
        "design/closed_loop.toml": DECLARED,
        str(csv_of("step", HOST)): HEADER + rows,
        "build/results/closed_loop.json": json.dumps({"runs": runs}),
    }
    write_files(root, files)
    record_task(root, CLOSED_LOOP, "design")
    return root


ROWS = "100,110,1,0,1000,0,0\n200,210,0,0,1000,0,-1012\n300,310,1,0,1000,990,990\n"


def test_a_run_has_its_curves_without_missing_values(tmp_path: Path) -> None:
    (scenario,) = read_closed_loop(project(tmp_path, ROWS))
    (plot,) = scenario.plots
    curves = {curve.kind: curve.points for curve in plot.curves}
    assert {curve.binding for curve in plot.curves} == {HOST}
    assert curves["set_point"] == [(0.1, 100.0), (0.2, 100.0), (0.3, 100.0)]
    assert curves["measured"] == [(0.1, 0.0), (0.3, 99.0)]
    assert curves["truth"] == [(0.11, 0.0), (0.21, pytest.approx(-101.2)), (0.31, 99.0)]


def test_a_figure_holds_up_to_its_limit_where_it_was_run(tmp_path: Path) -> None:
    (scenario,) = read_closed_loop(project(tmp_path, ROWS))
    (figure,) = scenario.figures
    assert figure.values == {HOST: pytest.approx(101.2)}
    assert not figure.holds(HOST)
    figure.values[HOST] = 101.0
    assert figure.holds(HOST)
    figure.values[HOST] = None
    assert not figure.holds(HOST)
    assert scenario.runs[HOST].passed
    assert VIRTUAL_K64 not in scenario.runs


def test_a_run_of_other_sources_is_none(tmp_path: Path) -> None:
    root = project(tmp_path, ROWS)
    (root / "design/closed_loop.toml").write_text(f"{DECLARED}\n# changed\n")
    (scenario,) = read_closed_loop(root)
    assert scenario.runs == {}
    assert scenario.figures[0].values == {}
    assert scenario.plots[0].curves == []


POINTS = [(0.0, 0.0), (500.0, 90.0), (1000.0, 104.0), (1500.0, 99.0), (2000.0, 101.0)]


@pytest.mark.parametrize(
    ("figure", "points", "value"),
    [
        ({"kind": "settling", "from": 100, "target": 100, "band": 2}, POINTS, 1400.0),
        ({"kind": "settling", "from": 100, "target": 100, "band": 0.5}, POINTS, None),
        ({"kind": "settling", "from": 0, "target": -100, "band": 5}, [(0.0, -96.0)], 0.0),
        ({"kind": "overshoot", "target": 100}, POINTS, 4.0),
        ({"kind": "overshoot", "target": -100}, [(0.0, -99.0)], 0.0),
        ({"kind": "mean_error", "target": 100}, POINTS[2:], 1.5),
        ({"kind": "mean_error", "target": 100}, [(0.0, 98.0), (100.0, 104.0)], 1.0),
        ({"kind": "error", "target": 100, "scale": 0.1}, POINTS[1:], 1.0),
        ({"kind": "peak", "scale": 0.1}, [(0.0, -50.0), (1.0, 20.0)], 5.0),
        ({"kind": "peak"}, [], None),
    ],
)
def test_each_kind_of_figure(
    figure: dict[str, Any], points: list[tuple[float, float]], value: float | None
) -> None:
    found = measure(figure, points)
    assert found == (value if value is None else pytest.approx(value))


def test_an_unknown_kind_is_told() -> None:
    with pytest.raises(ValueError, match="unknown kind of metric 'area'"):
        measure({"kind": "area"}, POINTS)


def test_each_scenario_of_the_project_is_a_file_and_names_columns_that_exist() -> None:
    fields = {one.name for one in LAYOUTS["Report"].fields}
    truth = (ROOT / "sim/scenario/GroundTruth.cpp").read_text()
    for item in declared(ROOT):
        assert (ROOT / f"sim/scenario/examples/{item['name']}.scenario").is_file()
        columns = [figure["column"] for figure in item.get("figure", [])]
        for plot in item["plot"]:
            columns += [plot[kind] for kind in ("set_point", "measured", "truth") if kind in plot]
        for name in columns:
            assert f'"{name}"' in truth or name in fields, name
