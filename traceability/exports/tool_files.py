"""The list of the files for other tools. Each entry has the file name, a description, and the
function that generates the file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from traceability.exports import junit_tests, requirement_files, sarif, svd
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.reading.register_table import TABLE, read_registers
from weeding_robot_client.ros_messages import messages


@dataclass(frozen=True)
class ToolFile:
    """A file that the portal offers for another tool."""

    name: str
    text: str  # description on the page Exports
    make: Callable[[Path, Model, Report], str]
    # file of the project from which the exported file is generated; empty if no such file is
    # necessary
    source: Path = Path()


def _ready(text: str, _root: Path, _model: Model, _report: Report) -> str:
    return text


FILES = (
    ToolFile(
        requirement_files.REQIF,
        "Requirements, tests and methods with their links, in ReqIF 1.0.1, for requirements tools.",
        lambda _root, model, report: requirement_files.reqif_text(model, report),
    ),
    ToolFile(
        requirement_files.CSV,
        "The requirements with their attributes and verdicts, as a table. The column verified_by "
        "contains the tests of a requirement. The column satisfied_by contains its methods. Spaces "
        "separate the names. The results and targets of the tests are in verification.json.",
        lambda _root, model, report: requirement_files.csv_text(model, report),
    ),
    ToolFile(
        requirement_files.NEEDS,
        "Requirements, tests and methods with their links, as needs of sphinx-needs.",
        lambda _root, model, report: requirement_files.needs_text(model, report),
    ),
    ToolFile(
        sarif.NAME,
        "The checks and their findings, in SARIF 2.1.0, for editors and code hosts.",
        lambda _root, model, report: sarif.sarif_text(model, report),
    ),
    ToolFile(
        junit_tests.NAME,
        "The results of the tests in the JUnit format. Each test has a property for each "
        "requirement that it verifies. A test is marked as skipped if its result belongs to older "
        "sources.",
        lambda _root, model, report: junit_tests.junit_text(model, report),
    ),
    ToolFile(
        svd.NAME,
        "The registers that the firmware uses, in CMSIS-SVD, for a debugger.",
        lambda root, _model, _report: svd.svd_of(read_registers(root)),
        TABLE,
    ),
    *(
        ToolFile(
            f"ros/{name}",
            "Message definition of ROS 2, generated from the table of the frames.",
            partial(_ready, text),
        )
        for name, text in messages().items()
    ),
)


def available(root: Path) -> list[ToolFile]:
    """Returns the files that can be made, because the project contains their source files."""
    return [file for file in FILES if (root / file.source).exists()]
