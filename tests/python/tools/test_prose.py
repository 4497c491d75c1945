"""The linter of prose: the words that it finds, and the positions of these words."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.project_files import write_files
from tools.prose import GLOSSARY, lint_prose, read_terms

TERMS = """\
Glossary
========

.. glossary::

   subclass
      A class that derives from another one.
      Not: nabob, has nabobs.

Plain words
-----------

* ``anew``, ``once more``: again
* ``@secret perchance``: a noun
* ``twixt``: its noun. Right in
  ``twixt # o'clock``
"""


@pytest.fixture
def root(tmp_path: Path) -> Path:
    write_files(tmp_path, {GLOSSARY: TERMS})
    return tmp_path


def found(root: Path, file: str, text: str) -> list[str]:
    write_files(root, {file: text})
    return [str(finding) for finding in lint_prose(root)]


def test_the_terms_are_those_of_the_glossary() -> None:
    assert [(term.words, term.better) for term in read_terms(TERMS)] == [
        ("nabob", '"subclass"'),
        ("has nabobs", '"subclass"'),
        ("anew", "again"),
        ("once more", "again"),
        ("@secret perchance", "a noun"),
        ("twixt", "its noun"),
    ]


def test_a_list_of_terms_inside_a_line_is_found(root: Path) -> None:
    (finding,) = found(root, str(GLOSSARY), TERMS.replace("\n      Not:", " Not:"))
    assert finding.endswith('"Not:": write it at the beginning of a line of its entry')


@pytest.mark.parametrize(
    ("file", "text", "line"),
    [
        ("docs/a.rst", "Modes\n=====\n\nRC is a nabob of Mode.\n", 4),
        ("src/a.hpp", "int x;\n/// @brief A nabob of Mode.\nclass RC;\n", 2),
        ("src/a.cpp", '#include "nabob.hpp"\nauto x = "there is no nabob here";\n', 2),
        ("tools/a.py", 'def f():\n    """Finds the nabob."""\n', 2),
        ("tools/a.py", 'def f():\n    return f"the nabob {x} is gone"\n', 2),
        ("design/a.toml", "# A nabob.\n", 1),
        ("design/a.toml", 'says = "It has a nabob."\n', 1),
        ("requirements/a.dox", "/**\n@rationale The nabob may differ.\n*/\n", 2),
        ("site/templates/a.html", "<p>\n  A nabob.\n</p>\n", 2),
        ("site/templates/a.html", '{{ head(\n  "The nabob of") }}', 2),
        ("site/theme/a.js", "const a = 'no nabob here';\n", 1),
        ("README.md", "# Title\n\nAn\nNABOB.\n", 4),
    ],
)
def test_a_word_in_a_text_is_found(root: Path, file: str, text: str, line: int) -> None:
    word = "NABOB" if "NABOB" in text else "nabob"
    assert found(root, file, text) == [f'{file}:{line}: [prose] "{word}": write "subclass"']


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("docs/a.rst", "The field ``nabob``, and :module:`nabob`.\n"),
        ("src/a.cpp", "int nabob = nabobs.at(0);\n"),
        ("tools/a.py", 'nabob = names["nabob"]\n'),
        (
            "site/templates/a.html",
            "{% for nabob in nabobs %}{{ nabob }}{{ row('nabob') }}{% endfor %}",
        ),
        ("docs/a.rst", "A nabobish, and src/nabob.cpp.\n"),
    ],
)
def test_a_name_is_no_word(root: Path, file: str, text: str) -> None:
    assert found(root, file, text) == []


def test_words_may_be_on_two_lines(root: Path) -> None:
    assert found(root, "docs/a.rst", "It is read once\nmore.\n") == [
        'docs/a.rst:1: [prose] "once more": write again'
    ]


def test_a_secret_begins_with_a_noun(root: Path) -> None:
    assert found(root, "src/a.hpp", "/// @secret The steps, which differ.\nclass A;\n") == []
    assert found(root, "src/a.hpp", "/// @secret Perchance a step.\nclass A;\n") == [
        'src/a.hpp:1: [prose] "@secret Perchance": write a noun'
    ]


def test_a_plain_word_is_right_in_some_phrases_and_in_a_question(root: Path) -> None:
    terms = TERMS.replace("``twixt``", "``twixt``, ``what``")
    (root / GLOSSARY).write_text(terms)
    assert found(root, "docs/a.rst", "Sleep twixt 2 o'clock and\n3.\n") == []
    assert found(root, "docs/a.rst", "What happens now?\n") == []
    assert found(root, "docs/a.rst", "Twixt two o'clock.\n\nThis is what happens.\n") == [
        'docs/a.rst:1: [prose] "Twixt": write its noun',
        'docs/a.rst:3: [prose] "what": write its noun',
    ]


def test_a_phrase_ends_at_code(root: Path) -> None:
    assert found(root, "design/a.toml", 'a = "all of it once"\nb = "more than one"\n') == []


def test_a_word_next_to_a_tag_is_found(root: Path) -> None:
    assert len(found(root, "site/templates/a.html", "<p>A nabob</p>\n")) == 1
