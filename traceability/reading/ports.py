"""The port of the firmware to another microcontroller, and the results of its tests on QEMU."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.results import RESULTS, read_json, results_in
from traceability.reading.task_record import PORT, is_fresh
from traceability.schema import Port

FOLDER = Path("ports/mps2")
RESULT = RESULTS / "port.json"


def read_port(root: Path) -> Port | None:
    """The files of the port, with the results of its tests when they are of these sources."""
    if not (root / FOLDER).exists():
        return None
    files = {
        str(path.relative_to(root)): len(path.read_text("utf-8").splitlines())
        for path in sorted((root / FOLDER).rglob("*"))
        if path.suffix in (".hpp", ".cpp", ".ld") and "tests" not in path.parts
    }
    data = read_json(root / RESULT)
    fresh = isinstance(data, dict) and is_fresh(root, PORT)
    tests = {name: one.result for name, one in results_in(data).items()} if fresh else None
    return Port(files, tests)
