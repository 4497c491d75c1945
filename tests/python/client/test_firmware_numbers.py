"""The client and the oracle of the fuzzers do not read the firmware, but contain copies of its
numbers. The tests compare these copies with the firmware and with the table of frames."""

import re
from pathlib import Path

from weeding_robot_client import bring_up, capture, link, orders, script
from weeding_robot_client.frames import VERSION
from weeding_robot_client.layout import FRAMES, LAYOUTS

ROOT = Path(__file__).parents[3]
LINKTYPE_USER0 = 147  # first of the 16 link types for private use in a capture file


def milliseconds(name: str, file: str = "src/services/SystemConstants.hpp") -> int:
    """Returns the value [ms] of the time ``name`` in a file of the firmware."""
    text = (ROOT / file).read_text(encoding="utf-8")
    (value,) = re.findall(rf"\b{name}(?: =|\(\) const {{ return) milliseconds\((\d+)\);", text)
    return int(value)


def oracle() -> dict[str, list[int]]:
    """Returns the constants of the oracle: name -> numbers. An array has several numbers."""
    text = (ROOT / "tests/fuzz/LinkOracle.cpp").read_text(encoding="utf-8")
    found = re.findall(r"^ *constexpr .*?\b(k\w+)(?: = |\{)([^;}]+)", text, re.MULTILINE)
    return {
        name: [int(number, 0) for number in values.replace("'", "").split(",")]
        for name, values in found
    }


def test_the_client_sends_one_order_in_each_cycle() -> None:
    cycle = milliseconds("cyclePeriod")
    assert round(1000 * orders.ORDER_EVERY_S) == cycle < milliseconds("orderLifetime")
    assert round(1000 * bring_up.CYCLE_S) == cycle
    assert round(1000 * script.ACKNOWLEDGE_S) == 3 * cycle


def test_a_lost_keep_alive_does_not_end_the_connection() -> None:
    assert milliseconds("linkTimeout") > 2 * 1000 * link.KEEP_ALIVE_AFTER_S


def test_the_times_in_the_texts_of_the_client_are_those_of_the_firmware() -> None:
    assert round(1000 * orders.ORDER_LIFETIME_S) == milliseconds("orderLifetime")
    neutral = milliseconds("kNeutral", "extensions/safety/Arming.cpp")
    assert round(1000 * script.NEUTRAL_S) == neutral


def test_the_oracle_has_the_numbers_of_the_table_of_the_frames() -> None:
    order = LAYOUTS["Order"]
    quantities = FRAMES.enumerations["quantity"].entries
    expected = {
        "kVersion": [VERSION],
        "kHello": [LAYOUTS["Hello"].kind],
        "kConfirm": [LAYOUTS["Confirm"].kind],
        "kKeepAlive": [LAYOUTS["KeepAlive"].kind],
        "kOrder": [order.kind],
        "kOrderLength": [order.size],
        "kCommands": [order.of("commands").offset],
        "kSteeringAt": [order.of("steering_set_point").offset],
        "kWheelsAt": [order.of("quantity0").offset],
        "kSteeringLimit": [order.of("steering_set_point").limit],
        "kWheelLimits": [entry.limit for entry in quantities],
        "kSecond": [1000 * milliseconds("linkTimeout")],
        "kOrderLife": [1000 * milliseconds("orderLifetime")],
    }
    assert oracle() | expected == oracle()


def test_the_dissector_has_the_link_type_of_the_capture() -> None:
    names = re.findall(r"\bUSER\d+", capture.DISSECTOR.read_text(encoding="utf-8"))
    assert set(names) == {f"USER{capture.USER0 - LINKTYPE_USER0}"}
