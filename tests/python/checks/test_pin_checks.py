"""On a page, a signal or a connector can be next to a pin. The check verifies that the table of
pins lists the same signal or connector for this pin."""

from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.checks.pin_checks import PIN, PINS, ROW, wrong_pins

ROOT = Path(__file__).parents[3]
ROWS = """
{{Port::A, 1, Mux::Gpio, Role::Input}, "left_end", "J1-8", "High when the end stop is reached."},
{{Port::C, 18, Mux::Gpio, Role::Input}, "right_end", "J6-8", "High when the end stop is reached."},
{{Port::C, 8, Mux::Gpio, Role::LowOutput}, "steering_step", "J1-7", "Each pulse turns by a step."},
"""


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("   * - end stops PTA1, PTC18 and the step PTC8", []),
        ("   * - end stops PTA1, PTC8", ["PTC8 is not the pin of 'end stops'"]),
        ("- left end: PTA1 (J1-8)\n- steering: PTC18", ["PTC18 is not the pin of 'steering'"]),
        ("PTC8 (J6-8), PTC18, J6-8", ["PTC8 is not the pin of 'J6-8'"]),
        ("PTA1\n(right end stop)", ["PTA1 is not the pin of 'right end stop'"]),
        ("When PTC8 is low, connect the contact to PTC18. PTA0 (left end)", []),
    ],
)
def test_a_pin_next_to_another_signal_is_found(tmp_path: Path, text: str, found: list[str]) -> None:
    write_files(tmp_path, {"src/k64/pins.hpp": ROWS, "docs/page.rst": text})
    assert [finding.text for finding in wrong_pins(tmp_path)] == found


@pytest.mark.reads("src/k64/pins.hpp")
def test_comments_of_the_table_name_only_unused_pins() -> None:
    """A page may contain each pin that these comments contain. Suppose that a comment contained a
    pin of the table, and that this pin were later removed from the table. The checks would then not
    find the pages that still contain this pin."""
    text = (ROOT / PINS).read_text(encoding="utf-8")
    used = {f"PT{row[0]}{row[1]}" for row in ROW.findall(text)}
    assert used.isdisjoint(PIN.findall(text))
