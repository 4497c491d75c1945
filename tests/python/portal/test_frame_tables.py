"""The tables of the protocol page. They are generated from the table of frames."""

import re
import struct
from pathlib import Path

import pytest

from portal.frame_tables import frame_tables

pytestmark = pytest.mark.reads("design/frames.toml", "docs/protocol.rst")

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "protocol.rst"
CODES = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "i32": "i", "char8": "8s"}


@pytest.fixture(scope="module")
def tables() -> dict[str, str]:
    return frame_tables(ROOT)


def rows(table: str) -> list[list[str]]:
    """Returns the cells of each row below the table head."""
    parts = re.split(r"^   \* - ", table, flags=re.MULTILINE)[2:]
    return [[cell.strip() for cell in re.split(r"\n     -", part)] for part in parts]


@pytest.mark.parametrize("frame", ["Hello", "Welcome", "Confirm", "Order", "Report"])
def test_the_offsets_of_a_table_cover_the_payload(tables: dict[str, str], frame: str) -> None:
    types = {row[1]: row for row in rows(tables["frame_types.inc"])}
    size = int(types[frame][3].split()[0])
    covered: list[int] = []
    for offsets, kind, *_ in rows(tables[f"frame_{frame.lower()}.inc"]):
        for offset in map(int, offsets.split(", ")):
            covered += range(offset, offset + struct.calcsize(f"<{CODES[kind]}"))
    assert sorted(covered) == list(range(size))


def test_rows_have_unit_meaning_and_values(tables: dict[str, str]) -> None:
    report = {row[2]: row for row in rows(tables["frame_report.inc"])}
    assert report["``velocity0`` to ``3``"][:2] == ["30, 38, 46, 54", "i16"]
    assert report["``velocity0`` to ``3``"][3] == "0.1 rpm"
    assert report["``tension0`` to ``3``"][3] == "mV"
    assert "0 Working, 1 Waiting" in report["``state``"][4]
    assert "255 none" in report["``stop_wheel``"][4]
    assert "bit 4 ``armed``" in report["``flags``"][4]
    assert "12 ``steering``" in report["``measured``"][4]
    assert ":ref:`protocol-stops`" in report["``stop_cause``"][4]
    order = {row[2]: row for row in rows(tables["frame_order.inc"])}
    assert order["``steering_set_point``"][3] == "0.01 degree, -3200 to 3200"
    assert "1 Tension (voltage) in mV, -24000 to 24000" in order["``quantity0`` to ``3``"][4]


def test_values_have_tables(tables: dict[str, str]) -> None:
    types = {row[1]: row for row in rows(tables["frame_types.inc"])}
    assert types["Order"][:4] == ["0x04", "Order", "PC to MCU", "21 bytes"]
    assert rows(tables["values_reset_cause.inc"])[4][:3] == ["4", "``Watchdog``", "watchdog"]
    assert len(rows(tables["values_inhibit.inc"])[0]) == 4


@pytest.mark.parametrize("table", ["values_stop_cause.inc", "values_reset_cause.inc"])
def test_causes_have_first_checks(tables: dict[str, str], table: str) -> None:
    assert "     - check first\n" in tables[table]
    checks = {row[1]: row[4] for row in rows(tables[table])}
    assert "replace the board" in checks["``ClockLost``"]
    assert {name for name, check in checks.items() if not check} <= {"``None``", "``Debugger``"}


def test_each_counter_has_first_checks(tables: dict[str, str]) -> None:
    counters = {row[0]: row[1:] for row in rows(tables["counters.inc"])}
    assert len(counters) == 13
    assert {"``damaged``", "``stale_orders``", "``rejected_edges0`` to ``3``"} <= counters.keys()
    assert all(meaning and check for meaning, check in counters.values())


def test_the_page_includes_tables_that_exist(tables: dict[str, str]) -> None:
    used = set(re.findall(r"include:: /_generated/(\S+)", PAGE.read_text(encoding="utf-8")))
    assert used - {"connection.inc"} <= tables.keys()
    assert {f"frame_{name}.inc" for name in ("types", "order", "welcome", "report")} <= used
