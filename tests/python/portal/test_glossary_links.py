"""The links of a page to the glossary."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from portal.glossary_links import GlossaryLinks

TERMS = """\
.. glossary::

   control cycle
      Read one order, measure, control. Then report.

   cycle
      One turn.

   stop
      An order.

   hold
      Keep.

   order
      A set.

   product
      A variant.
"""


@pytest.fixture
def glossary(tmp_path: Path) -> GlossaryLinks:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs/glossary.rst").write_text(TERMS)
    return GlossaryLinks(tmp_path, {})


def linked(glossary: GlossaryLinks, html: str) -> list[tuple[str, str]]:
    """Returns the address and the words of each link to the glossary."""
    page = glossary.link(html, "../")
    assert re.sub(r'<a class="term"[^>]*>([^<]*)</a>', r"\1", page) == html
    return re.findall(r'<a class="term" href="([^"]*)" title="[^"]*">([^<]*)</a>', page)


def test_the_first_use_of_a_term_is_linked(glossary: GlossaryLinks) -> None:
    html = "<p>Control cycles follow each other. A control cycle, a cycle, one more cycle.</p>"
    assert linked(glossary, html) == [
        ("../docs/glossary.html#term-control-cycle", "Control cycles"),
        ("../docs/glossary.html#term-cycle", "cycle"),
    ]


def test_a_term_in_words_with_another_meaning_is_not_linked(glossary: GlossaryLinks) -> None:
    assert linked(glossary, "<p>8 data bits and one stop bit. A stop.</p>") == [
        ("../docs/glossary.html#term-stop", "stop")
    ]


@pytest.mark.parametrize(
    "html",
    [
        "<p>The left end stop, both end stops, an end\nstop.</p>",
        "<p>Add the product of voltage and time.</p>",
        "<div>Product in <b>construction</b></div>",
        "<p>Modules in the order in which they are built; the first reason in the order 2, 1.</p>",
        "<p>The trace contains these calls, nested and in this order.</p>",
        "<p>The receiver offers only <em>hold</em> or <em>preset</em>.</p>",
        "<p>A run tries the mutants in a random order. The timer stops. The check holds.</p>",
    ],
)
def test_words_of_everyday_language_are_no_terms(glossary: GlossaryLinks, html: str) -> None:
    assert linked(glossary, html) == []


def test_an_ambiguous_term_is_linked_only_in_words_with_its_own_meaning(
    glossary: GlossaryLinks,
) -> None:
    html = "<p>Brakes hold the robot. The clock stops.</p><p>A stop holds the steering.</p>"
    assert [words for _, words in linked(glossary, html)] == ["stop", "holds"]


def test_a_term_is_linked_across_a_line_break(glossary: GlossaryLinks) -> None:
    assert linked(glossary, "<p>A control\ncycle.</p>") == [
        ("../docs/glossary.html#term-control-cycle", "control\ncycle")
    ]


def test_the_link_shows_the_first_sentence(glossary: GlossaryLinks) -> None:
    assert 'title="Read one order, measure, control"' in glossary.link("a control cycle")


@pytest.mark.parametrize(
    "html",
    [
        '<a href="x">control cycle</a>',
        "<h2>Control cycle</h2>",
        "<pre>cycle</pre><code>cycle</code>",
        "<svg><text>cycle</text></svg>",
        "<p>MainController::cycle, cycle-time, bicycle, cycle_, cycle(), cycle::kMost</p>",
        "<p>read(<span>Reader&amp;</span> cycle, Reader&amp; cycle)</p>",
        '<p title="cycle"></p>',
    ],
)
def test_links_code_headings_and_pictures_stay_as_they_are(
    glossary: GlossaryLinks, html: str
) -> None:
    assert linked(glossary, html) == []


def test_a_project_without_a_glossary_has_no_links(tmp_path: Path) -> None:
    assert GlossaryLinks(tmp_path, {}).link("a cycle") == "a cycle"
