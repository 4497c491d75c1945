"""The page runs the robot in a browser. It plays a scenario up to a given time. A person can drive
the robot by hand, or execute single cycles and calls."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from portal import site_build
from tests.python.portal.fixture import REPORT, make_project
from tools.browser import find_browser, result_of
from traceability.reading.closed_loop_record import EXAMPLES
from traceability.reading.products import PAPER, image_of, recorded_image_of
from traceability.reading.results import LIVE_MODULE

ROOT = Path(__file__).parents[3]
COPIED = (
    LIVE_MODULE,
    image_of(PAPER, ".bin"),
    image_of(PAPER, ".elf"),
    recorded_image_of(PAPER, ".bin"),
    recorded_image_of(PAPER, ".elf"),
    EXAMPLES / "loss_of_the_pc.scenario",
    EXAMPLES / "rc_drive.scenario",
    Path("design/frames.toml"),
)
# A page that opens another page in a frame, executes a probe (JavaScript) in the other page, and
# sends the result to the test.
PAGE = """<!doctype html><title>probe</title><body><script>
const frame = document.createElement("iframe");
frame.style.cssText = "width:%WIDTH%px;height:900px;border:0";
frame.src = "%ADDRESS%";
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
async function until(test) {
  for (let tries = 0; tries < 400 && !test(); tries += 1) await sleep(50);
  if (!test()) throw new Error("this condition was never true: " + test);
}
frame.onload = async () => {
  const doc = frame.contentDocument;
  const one = (selector) => doc.querySelector(selector);
  const text = (selector) => one(selector).textContent;
  const time = () => parseFloat(text("[data-clock]"));
  let result;
  try {
    result = await (async () => { %PROBE% })();
  } catch (error) {
    result = { error: String(error) };
  }
  fetch("result", { method: "POST", body: JSON.stringify(result) });
};
document.body.append(frame);
</script>"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if not (ROOT / LIVE_MODULE).exists():
        pytest.skip("the module is not built, because its compiler is not installed")
    root = tmp_path_factory.mktemp("project")
    model = make_project(root)
    for name in COPIED:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, root / name)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(site_build, "CHECKS", [])
        site_build.build_site(root, model, REPORT)
    return root / "build" / "site"


def look(
    site: Path, probe: str, query: str = "", width: int = 1200, page: str = "run.html"
) -> dict[str, Any]:
    browser = find_browser()
    if browser is None:
        pytest.skip("there is no browser on this computer")
    text = PAGE.replace("%PROBE%", probe).replace("%ADDRESS%", page + query)
    result, _ = result_of(browser, site, text.replace("%WIDTH%", str(width)))
    assert "error" not in result, result
    return result


def test_a_link_leads_to_an_instant(site: Path) -> None:
    probe = """
      await until(() => one("[data-now]") && text("[data-now]").includes("Waiting"));
      return { now: text("[data-now]"), time: time(), ready: one("#live").dataset.ready };
    """
    seen = look(site, probe, "?s=loss_of_the_pc&t=5300")
    assert seen["now"] == "Waiting · PC"
    assert 5.3 <= seen["time"] < 5.5
    assert float(seen["ready"]) < 2


def test_nothing_is_loaded_before_a_press(site: Path) -> None:
    probe = """
      await sleep(300);
      const loaded = frame.contentWindow.performance.getEntriesByType("resource");
      return { names: loaded.map((entry) => entry.name) };
    """
    names = look(site, probe)["names"]
    assert names, "the probe sees no resources"
    assert [name for name in names if "/live/" in name and "/_static/" not in name] == []


def test_a_person_drives_the_robot(site: Path) -> None:
    probe = """
      one("[data-load]").click();
      await until(() => !one("[data-view]").hidden);
      [...doc.querySelectorAll("[name=speed]")].find((field) => field.value === "10").click();
      await until(() => time() > 2);
      const field = one("[data-hand=set]");
      field.value = 50;
      field.dispatchEvent(new frame.contentWindow.Event("input"));
      const at = time();
      await until(() => time() > at + 5);
      one("[data-do=toggle]").click();
      await until(() => text("[data-do=toggle]") === "Run");
      const facts = text("[data-facts]");
      const before = text("[data-clock]");
      one("[data-do=cycle]").click();
      await until(() => text("[data-clock]") !== before);
      one("[data-do=call]").click();
      return { facts, before, after: text("[data-clock]"), call: text(".lv-call.here") };
    """
    seen = look(site, probe)
    speed = float(seen["facts"].partition("speed")[2].partition(" ")[0])
    assert speed > 0.2, seen
    before, after = (int(seen[key].rpartition(" ")[2]) for key in ("before", "after"))
    assert after == before + 1
    assert "::" in seen["call"]


def test_a_requirement_is_watched_as_it_happens(site: Path) -> None:
    probe = """
      one("[data-go]").click();
      await until(() => doc.querySelectorAll(".lv-happened li").length === 2);
      return { shows: text("[data-result] p"), calls: text(".lv-happened") };
    """
    seen = look(site, probe, page="requirements/FR-15.html")
    assert "seen at " in seen["shows"]
    assert seen["calls"] == "MainController::readRC::read"


@pytest.mark.parametrize("width", [320, 390, 820, 1920])
def test_the_running_page_does_not_scroll_sideways(site: Path, width: int) -> None:
    probe = """
      await until(() => one("[data-now]") && text("[data-now]").includes("Waiting"));
      return { wide: doc.documentElement.scrollWidth };
    """
    assert look(site, probe, "?s=loss_of_the_pc&t=5300", width)["wide"] <= width
