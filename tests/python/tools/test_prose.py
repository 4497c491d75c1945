"""The prose linter: its words come from the glossary, and it looks where a person reads."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from tools.prose import GLOSSARY, RECORD, Words, check_prose, check_text, read_words
from tools.steps import FailureError
from traceability.model.metrics import prose

ROOT = Path(__file__).parents[3]
WORD = "heir"  # no text of this file may contain it
SOURCE = f"""Glossary
========

.. glossary::

   subclass
      A class that is derived from another class.

      Not: {WORD}, has {WORD}s, ^so.

   voltage
      Of a motor.

      Not: tension.
      Except: tension order,
      tension orders.

   noun
      A name.

      Not: what.
      Say: its noun.
"""


@pytest.fixture
def words() -> Words:
    return read_words(SOURCE)


def found(words: Words, name: str, text: str) -> list[str]:
    return [str(misuse) for misuse in check_text(words, name, text)]


MESSAGE = f'"{WORD}": say "subclass" (glossary: subclass)'


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.rst", f"Text\n====\n\nEach {WORD} of it.\n", 4),
        ("a.hpp", f"int a;\n/// @brief An {WORD} of it.\nint b;", 2),
        ("a.cpp", f"int a;  // one\n\n/* the\n * {WORD} */", 4),
        ("a.cpp", f'fail("no {WORD} of " + name);', 1),
        ("a.cpp", f'fail("nothing is found,"\n  " no {WORD}");', 2),
        ("a.py", f'"""A class.\n\nAn {WORD}.\n"""', 3),
        ("a.py", f'a = 1\nb = f"the {WORD} of {{a}}"', 2),
        ("a.py", f"a = 1  # the {WORD}", 1),
        ("a.toml", f'a = "the {WORD} of it"', 1),
        ("a.toml", f"# the {WORD}\na = 1", 1),
        ("a.html", f"<p>\n{{% if a %}}\nthe {WORD}</p>", 3),
        ("a.html", f'<p>\n{{{{ note("{WORD} of it") }}}}</p>', 2),
        ("a.dox", f"/** @page a A\n The {WORD}\n*/", 2),
        ("CMakeLists.txt", f"set(a)\n# the {WORD}\n", 2),
    ],
)
def test_a_forbidden_word_is_found(words: Words, name: str, text: str, line: int) -> None:
    assert found(words, name, text) == [f"{name}:{line}: {MESSAGE}"]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.cpp", f"int {WORD} = of({WORD}, a);  // the ``{WORD}`` of it"),
        ("a.cpp", f'#include "{WORD}"\nput("{WORD}");  // `{WORD}` and {WORD}::a, a_{WORD}'),
        ("a.py", f'a = {{"{WORD}": {WORD}.of(1, f"a {{{WORD}}} of it")}}'),
        ("a.toml", f"{WORD} = 1\nfind = '''the {WORD} of it'''"),
        ("a.rst", f"A :module:`{WORD}`::\n\n   the {WORD} of it\n\nText"),
        ("a.html", f'<p class="{WORD}">{{{{ {WORD} }}}}</p>'),
        ("a.rst", "A tension order and tension\norders. ``tension``. What is it?"),
    ],
)
def test_names_quotations_exceptions_and_questions_are_not_found(
    words: Words, name: str, text: str
) -> None:
    assert found(words, name, text) == []


def test_a_phrase_may_cross_a_line_and_may_belong_to_a_head(words: Words) -> None:
    assert len(found(words, "a.cpp", f"// It has\n// {WORD}s.")) == 1
    assert found(words, "a.cpp", "// It is so. It is\n// so.\nint a;") == []
    assert len(found(words, "a.cpp", "// It is here. So it is.")) == 1
    assert len(found(words, "a.cpp", "// So it is.")) == 1


def test_the_message_names_the_replacement(words: Words) -> None:
    (message,) = found(words, "a.rst", "One knows what it is.")
    assert message == 'a.rst:1: "what": say "its noun" (glossary: noun)'


def test_the_count_is_a_metric_of_the_run(tmp_path: Path) -> None:
    assert prose(tmp_path) == {}
    (tmp_path / "docs").mkdir()
    (tmp_path / GLOSSARY).write_text(SOURCE)
    check_prose(tmp_path, StringIO())
    assert prose(tmp_path) == {"prose.findings": 0}
    (tmp_path / "docs" / "a.rst").write_text(f"The {WORD}.\nThe {WORD}.\n")
    log = StringIO()
    with pytest.raises(FailureError, match="2 words"):
        check_prose(tmp_path, log)
    assert f"docs/a.rst:2: {MESSAGE}" in log.getvalue()
    assert json.loads((tmp_path / RECORD).read_text()) == {"findings": 2}


def test_the_glossary_of_the_project_lists_the_word() -> None:
    words = read_words((ROOT / GLOSSARY).read_text(encoding="utf-8"))
    assert found(words, "src/a.hpp", f"/// @brief The {WORD}s of it.")
