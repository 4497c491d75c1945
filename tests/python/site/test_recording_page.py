"""The page that draws a recording in the browser. It draws the same curves as ./wr plot."""

from __future__ import annotations

import json
import random
import re
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from mcap.writer import CompressionType, Writer

from portal.plots import Drawing, draw
from portal.recording_page import changes, plots, read_recording
from tests.python.site.browser import look, needs_browser
from tests.python.site.content import SITE
from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.mcap_file import TOPIC
from weeding_robot_client.messages import Report
from weeding_robot_client.recording import Recording

RANGES = {
    "u8": (0, 4),
    "i8": (-1, 1),
    "u16": (0, 900),
    "i16": (-900, 900),
    "u32": (0, 9),
    "i32": (-9, 9),
}
REPORTS = 60
PERIOD_MS = 100
CHUNK_REPORTS = 200  # at least as many reports as a chunk of an MCAP file contains
RESET = 30  # number of the first report after a reset; the time of the robot begins at 0 again
# Chooses a file, or drops it on the page. Returns the status, the drawings, the changes and the
# width of the page. If the file was dropped, also returns the findings of axe.
SHOW = """
const files = new view.DataTransfer();
const bytes = Uint8Array.from(atob(%CONTENT%), (letter) => letter.charCodeAt(0));
files.items.add(new view.File([bytes], %NAME%));
const input = doc.querySelector("#recording-file");
if (%DROPPED%) {
  const dropped = { dataTransfer: files, bubbles: true, cancelable: true };
  const event = new view.DragEvent("drop", dropped);
  input.parentElement.dispatchEvent(event);
} else {
  input.files = files.files;
  input.dispatchEvent(new view.Event("change"));
}
const status = doc.querySelector("[data-status]");
await until(() => status.textContent);
const texts = (node, names) => [...node.querySelectorAll(names)].map((each) => each.textContent);
const drawings = [...doc.querySelectorAll(".plot")].map((plot) => ({
  title: plot.querySelector("figcaption").textContent,
  y: texts(plot, ".plot-y span"),
  x: texts(plot, ".plot-x span"),
  lines: [...plot.querySelectorAll(":scope > svg path:not(.grid)")].map((path) =>
    [path.getAttribute("class"), path.getAttribute("d")]),
}));
const violations = [];
if (%DROPPED%) {
  const script = doc.createElement("script");
  script.src = "/axe.js";
  await new Promise((done) => { script.onload = done; doc.head.append(script); });
}
for (const theme of %DROPPED% ? ["light", "dark"] : []) {
  doc.documentElement.dataset.theme = theme;
  const found = await view.axe.run(doc, { resultTypes: ["violations"] });
  violations.push(...found.violations.map(({ id, nodes }) => `${theme} ${id} ${nodes[0].target}`));
}
frame.style.width = "390px";
return {
  status: status.textContent,
  hidden: doc.querySelector("[data-result]").hidden,
  drawings,
  changes: [...doc.querySelectorAll("[data-changes] tr")].map((row) => texts(row, "td")),
  violations,
  width: doc.documentElement.scrollWidth,
};
"""

pytestmark = [pytest.mark.browser, needs_browser]


