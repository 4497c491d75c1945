"""The search of the built site: each hit leads to a place that exists."""

from tests.python.site.content import SITE, content, searched


def exists(address: str) -> bool:
    page, _, part = address.partition("#")
    return (SITE / page).is_file() and (not part or part in content(page).ids)


def test_each_entry_leads_to_a_place() -> None:
    assert [entry[4] for entry in searched() if not exists(entry[4])] == []


def test_words_of_hand_written_pages_and_of_the_paper_are_found() -> None:
    written = [entry for entry in searched() if entry[0] == "Explanations"]
    assert ["Debug", "Flash and wire the board"] in [entry[2:4] for entry in written]
    assert any("115200 baud" in entry[5] for entry in written)
    assert {"Figure 6", "WaitingMAX"} <= {e[2] for e in searched() if e[0] == "Paper"}
