"""The labels of state diagrams do not cover the arrows of other transitions."""

from __future__ import annotations

from portal.label_places import Box, best_move, points

LABEL = Box(100, 92, 200, 106)


def test_points_are_on_the_curve() -> None:
    found = list(points("M0,0 C0,10 20,10 20,0 C20,-10 40,-10 40,0 "))
    assert (found[0], found[-1]) == ((0, 0), (40, 0))
    assert (20, 0) in found
    assert max(y for _, y in found) == 7.5  # the middle of the first curve


def test_a_label_without_a_line_stays() -> None:
    assert best_move([LABEL], ["M0,0 C100,0 200,0 300,0 "], []) == 0


def test_a_label_leaves_the_line_of_another_edge() -> None:
    """The arrow is at y = 103. The nearest free position of the label is 8 units higher."""
    line = "M50,103 C100,103 200,103 250,103 "
    assert best_move([LABEL], [line], []) == -8


def test_a_label_does_not_move_onto_another_text() -> None:
    line = "M50,103 C100,103 200,103 250,103 "
    above = Box(100, 80, 200, 92)
    assert best_move([LABEL], [line], [above]) == 14


def test_all_lines_of_a_label_move_together() -> None:
    below = Box(100, 106, 200, 120)
    line = "M50,110 C100,110 200,110 250,110 "
    assert best_move([LABEL, below], [line], []) == -14
