"""Recordings in CSV and MCAP, the schema of MCAP recordings, and the page with curves that
``./wr plot`` draws from a recording."""

import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from lxml.html import fromstring
from mcap.reader import make_reader
from mcap_ros2._vendor.rosidl_adapter.parser import parse_message_string

from portal.recording_page import RecordingError, changes, plots, read_recording, recording_page
from tests.python.client.test_drive import options
from tools import cli
from weeding_robot_client import drive, exit_codes
from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.mcap_file import TOPIC, read_mcap
from weeding_robot_client.ros_messages import messages

ROOT = Path(__file__).parents[3]
SCENARIO = ROOT / "sim" / "scenario" / "examples" / "velocity_step.scenario"


@pytest.fixture
def recorded(mcu: Any, tmp_path: Path) -> tuple[Path, Path]:
    """Returns two recordings of the same drive: a CSV file and an MCAP file."""
    script = tmp_path / "script"
    script.write_text("at 0s velocity 50 rpm\nat 1s steering 10 deg\nat 2s end\n")
    table, mcap = tmp_path / "a.csv", tmp_path / "a.mcap"
    assert drive.run(options(mcu, script=script, csv=table, mcap=mcap)) == 0
    return table, mcap


def test_both_formats_have_the_same_values(recorded: tuple[Path, Path]) -> None:
    table, mcap = (read_recording(path) for path in recorded)
    assert len(table) == len(mcap) > 10
    for row, message in zip(table, mcap, strict=True):
        assert row.keys() == message.keys()
        for name, value in message.items():
            if isinstance(value, bool | int | float):
                assert row[name] == pytest.approx(float(value)), name
            elif isinstance(value, str):
                assert str(row[name]) == value, name


def test_messages_fit_the_schema_in_the_file(recorded: tuple[Path, Path]) -> None:
    with recorded[1].open("rb") as file:
        found = list(make_reader(file).iter_messages())
    schema, channel, message = found[0]
    assert schema is not None
    assert (channel.topic, schema.encoding, channel.message_encoding) == (
        TOPIC,
        "jsonschema",
        "json",
    )
    described = json.loads(schema.data)
    assert described["properties"].keys() == json.loads(message.data).keys()
    assert "[rpm]" in described["properties"]["velocity0_rpm"]["description"]
    strict = {**described, "additionalProperties": False, "required": [*described["properties"]]}
    for _, _, one in found:
        jsonschema.Draft202012Validator(strict).validate(json.loads(one.data))
    assert [one.sequence for _, _, one in found] == sorted(one.sequence for _, _, one in found)


def test_a_full_disk_ends_only_its_recording(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = tmp_path / "script"
    script.write_text("at 0s velocity 50 rpm\nat 1s end\n")
    mcap = tmp_path / "a.mcap"
    assert drive.run(options(mcu, script=script, csv=Path("/dev/full"), mcap=mcap)) == 0
    assert "the recording /dev/full ends here" in capsys.readouterr().err
    assert len(list(read_mcap(mcap))) > 5


@pytest.mark.parametrize("format_", [0, 1])
def test_a_recording_becomes_one_page(recorded: tuple[Path, Path], format_: int) -> None:
    page = recording_page(recorded[format_])
    shown = fromstring(page)
    # The page shows the velocity and the current of each wheel, and the steering. The robot in
    # Python reports no voltages.
    keys = [key.text_content().split() for key in shown.find_class("plot-key")]
    assert len(keys) == 9
    assert any("set-point" in key for key in keys)
    assert "Wheel 3, velocity [rpm]" in {text.strip() for text in shown.itertext()}
    assert not re.search(r'(src|href)="|url\((?!["\']?data:)|https?://(?!www\.w3\.org)', page)


def test_the_table_of_a_scenario_is_drawn_in_units(
    build: Callable[..., None], tmp_path: Path
) -> None:
    build("host", "weeding_robot_host")
    table, page = tmp_path / "r.csv", tmp_path / "page.html"
    program = ROOT / "build/host/sim/weeding_robot_host"
    subprocess.run([program, "--scenario", SCENARIO, "--reports", table], check=True, timeout=60)
    assert cli.main(["plot", str(table), "--out", str(page)]) == 0
    assert page.stat().st_size > 10_000
    reports = read_recording(table)
    velocity = plots(reports)[0]
    ordered, measured = velocity.curves
    # The plot has the unit rpm. The column of the table has the unit 0.1 rpm.
    assert 0 < max(value for _, value in ordered.points) <= 300
    last = measured.points[-1][1]
    assert max(value for _, value in measured.points) >= last
    assert any(change.name == "armed" and change.after == "true" for change in changes(reports))


def test_another_file_is_no_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = tmp_path / "a.csv"
    other.write_text("a,b\n1,2\n")
    with pytest.raises(RecordingError):
        recording_page(other)
    with pytest.raises(SystemExit, match=str(exit_codes.USAGE)):
        cli.main(["plot", str(other)])
    assert "is not a recording of reports" in capsys.readouterr().err


def test_ros_reads_the_definitions_of_the_messages() -> None:
    for file, text in messages().items():
        name = file.removesuffix(".msg")
        parsed = parse_message_string("weeding_robot_msgs", name, text)
        fields = [str(one.name) for one in parsed.fields]
        assert fields == [value for value in LAYOUTS[name].value_names if value in fields], (
            "the fields must be in the sequence of the frame"
        )
        assert set(fields) == set(LAYOUTS[name].value_names)
