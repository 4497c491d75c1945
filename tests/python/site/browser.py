"""Opens pages in a headless browser, executes a probe (JavaScript) in each page, and returns the
results."""

from __future__ import annotations

import functools
import html
import json
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), ""
)
# A page that opens other pages in a frame. It opens them one after the other, and collects the
# results.
HARNESS = """<!doctype html><title>probe</title><body><pre id="out"></pre><script>
const pages = %PAGES%, seen = {};
const frame = document.createElement("iframe");
frame.style.cssText = "width:%WIDTH%px;height:900px;border:0";
document.body.append(frame);
function next() {
  const name = pages.shift();
  if (!name) { document.getElementById("out").textContent = JSON.stringify(seen); return; }
  frame.onload = () => setTimeout(async () => {
    seen[name] = await probe(frame.contentWindow);
    next();
  }, 30);
  frame.src = name.replace(/(?=[?]|$)/, ".html");
}
async function probe(view) { const doc = view.document; %PROBE% }
next();
</script>"""
Site = tuple[str, Path]  # address and folder of the site


class QuietHandler(SimpleHTTPRequestHandler):
    def log_message(self, *_arguments: Any) -> None:
        """Writes nothing, because the tests check the pages and not the requests."""


@contextmanager
def served(site: Path) -> Iterator[Site]:
    handler = functools.partial(QuietHandler, directory=str(site))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as http:
        threading.Thread(target=http.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{http.server_port}", site
        http.shutdown()


def look(
    server: Site,
    pages: list[str],
    probe: str,
    *,
    width: int = 1200,
    name: str = "probe",
) -> tuple[dict[str, Any], list[str]]:
    """Returns the result of the probe for each page, and the errors on the console.

    Each page is named without the suffix ``.html``. A query may follow the name: ``index?q=mode``.
    """
    address, site = server
    values = {"PAGES": json.dumps(pages), "WIDTH": str(width), "PROBE": probe}
    page = HARNESS
    for key, value in values.items():
        page = page.replace(f"%{key}%", value)
    (site / f"{name}.html").write_text(page, encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"]
    timing = ["--virtual-time-budget=60000", "--dump-dom"]
    command = [BROWSER, *options, *timing, f"{address}/{name}.html"]
    run = subprocess.run(command, capture_output=True, text=True, timeout=600, check=True)
    match = re.search(r'<pre id="out">(.*?)</pre>', run.stdout, re.DOTALL)
    assert match and match[1], f"the probe did not end: {run.stderr[-2000:]}"
    errors = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    return json.loads(html.unescape(match[1])), errors
