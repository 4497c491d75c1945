"""The sections of the hand-written pages, for the search."""

from portal.navigation import Entry
from portal.sections import sections_of

PAGE = """\
.. _tour:

Tour
====

It begins here. See :ref:`the way <way>` and
:module:`RC`.

2. The way
----------

.. list-table:: All parts
   :header-rows: 1

   * - name
     - `Secrets <../secrets.html>`__ and ``src/a.hpp``
"""


def test_each_section_has_its_address_and_its_words() -> None:
    found = [
        (s.title, s.address, s.text)
        for s in sections_of(Entry("docs/tour", "Tour", "docs/tour.html"), PAGE)
    ]
    assert found == [
        ("Tour", "docs/tour.html", "It begins here. See the way and RC."),
        ("2. The way", "docs/tour.html#the-way", "name Secrets and src/a.hpp"),
    ]
