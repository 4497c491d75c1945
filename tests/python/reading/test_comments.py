"""Comments, with their tags, texts and lines, and with the declarations to which they belong."""

from __future__ import annotations

from pathlib import Path

from tests.python.project_files import write_files
from traceability.reading.comments import Comment, code_of, read_comments
from traceability.reading.declared import Declared
from traceability.reading.source_facts import Facts, gather_facts
from traceability.reading.syntax import read_syntax

HEADER = """\
#pragma once
namespace wr {
/// @brief Speed of a `Wheel`, \\, and more,
/// on two lines.
///
/// Other items:
/// - one item
///   of two lines
/// - another item
///
/// @secret The method by which it is measured.
/// @hides{k64/Register.hpp}
/// @role{wheels, Concrete State} @role{orders, Context}
/// @patternapp{orders, State, Title with, a comma
/// in two lines}
/// @why Because.
///
/// @patternapp{others, Command, Other}
/// @datatype
template <class T, int kNumber>
class Speed {
 public:
  /// @brief Sets it.
  /// @param value speed [0.1 rpm],
  ///   signed
  /// @param other `@param` is no tag here, nor is a@b
  /// @isr{depends on this, and that}
  /// @satisfies FR-1
  /// @satisfies FR-2, FR-3
  [[nodiscard]] virtual int
  set(int value, int other);
  int count =
      0;      ///< behind the value
  int next;   ///< of one line,
              ///< and a second one
  int silent;
  enum Kind { kOne, ///< first
    kTwo };
  virtual ~Speed() = default;
  Speed(const Speed&) = delete;
  friend bool operator==(Speed, Speed) = default;

 private:
  int hidden;
};
}  // namespace wr
"""


def comments_of(text: str) -> list[Comment]:
    return list(read_comments("a.hpp", text))


def facts_of(root: Path) -> Facts:
    write_files(root, {"src/a/Speed.hpp": HEADER})
    return gather_facts(root, read_syntax(root, root / "cache"), Declared())


def test_a_tag_has_its_text_its_arguments_and_its_line() -> None:
    comment = comments_of(HEADER)[0]
    assert (comment.place.line, comment.place.end) == (3, 19)
    assert comment.brief == "Speed of a `Wheel`, , and more, on two lines."
    assert comment.details == "Other items:\n- one item of two lines\n- another item"
    assert comment.one("secret") == "The method by which it is measured."
    assert comment.all("hides") == ["k64/Register.hpp"]
    roles = [(*tag.arguments, tag.place.line) for tag in comment.of("role")]
    assert roles == [("wheels", "Concrete State", 13), ("orders", "Context", 13)]
    assert comment.of("datatype")


def test_the_tags_up_to_the_next_of_a_name_belong_together() -> None:
    first, second = comments_of(HEADER)[0].parts("patternapp")
    title = "Title with, a comma in two lines"
    assert first.tags[0].arguments == ["orders", "State", title]
    assert (first.one("why"), second.one("why")) == ("Because.", "")
    assert second.place.line == 18


def test_words_and_their_texts() -> None:
    comment = comments_of(HEADER)[1]
    texts = comment.texts("param")
    assert texts["value"] == "speed [0.1 rpm], signed"
    assert texts["other"] == "`@param` is no tag here, nor is a@b"
    assert comment.one("isr") == "depends on this, and that"
    assert comment.words("satisfies") == ["FR-1", "FR-2"]
    assert [tag.text for tag in comment.of("satisfies")] == ["", "FR-3"]
    assert comment.source(without=("satisfies", "isr", "param")) == "@brief Sets it."


def test_requirements_of_one_block_are_read_apart() -> None:
    text = "/**\n@requirement FR-1 One.\n\n@level x\n\n@requirement FR-2 Two.\n*/\n"
    one, two = comments_of(text)[0].parts("requirement")
    assert (one.tags[0].argument, one.tags[0].text, one.one("level")) == ("FR-1", "One.", "x")
    assert (two.tags[0].text, two.one("level"), two.place.line) == ("Two.", "", 6)


def test_only_comments_of_documentation_are_read() -> None:
    text = "int a; // no\n/* no */\n//// no\n"
    text += "auto s = \"/// no\"; char c = '\"'; /// yes\nint b = 1'000;\n"
    assert [comment.brief for comment in comments_of(text)] == ["yes"]
    assert code_of(text).splitlines()[0] == "int a;"


def test_a_comment_belongs_to_its_declaration(tmp_path: Path) -> None:
    facts = facts_of(tmp_path)
    fact = facts.classes["Speed"]
    assert facts.comment(fact).one("secret") == "The method by which it is measured."
    assert facts.comment(fact.methods[0]).brief == "Sets it."
    texts = {one.name: facts.comment(one).brief for one in fact.fields}
    assert texts["count"] == "behind the value"
    assert texts["next"] == "of one line, and a second one"
    assert texts["silent"] == ""
    assert fact.parameters == ["T", "kNumber"]


def test_declarations_without_a_comment_are_silent(tmp_path: Path) -> None:
    names = {one.name for one in facts_of(tmp_path).syntax.silent}
    # The comment of ``count`` is behind the value. Only a later step of the check finds this
    # comment.
    wanted = {"silent", "count", "Kind", "Kind::kTwo", "operator=="}
    assert names == {f"Speed::{name}" for name in wanted}
