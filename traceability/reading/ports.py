"""Reads the ports of the firmware to other devices and microcontrollers, and the results of their
tests."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from traceability.reading.change_kits import PATCH, touched_lines
from traceability.reading.results import RESULTS, read_fresh, results_in
from traceability.reading.task_record import PORTS
from traceability.reading.toml_reader import Entries
from traceability.schema import Place, Port
from traceability.sources import text_of

FOLDER = Path("ports")
RESULT = RESULTS / "ports.json"  # folder of a port -> its test suites, and the sizes of its image


def read_ports(root: Path, entries: Entries) -> dict[str, Port]:
    """Returns the ports by their folders. Test results are included only if they belong to the
    present sources."""
    results = read_fresh(root, RESULT, PORTS) or {}
    ports = {}
    for path in sorted((root / FOLDER).glob("*/port.toml")):
        item: dict[str, Any] = dict(entries.whole(path))
        place = Place(str(path.relative_to(root)), 1)
        needs = dict.fromkeys(("title", "says", "tests", "image"), str)
        if entries.fits(item, place, needs, {"needs": str}):
            ports[path.parent.name] = _port(root, path.parent, item, results)
    return ports


# The headers next to the folders of the ports belong to each port, because all ports use them.
def _port(root: Path, folder: Path, item: Mapping[str, str], results: Mapping[str, Any]) -> Port:
    touched = touched_lines(text_of(folder / PATCH))
    suites = results.get(folder.name, {})
    return Port(
        title=item["title"],
        says=item["says"],
        program=item["tests"],
        image=item["image"],
        needs=item.get("needs", ""),
        files={
            str(path.relative_to(root)): len(path.read_text("utf-8").splitlines())
            for path in sorted([*folder.parent.glob("*.hpp"), *folder.rglob("*")])
            if path.suffix in (".hpp", ".cpp", ".ld") and "tests" not in path.parts
        },
        composition_lines=touched.composition,
        outside_lines=touched.outside,
        tests=_results(suites) if suites else None,
        size=suites.get("image", {}),
        size_on_k64=results.get("k64", {}),
    )


def _results(suites: dict[str, Any]) -> dict[str, str]:
    return {name: each.result for name, each in results_in(suites).items() if each.result}
