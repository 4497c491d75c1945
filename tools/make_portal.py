"""./wr portal: builds the portal from the sources."""

from __future__ import annotations

import argparse
import io
import os
import threading
import time
import webbrowser
from contextlib import AbstractContextManager
from pathlib import Path

from tools.check import report
from tools.documents import FINDINGS, write_time
from tools.lock import only_one, outliving
from tools.serve import STATUS, add_port, serving, wait
from tools.task_graph import Progress, Task
from tools.tasks import DOCUMENTS, HOST_FIRMWARE, RESULT_TASKS, graph, pages_graph
from traceability.reading.task_record import RECORD
from traceability.whole_file import write_json


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "portal",
        description="Builds the portal from the sources, serves it on this computer and opens it. "
        "Then builds the firmware for this computer and for the K64. Runs the tests of "
        "the firmware on this computer, with traces and coverage. Also runs tests on the "
        "virtual K64, with the firmware image. Then measures the firmware image, and "
        "rebuilds the pages with the results. An open "
        "page shows the running tasks, and updates itself. A task runs again only if "
        "its inputs changed. The portal is built even if there are findings or failed "
        "tests.",
    )
    add_port(parser)
    parser.add_argument(
        "--no-serve", action="store_true", help="end as soon as the portal is built"
    )
    parser.add_argument(
        "--no-open", action="store_true", help="serve the portal, but open no browser"
    )
    parser.add_argument(
        "--docs-only",
        action="store_true",
        help="rebuild only the documents: build no firmware, and run no test",
    )
    parser.set_defaults(run=portal)


def portal(root: Path, options: argparse.Namespace) -> int:
    start = time.monotonic()
    with only_one(root, "portal"):
        cold = not (root / RECORD).exists() and not options.docs_only
        if options.no_serve:
            failed = [] if options.docs_only else graph(root).run(RESULT_TASKS).failed
            code = finish(root, failed, start, cold)
            print(f"The portal is in {root / 'build' / 'site'}")
            return code
        pages_graph(root).run([DOCUMENTS])
        server, thread = serving(root, options.port)
        print(f"The portal is at {server} (Ctrl-C ends)", flush=True)
        if cold:
            write_time(root, "build.first_page_s", time.monotonic() - start)
        if not options.no_open and (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            with outliving():
                webbrowser.open(server)
        if not options.docs_only:
            with Pages(root) as pages:
                failed = graph(root).run(RESULT_TASKS, pages.changed).failed
                pages.end()
                finish(root, failed, start, cold)
    wait(thread)
    return 0


def finish(root: Path, failed: list[str], start: float, cold: bool) -> int:
    """Builds the pages with all results, prints the findings, and returns the exit code."""
    made = pages_graph(root).run([DOCUMENTS])
    if cold:
        write_time(root, "build.cold_s", time.monotonic() - start)
    return report(root, [*failed, *made.failed])


class Pages(AbstractContextManager["Pages"]):
    """The pages of a running build. They are rebuilt when a task has ended, and an open page shows
    the running tasks."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.progress = Progress()
        self.wanted = threading.Event()
        self.over = False
        self.thread = threading.Thread(target=self._rebuild, daemon=True)

    def __enter__(self) -> Pages:
        self.thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.over = True
        self.wanted.set()
        self.write(over=True)

    def end(self) -> None:
        """Starts no further rebuild, and waits until the present rebuild has ended."""
        self.over = True
        self.wanted.set()
        self.thread.join()

    def changed(self, task: Task | None, progress: Progress) -> None:
        self.progress = progress
        shown = task is not None and task.name in RESULT_TASKS and task.name != HOST_FIRMWARE
        if shown and (progress.running or progress.waiting):
            self.wanted.set()
        self.write()

    def write(self, *, over: bool = False) -> None:
        """Writes the state of the run next to the pages. An open page reads this
        file periodically."""
        made = self.root / FINDINGS
        content = {
            "over": over,
            "pages": str(made.stat().st_mtime_ns) if made.exists() else "",
            "running": [
                {"name": name, "since": since, "seconds": seconds}
                for name, (since, seconds) in list(self.progress.running.items())
            ],
            "waiting": [
                {"name": name, "seconds": seconds}
                for name, seconds in list(self.progress.waiting.items())
            ],
            "failed": [name for name, end in list(self.progress.done.items()) if end.failed],
        }
        write_json(self.root / STATUS, content)

    def _rebuild(self) -> None:
        while True:
            self.wanted.wait()
            self.wanted.clear()
            if self.over:
                return
            pages_graph(self.root, io.StringIO()).run([DOCUMENTS])
            self.write()
