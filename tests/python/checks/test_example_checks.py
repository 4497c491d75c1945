"""The check finds names in the Python examples of the pages that the client does not have."""

from pathlib import Path

from traceability.checks.example_checks import wrong_examples

MODULE = """\
from enum import Enum
class Unit(Enum):
    VOLT = 1
class Base(Unknown):
    pass
class Link:
    def __init__(self, path, clock=None):
        self.path = path
    def send(self, order, *, again=False):
        pass
def connect(link, **more):
    return link
"""
EXAMPLE = """\
.. code-block:: python

   import math
   from weeding_robot_client.link import Base, Link, Unit, connect, disconnect
   from weeding_robot_client.lines import Line
   from weeding_robot_client import link as module

   with Link("path", clock=math.pi) as link:
       link.send(Unit.VOLT, again=True)
       link.send(Unit.OHM, once=True)
       print(link.path, link.speed, Base.anything, module.Link)
   other = Link(file="path")
   connect(other, any=other.close(), thing=Unit.VOLT.name)

Text with link.unknown.

.. code-block:: python

   from weeding_robot_client import frames, link as
"""


def test_names_that_the_client_does_not_have_are_found(tmp_path: Path) -> None:
    client = tmp_path / "client" / "weeding_robot_client"
    client.mkdir(parents=True)
    (client / "link.py").write_text(MODULE)
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "page.rst").write_text(EXAMPLE)
    found = sorted((one.place.line, one.text) for one in wrong_examples(tmp_path))
    assert found == [
        (4, "weeding_robot_client.link has no disconnect"),
        (5, "weeding_robot_client.lines has no Line"),
        (10, "Unit has no attribute OHM"),
        (10, "link.send has no parameter once"),
        (11, "link has no attribute speed"),
        (12, "Link has no parameter file"),
        (13, "other has no attribute close"),
        (19, "the example is not valid Python: invalid syntax"),
    ]


def test_an_example_in_a_readme_is_read(tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text("```python\nimport weeding\nx = (\n```\ntext )\n")
    (found,) = wrong_examples(tmp_path)
    assert (found.place.line, found.check) == (3, "doc-name")