@pytest.fixture(scope="module")
def recordings(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Returns a CSV file and an MCAP file with the same reports. The reports have all quantities,
    missing values and a reset.
    """
    folder = tmp_path_factory.mktemp("recording")
    paths = {"csv": folder / "drive.csv", "mcap": folder / "drive.mcap"}
    with Recording(paths["csv"], paths["mcap"]) as files:
        for report in reports(REPORTS):
            files.add(report)
    return paths


def reports(count: int) -> Iterator[Report]:
    """Returns reports with random values."""
    chance = random.Random(1)
    report = LAYOUTS["Report"]
    for number in range(count):
        numbers: dict[str, Any] = {
            field.name: b"12345678"
            if field.type == "char8"
            else chance.randint(*RANGES[field.type])
            for field in report.fields
        }
        numbers["time_ms"] = number % RESET * PERIOD_MS
        yield Report.from_payload(report.pack(**numbers))


def shown(content: bytes, name: str, *, dropped: bool = False) -> dict[str, Any]:
    values = {
        "%CONTENT%": b64encode(content).decode(),
        "%NAME%": name,
        "%DROPPED%": dropped,
    }
    probe = SHOW
    for place, value in values.items():
        probe = probe.replace(place, json.dumps(value))
    seen, errors = look(SITE, ["plot"], probe)
    assert errors == []
    found: dict[str, Any] = seen["plot"]
    return found


@pytest.mark.parametrize(("kind", "dropped"), [("csv", False), ("csv", True), ("mcap", False)])
def test_a_chosen_and_a_dropped_file_have_the_curves_of_wr_plot(
    recordings: dict[str, Path], kind: str, dropped: bool
) -> None:
    path = recordings[kind]
    found = shown(path.read_bytes(), path.name, dropped=dropped)
    read = read_recording(path)
    expected = [drawing for plot in plots(read) if (drawing := draw(plot))]
    assert found["status"] == f"{path.name}: 60 reports in 5.8 s."
    assert not found["hidden"]
    assert len(found["drawings"]) == len(expected) == 13
    for plot, drawing in zip(found["drawings"], expected, strict=True):
        assert_same(plot, drawing)
    assert found["changes"] == [
        [f"{one.seconds:.1f} s", one.name, one.before, one.after] for one in changes(read)
    ]
    assert len(found["changes"]) > REPORTS
    assert found["violations"] == []
    assert found["width"] <= 390


def assert_same(plot: dict[str, Any], drawing: Drawing) -> None:
    assert plot["title"] == f"{drawing.title} [{drawing.unit}]"
    assert plot["y"] == [tick.text for tick in drawing.y]
    assert plot["x"] == [f"{tick.text} s" for tick in drawing.x]
    assert [kind for kind, _ in plot["lines"]] == [line.kind for line in drawing.lines]
    for (_, path), line in zip(plot["lines"], drawing.lines, strict=True):
        assert re.sub(r"[-\d.]+", "", path) == re.sub(r"[-\d.]+", "", line.path)
        # Python and JavaScript round a number differently if it is exactly between two results.
        assert numbers_of(path) == pytest.approx(numbers_of(line.path), abs=0.11)


def numbers_of(path: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?[\d.]+", path)]


def test_an_interrupted_mcap_file_is_drawn_up_to_its_last_complete_chunk(tmp_path: Path) -> None:
    path = tmp_path / "drive.mcap"
    with Recording(None, path) as files:
        for report in reports(2 * CHUNK_REPORTS):
            files.add(report)
    content = path.read_bytes()
    found = shown(content[: len(content) // 2], path.name)
    count = int(found["status"].split()[1])
    assert found["status"].startswith("drive.mcap: ")
    assert 0 < count < 2 * CHUNK_REPORTS


def test_an_mcap_file_with_another_compression_is_refused_with_the_command_that_reads_it(
    tmp_path: Path,
) -> None:
    path = tmp_path / "drive.mcap"
    writer = Writer(str(path), compression=CompressionType.LZ4)
    writer.start()
    schema = writer.register_schema("", "", b"")
    channel = writer.register_channel(TOPIC, "json", schema)
    writer.add_message(channel, log_time=0, publish_time=0, data=b"{}")
    writer.finish()
    found = shown(path.read_bytes(), path.name)
    assert found["hidden"]
    assert found["status"] == (
        "drive.mcap cannot be drawn: its compression is lz4, and this page reads only zstd. "
        "Draw it with ./wr plot FILE."
    )


def test_another_table_is_refused() -> None:
    found = shown(b"a,b\n1,2\n", "drive.csv")
    assert found["hidden"]
    assert "drive.csv cannot be drawn: it has no reports" in found["status"]
