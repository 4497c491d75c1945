"""The conversion of curves to drawings."""

import pytest

from portal.bench_page import bands, steps
from portal.plots import axis, draw
from traceability.reading.bench_record import MANUAL, SLOW
from traceability.schema import HOST, VIRTUAL_K64, BenchRun, Curve, LoopPlot, Spread


def curve(kind: str, binding: str, *values: float) -> Curve:
    return Curve(kind, binding, [(float(at), value) for at, value in enumerate(values)])


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (0.0, 150.0, ["0", "50", "100", "150"]),
        (-2.7, 4.4, ["-4", "-2", "0", "2", "4", "6"]),
        (0.0, 0.0, ["0", "0.2", "0.4", "0.6", "0.8", "1"]),
        (0.0, 0.87, ["0", "0.2", "0.4", "0.6", "0.8", "1"]),
        (-3200.0, 1000.0, ["-4000", "-3000", "-2000", "-1000", "0", "1000"]),
    ],
)
def test_an_axis_has_round_values_around_all(low: float, high: float, texts: list[str]) -> None:
    found = axis(low, high, rounded=True)
    assert [tick.text for tick in found.ticks] == texts
    assert (found.ticks[0].at, found.ticks[-1].at) == (0.0, 100.0)


def test_a_set_point_is_drawn_once_and_in_steps() -> None:
    plot = LoopPlot(
        "Velocity",
        "rpm",
        [curve("set_point", binding, 0, 100) for binding in (HOST, VIRTUAL_K64)]
        + [curve("truth", binding, 0, 50, 100) for binding in (HOST, VIRTUAL_K64)],
    )
    drawing = draw(plot)
    assert drawing
    assert [line.words for line in drawing.lines] == [
        "set-point",
        "truth, host",
        "truth, virtual K64",
    ]
    assert drawing.lines[0].path == "M0.0 300.0H500.0V0.0"
    assert drawing.lines[1].path == "M0.0 300.0L500.0 150.0L1000.0 0.0"
    assert [line.kind for line in drawing.lines] == ["set-point", "truth host", "truth board"]
    assert "truth, host ends at 100" in drawing.words


def test_the_set_points_of_a_scenario_are_drawn_in_steps() -> None:
    drawing = steps("Set-point of the steering", "degrees", [-32.0, -32.0, 32.0, 32.0])
    assert [tick.text for tick in drawing.y] == ["-32", "0", "32"]
    assert drawing.lines[0].path == "M0.0 300.0H500.0V0.0H1000.0V0.0"
    assert drawing.words == "Set-point of the steering: 2 values from -32 to 32 degrees"


def test_the_longest_cycle_of_all_models_of_time_is_marked() -> None:
    spread = Spread(0.0, 0.0, 0.0)

    def run(*times_us: int) -> BenchRun:
        return BenchRun(spread, spread, spread, 0.0, times_us, len(times_us))

    quick, slow = run(100, 250, 100, 100), run(200, 200, 200, 500)
    (mark,) = bands({MANUAL: quick, SLOW: slow}).marks
    assert (mark.words, mark.across, mark.up) == ("maximum 0.500", 75.0, 100.0)
    (mark,) = bands({MANUAL: quick}).marks
    assert mark.words == "maximum 0.250"
