"""The files for other tools: their names, their descriptions, and how each is made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from traceability.exports import svd
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.reading.register_table import TABLE, read_registers


@dataclass(frozen=True)
class ToolFile:
    """A file of the portal for another tool."""

    name: str
    text: str  # for the page Exports
    make: Callable[[Path, Model, Report], str]
    source: Path = Path()  # a file of the project that it is made from, if it is made from one


FILES = (
    ToolFile(
        svd.NAME,
        "The registers that the firmware uses, in CMSIS-SVD, for a debugger.",
        lambda root, _model, _report: svd.svd_of(read_registers(root)),
        TABLE,
    ),
)


def available(root: Path) -> list[ToolFile]:
    """Those whose source the project has."""
    return [one for one in FILES if (root / one.source).exists()]
