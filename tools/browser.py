"""Opens a page in the browser of this computer, and receives a result from this page."""

from __future__ import annotations

import functools
import json
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Mapping
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from tools.steps import FailureError

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PAGE = "/probe.html"  # address of the page that posts the result
SECONDS = 600  # time limit for the result of a page


def find_browser() -> str | None:
    """Returns the path of the browser, or None if the browser does not start. In some packages, the
    command of the browser only prints a message."""
    browser = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if browser is None:
        return None
    try:
        subprocess.run([browser, "--version"], capture_output=True, timeout=60, check=True)
    except (OSError, subprocess.SubprocessError):
        return None
    return browser


def result_of(
    browser: str, folder: Path, page: str, scripts: Mapping[str, Path] | None = None
) -> tuple[dict[str, Any], list[str]]:
    """Opens a page in the browser. Returns the result and the lines of the console. The page posts
    the result to the address ``result``.

    ``page`` is the text of the page. The page can load the ``scripts`` and the files of the folder.
    The keys of ``scripts`` are the addresses of the scripts. The browser runs in real time and ends
    as soon as the page has posted the result."""
    came = threading.Event()
    posted: dict[str, Any] = {}

    class Handler(SimpleHTTPRequestHandler):
        def do_GET(self) -> None:
            if self.path == PAGE:
                self._answer(200, "text/html", page.encode())
            elif scripts and self.path in scripts:
                self._answer(200, "text/javascript", scripts[self.path].read_bytes())
            else:
                super().do_GET()

        def do_POST(self) -> None:
            posted.update(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self._answer(204, "text/html", b"")
            came.set()

        def log_message(self, *_arguments: Any) -> None:
            """Prints nothing for a request."""

        def _answer(self, status: int, kind: str, content: bytes) -> None:
            self.send_response(status)
            self.send_header("Content-Type", f"{kind}; charset=utf-8")
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

    handler = functools.partial(Handler, directory=str(folder))
    with (
        ThreadingHTTPServer(("127.0.0.1", 0), handler) as http,
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile,
        tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as log,
    ):
        threading.Thread(target=http.serve_forever, daemon=True).start()
        words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"]
        words += ["--enable-logging=stderr", "--remote-debugging-port=0"]
        words += [f"--user-data-dir={profile}", f"http://127.0.0.1:{http.server_port}{PAGE}"]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=log) as program:
            try:
                if not came.wait(SECONDS):
                    raise FailureError(f"the page sent no result within {SECONDS} s")
            finally:
                program.terminate()
                program.wait()
                http.shutdown()
        log.seek(0)
        console = [line.rstrip() for line in log if "CONSOLE" in line]
    return posted, console
