"""The kinds of faults of the campaign, as the sources of the campaign explain them."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.reading.fault_kinds import enumerators, fault_kinds, sensor_faults

pytestmark = pytest.mark.reads("sim/faults", "sim/plant")

ROOT = Path(__file__).parents[3]
ENUMERATION = """\
enum class Fault : std::uint8_t {
  Current,  ///< the cable is broken;
            ///< its input is pulled to 0 V
  Drift     ///< the sensor drifts; value: mA
};
"""


def test_a_comment_of_several_lines_belongs_to_one_enumerator(tmp_path: Path) -> None:
    path = tmp_path / "Robot.hpp"
    path.write_text(ENUMERATION, encoding="utf-8")
    texts = {
        "Current": "the cable is broken; its input is pulled to 0 V",
        "Drift": "the sensor drifts; value: mA",
    }
    assert enumerators(path, "Fault") == texts
    assert enumerators(path, "Kind") == {}


def test_a_project_without_the_campaign_has_no_kinds(tmp_path: Path) -> None:
    assert fault_kinds(tmp_path) == {}
    assert sensor_faults(tmp_path) == []


def test_each_kind_and_each_fault_of_a_sensor_has_a_text() -> None:
    kinds = fault_kinds(ROOT)
    assert list(kinds)[:2] == ["ram", "code"]
    assert len(kinds) == 10
    assert "a current sensor has an offset (-8000 to 8000, in mA)" in sensor_faults(ROOT)
    assert len(sensor_faults(ROOT)) == 10
