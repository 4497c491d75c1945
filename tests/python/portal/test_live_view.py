"""The scenarios of the page "Run the robot"."""

from __future__ import annotations

from portal.live_view import first_comment


def test_the_description_of_a_scenario_is_its_whole_first_comment() -> None:
    text = "\n# The robot drives\n# uphill.\n\nseed 1\n# Later.\n"
    assert first_comment(text) == "The robot drives uphill."
    assert first_comment("seed 1\n") == ""
