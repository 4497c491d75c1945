"""The page that draws a recording in the browser. It draws the same curves as ./wr plot."""

from __future__ import annotations

import csv
import json
import random
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from portal.plots import Drawing, draw
from portal.recording_page import changes, plots, read_recording
from tests.python.site.browser import BROWSER, Site, look, served
from tests.python.site.content import SITE
from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.recording import COLUMNS, cell_of

AXE = "axe.min.js"
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
RESET = 30  # the first report after a reset of the robot; its time begins at 0 again
# Chooses or drops a file. Returns the drawings, the changes and the findings of axe.
SHOW = """
const files = new view.DataTransfer();
files.items.add(new view.File([%TEXT%], "drive.csv"));
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
while (!status.textContent) await new Promise((done) => view.setTimeout(done, 20));
const texts = (node, names) => [...node.querySelectorAll(names)].map((each) => each.textContent);
const drawings = [...doc.querySelectorAll(".plot")].map((plot) => ({
  title: plot.querySelector("figcaption").textContent,
  y: texts(plot, ".plot-y span"),
  x: texts(plot, ".plot-x span"),
  lines: [...plot.querySelectorAll(":scope > svg path:not(.grid)")].map((path) =>
    [path.getAttribute("class"), path.getAttribute("d")]),
}));
const script = doc.createElement("script");
script.src = "/probe_plot_axe.js";
await new Promise((done) => { script.onload = done; doc.head.append(script); });
const violations = [];
for (const theme of ["light", "dark"]) {
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

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(not BROWSER, reason="there is no browser on this machine"),
]


@pytest.fixture(scope="module")
def site() -> Iterator[Site]:
    script = SITE / "probe_plot_axe.js"
    shutil.copyfile(Path(__file__).with_name(AXE), script)
    with served(SITE) as found:
        yield found
    script.unlink()
    (SITE / "probe_plot.html").unlink(missing_ok=True)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Returns reports with all quantities, with missing values and with a reset."""
    path = tmp_path_factory.mktemp("recording") / "drive.csv"
    chance = random.Random(1)
    report = LAYOUTS["Report"]
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for number in range(REPORTS):
            numbers: dict[str, Any] = {
                field.name: b"12345678"
                if field.type == "char8"
                else chance.randint(*RANGES[field.type])
                for field in report.fields
            }
            numbers["time_ms"] = number % RESET * PERIOD_MS
            values = report.decode(report.pack(**numbers)).values()
            table.writerow([cell_of(value) for value in (*values, None)])
    return path


def shown(site: Site, text: str, *, dropped: bool = False) -> dict[str, Any]:
    probe = SHOW.replace("%TEXT%", json.dumps(text)).replace("%DROPPED%", json.dumps(dropped))
    seen, errors = look(site, ["plot"], probe, name="probe_plot")
    assert errors == []
    found: dict[str, Any] = seen["plot"]
    return found


@pytest.mark.parametrize("dropped", [False, True])
def test_a_chosen_and_a_dropped_file_have_the_curves_of_wr_plot(
    site: Site, recording: Path, dropped: bool
) -> None:
    found = shown(site, recording.read_text(), dropped=dropped)
    reports = read_recording(recording)
    expected = [drawing for plot in plots(reports) if (drawing := draw(plot))]
    assert found["status"] == "drive.csv: 60 reports in 5.8 s."
    assert not found["hidden"]
    assert len(found["drawings"]) == len(expected) == 13
    for plot, drawing in zip(found["drawings"], expected, strict=True):
        assert_same(plot, drawing)
    assert found["changes"] == [
        [f"{one.seconds:.1f} s", one.name, one.before, one.after] for one in changes(reports)
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
        # Python and JavaScript round halves differently.
        assert numbers_of(path) == pytest.approx(numbers_of(line.path), abs=0.11)


def numbers_of(path: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?[\d.]+", path)]


def test_another_table_is_refused(site: Site) -> None:
    found = shown(site, "a,b\n1,2\n")
    assert found["hidden"]
    assert "drive.csv has no reports" in found["status"]
