"""Opens pages in a headless browser, executes a probe (JavaScript) in each page, and returns the
results."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from tools.browser import find_browser, result_of

BROWSER = find_browser() or ""
needs_browser = pytest.mark.skipif(not BROWSER, reason="there is no browser on this computer")
needs_node = pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")
AXE = Path(__file__).with_name("axe.min.js")
# A page that opens the tested pages in a frame, one after the other, and posts the results.
# ``until`` waits until a condition is true.
HARNESS = """<!doctype html><title>probe</title><body><script>
const pages = %PAGES%, seen = {};
const frame = document.createElement("iframe");
frame.style.cssText = "width:%WIDTH%px;height:900px;border:0";
document.body.append(frame);
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
async function until(test) {
  for (let tries = 0; tries < 3000 && !test(); tries += 1) await sleep(20);
  if (!test()) throw new Error("this condition was never true: " + test);
  return test();
}
const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });
function next() {
  const name = pages.shift();
  if (!name) return post({ seen });
  frame.onload = async () => {
    try {
      await sleep(30);
      seen[name] = await probe(frame.contentWindow);
      next();
    } catch (error) {
      post({ error: `${name}: ${error}` });
    }
  };
  frame.src = name.replace(/(?=[?]|$)/, ".html");
}
async function probe(view) { const doc = view.document; %PROBE% }
next();
</script>"""


def look(
    site: Path, pages: list[str], probe: str, *, width: int = 1200
) -> tuple[dict[str, Any], list[str]]:
    """Returns the result of the probe for each page, and the errors on the console.

    Each page is named without the suffix ``.html``. A query may follow the name: ``index?q=mode``.
    """
    values = {"PAGES": json.dumps(pages), "WIDTH": str(width), "PROBE": probe}
    page = HARNESS
    for key, value in values.items():
        page = page.replace(f"%{key}%", value)
    result, console = result_of(BROWSER, site, page, {"/axe.js": AXE})
    assert "error" not in result, result["error"]
    return result["seen"], console
