"""The pages contain names of attributes of a report. The check finds an attribute that the classes
of the client do not have. It also finds an attribute that is missing in the table of the
attributes."""

from pathlib import Path

from tests.python.project_files import write_files
from traceability.checks.name_checks import wrong_attributes

MESSAGES = """class WheelReport:
    late: bool

class Report:
    cycle: int
    wheels: tuple[WheelReport, ...]
    armed: bool
    kind: ClassVar[int] = 1

    @property
    def ready(self): ...
"""
PAGE = """.. list-table:: Attributes of a report

   * - ``cycle``, ``cycles``
     - number of the cycle, not ``number``
   * - ``wheels[0]`` to ``wheels[3]``, ``wheels[0].late``

``report.ready``, report.read, weeding_robot.report.armed0, report.wheels[0].lats, report.cycle.bit(
"""


def test_an_attribute_that_the_client_does_not_have_is_found(tmp_path: Path) -> None:
    files = {"client/weeding_robot_client/messages.py": MESSAGES, "docs/page.rst": PAGE}
    write_files(tmp_path, files)
    assert [(one.place.line, one.text) for one in wrong_attributes(tmp_path)] == [
        (3, "a report of the client has no attribute 'cycles'"),
        (7, "a report of the client has no attribute 'lats'"),
        (7, "a report of the client has no attribute 'read'"),
        (7, "the table of the attributes of a report does not list 'armed'"),
    ]
