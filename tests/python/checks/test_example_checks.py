"""mypy finds errors in the Python examples of the pages."""

from pathlib import Path

from tests.python.project_files import write_files
from traceability.checks.example_checks import wrong_examples

MODULE = """\
from enum import Enum
class Unit(Enum):
    VOLT = 1
class Link:
    def __init__(self, path, clock=None):
        self.path = path
    def send(self, order, *, again=False):
        pass
def connect(link, **more) -> Link:
    return link
"""
EXAMPLE = """\
.. code-block:: python

   import math
   import not_installed
   from weeding_robot_client.link import Link, Unit, connect, disconnect
   from weeding_robot_client.lines import Line
   from weeding_robot_client import link as module

   link = Link("path", clock=math.pi + not_installed.clock)
   link.send(Unit.VOLT, again=True)
   link.send(Unit.OHM, once=True)
   print(link.path, link.speed, module.Link)
   other = Link(file="path")
   connect(other, any=connect(other).close(), thing=Unit.VOLT.name)

Text with link.unknown.
"""
WRONG = """\
.. code-block:: python

   from weeding_robot_client import frames, link as
"""


def write(root: Path, page: str, text: str) -> list[tuple[int, str]]:
    """Writes a page. Returns the line and the text of each finding in this page."""
    write_files(root, {"client/weeding_robot_client/link.py": MODULE, page: text})
    return sorted((one.place.line, one.text) for one in wrong_examples(root))


def test_names_that_the_client_does_not_have_are_found(tmp_path: Path) -> None:
    found = write(tmp_path, "docs/page.rst", EXAMPLE)
    named = (
        *((5, "disconnect"), (6, "weeding_robot_client.lines"), (11, "OHM"), (11, "once")),
        *((12, "speed"), (13, "file"), (14, "close")),
    )
    assert [line for line, _ in found] == [line for line, _ in named]
    for line, name in named:
        assert any(at == line and name in text for at, text in found)


def test_a_wrong_type_in_a_readme_is_found(tmp_path: Path) -> None:
    example = "```python\nimport weeding\nx: int = ''\n```\ntext )\n"
    ((line, text),) = write(tmp_path, "README.md", example)
    assert line == 3 and text.startswith("Incompatible types")


def test_code_that_is_not_python_is_found(tmp_path: Path) -> None:
    ((line, _),) = write(tmp_path, "docs/page.rst", WRONG)
    assert line == 3
