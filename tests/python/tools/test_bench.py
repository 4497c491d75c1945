"""./wr bench: the orders of its scenarios, the reports of a board, and its failures."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tools import cli
from tools.bench import costs, wishes
from tools.steps import FailureError
from traceability.reading.bench_record import (
    BENCH,
    CYCLES,
    FOLDER,
    SCENARIOS,
    measured_orders,
)
from traceability.schema import Spread
from weeding_robot_client.exit_codes import MISSING

pytestmark = pytest.mark.reads("sim/scenario/bench")

ROOT = Path(__file__).parents[3]


def scenario(name: str) -> str:
    return (ROOT / FOLDER / f"{name}.scenario").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", [paper.name for paper in SCENARIOS])
def test_each_scenario_orders_for_1000_cycles_after_its_start(name: str) -> None:
    orders = scenario(name)
    assert len(list(wishes(orders, None))) == CYCLES + 8
    assert len(list(wishes(orders, 1))) == 11


def test_the_orders_have_the_values_of_the_paper() -> None:
    first = [wish.wheels[3].value for wish in wishes(scenario("velocity"), None)][8:]
    assert first == [0.0] * 500 + [50.0] * 500
    second = list(wishes(scenario("velocity_and_steering"), None))[8:]
    assert {point.value for wish in second for point in wish.wheels} == {50.0}
    assert {wish.steering_degrees for wish in second} == {32.0, -32.0}
    for name in ("steps", "steps_and_steering"):
        steps = [wish.wheels[3].value for wish in wishes(scenario(name), None)]
        levels = [value for before, value in zip([-1.0, *steps], steps, strict=False)
                  if value != before]  # fmt: skip
        assert levels == [0, 50, 100, 150, 200, 250, 300, 250, 200, 150, 100, 50, 0]


def test_the_measured_cycles_are_the_last_ones() -> None:
    orders = measured_orders(scenario("velocity"))
    assert [order.velocity for order in orders] == [0.0] * 500 + [50.0] * 500


def cycle(**values: int) -> Any:
    report = {"order_read": True, "report_cycles": 0, "awake_cycles": 0, "start_cycles": 0}
    return SimpleNamespace(**(report | values))


def test_what_a_board_tells_becomes_the_figures() -> None:
    first = [cycle(report_cycles=9_999_999), cycle(report_cycles=9_999_999)]
    reports = [
        *first,
        cycle(report_cycles=24_000, awake_cycles=120_000, start_cycles=600),
        cycle(report_cycles=48_000, awake_cycles=360_000, start_cycles=1200),
        cycle(order_read=False, report_cycles=9_999_999),
    ]
    found = costs(reports)
    assert found.cycles == 2
    assert found.report_ms == Spread(average=0.3, minimum=0.2, maximum=0.4)
    assert found.load.average == 2.0
    assert found.jitter_us == 5.0


def test_a_robot_that_counts_no_cycles_measures_nothing() -> None:
    with pytest.raises(FailureError, match="does not count processor cycles"):
        costs([cycle()] * 5)
    with pytest.raises(FailureError, match="at most two orders"):
        costs([])


def test_seconds_need_a_port(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as error:
        cli.main(["bench", "--seconds", "3"])
    assert error.value.code == 2
    assert "--seconds 3 needs --port" in capsys.readouterr().err


def test_a_port_that_is_not_there_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for paper in SCENARIOS:
        file = tmp_path / FOLDER / f"{paper.name}.scenario"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(scenario(paper.name))
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    assert cli.main(["bench", "--port", str(tmp_path / "nothing")]) == MISSING
    assert "connect the board" in capsys.readouterr().err
    assert not (tmp_path / BENCH).exists()
