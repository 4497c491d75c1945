"""Reads the ports of the firmware to other devices and microcontrollers, and the results of their
tests."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from traceability.reading.change_kits import PATCH, Kit, count_lines
from traceability.reading.results import RESULTS, read_fresh, results_in
from traceability.reading.task_record import PORTS
from traceability.reading.toml_reader import Entries
from traceability.schema import Place, Port

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
    changed = Kit(folder.name, item["title"], Place("", 0))
    if (folder / PATCH).exists():
        count_lines(changed, (folder / PATCH).read_text("utf-8"))
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
        composition_lines=changed.composition_lines,
        outside_lines=changed.outside_lines,
        tests={name: result.result for name, result in results_in(suites).items()}
        if suites
        else None,
        size=suites.get("image", {}),
        size_on_k64=results.get("k64", {}),
    )
