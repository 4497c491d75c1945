"""./wr serve: serves the portal on this computer."""

from __future__ import annotations

import argparse
import errno
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

from tools.steps import FailureError, MissingError
from tools.task_graph import WAKE

ADDRESS = "127.0.0.1"
PORT = 8000
SITE = Path("build/site")
STATUS = SITE / "status.json"  # the running tasks, which the open page shows


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "serve",
        description="Serves the portal that was built last. Only this computer can open it.",
    )
    add_port(parser)
    parser.set_defaults(run=lambda root, options: serve(root, options.port))


def add_port(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--port", type=port_number, default=PORT, help=f"port of the server (default: {PORT})"
    )


def port_number(text: str) -> int:
    number = int(text)
    if not 1 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{number} is not within 1 to 65535")
    return number


class Handler(SimpleHTTPRequestHandler):
    """Sends the files of the site. Before each use of a file, the browser checks whether the file
    has changed, because the site may have been rebuilt."""

    def end_headers(self) -> None:
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    # The base class defines the name of the parameter.
    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - http.server names it
        """Prints nothing for a request."""


def make_server(site: Path, port: int) -> ThreadingHTTPServer:
    if not (site / "index.html").exists():
        raise MissingError("there is no portal yet; build it with ./wr portal")
    try:
        return ThreadingHTTPServer((ADDRESS, port), partial(Handler, directory=str(site)))
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise FailureError(f"port {port} is in use; choose another port with --port") from error
        raise FailureError(f"cannot open port {port}: {error.strerror}") from error


def serving(root: Path, port: int) -> tuple[str, Thread]:
    """Serves the portal in a thread. Returns the address and the thread."""
    (root / STATUS).unlink(missing_ok=True)  # This file is the state of a run that has ended.
    server = make_server(root / SITE, port)
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    return f"http://{ADDRESS}:{port}/", thread


def serve(root: Path, port: int) -> int:
    address, thread = serving(root, port)
    print(f"The portal is at {address} (Ctrl-C ends)", flush=True)
    wait(thread)
    return 0


def wait(thread: Thread) -> None:
    """Waits for Ctrl-C. Only the main thread receives Ctrl-C, and only when this thread wakes
    up."""
    while thread.is_alive():
        thread.join(WAKE)
