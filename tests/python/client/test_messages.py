"""The messages of the client, compared with the worked examples of the protocol."""

import os
import random
import struct

import pytest

from tests.python.client.examples import examples
from weeding_robot_client.frames import Decoder, Frame
from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.messages import (
    Confirm,
    Hello,
    KeepAlive,
    MessageError,
    Order,
    Quantity,
    Report,
    ReportedSetPoint,
    Start,
    Welcome,
    WheelSetPoint,
    from_frame,
    to_frame,
)

SEED = int(os.environ.get("WR_SEED", "1"))


def example(start: str) -> Frame:
    """Returns the frame of the worked example whose name begins with ``start``."""
    (line,) = (line for name, *_, line in examples() if name.startswith(start))
    (frame,) = Decoder().feed(bytes.fromhex(line))
    return frame


def wheels(*values: tuple[Quantity, float]) -> tuple[WheelSetPoint, ...]:
    return tuple(WheelSetPoint(*value) for value in values)


RPM_150 = wheels(*[(Quantity.VELOCITY, 150.0)] * 4)
STILL = wheels(*[(Quantity.VELOCITY, 0.0)] * 4)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("hello", Hello()),
        ("confirm", Confirm(1)),
        ("keep alive", KeepAlive()),
        ("order 258", Order(258, -12.5, RPM_150, sent_at_ms=5000)),
        (
            "order 259",
            Order(
                259,
                0.0,
                wheels((Quantity.TENSION, 12.0), (Quantity.CURRENT, -2.5)) * 2,
                sent_at_ms=5100,
            ),
        ),
        ("order 260", Order(260, 0.0, STILL, stop=True, sent_at_ms=5200)),
        ("order 261", Order(261, 0.0, STILL, acknowledge=True, sent_at_ms=5300)),
    ],
)
def test_message_to_the_mcu_is_the_worked_example(name: str, message: Order) -> None:
    frame = example(name)
    assert to_frame(message, frame.sequence) == frame


def test_welcome_of_the_worked_examples() -> None:
    common = ((1, 0, 0), "0123abcd", 100, 4)
    assert from_frame(example("welcome: session 1")) == Welcome(1, *common, Start(1))
    after_fault = Start(cause=7, fault=1, number=3, address=0x4A6E)
    assert from_frame(example("welcome: session 2")) == Welcome(2, *common, after_fault)


@pytest.mark.parametrize(
    ("start", "words"),
    [
        (Start(0), "unknown cause"),
        (Start(1), "power on"),
        (Start(4), "watchdog"),
        (Start(8), "debugger"),
        (Start(9), "reset cause 9"),
        (Start(7, 1, 3, 0x4A6E), "software, after assertion 3 failed at 0x00004a6e"),
        (Start(7, 4, 0, 0x89ABCDEF), "software, after bus fault at 0x89abcdef"),
        (Start(7, 6, 38), "software, after unexpected interrupt, exception 38"),
        (Start(4, 7, 2), "watchdog, after clock failed in step 2"),
        (Start(200, 100, 5, 16), "reset cause 200, after fault 100, number 5 at 0x00000010"),
    ],
)
def test_a_start_is_told_in_words(start: Start, words: str) -> None:
    assert str(start) == words
    assert start.faulted == (" after " in words)


def test_report_of_the_worked_example() -> None:
    report = from_frame(example("report of cycle 7"))
    assert isinstance(report, Report)
    assert (report.cycle, report.time_ms, report.state, report.mode) == (7, 700, "Working", "PC")
    assert (report.source, report.order_id, report.order_read) == ("PC", 258, True)
    assert not (report.stop or report.held or report.overran)
    assert report.steering_set_point_degrees == -12.5
    assert [str(wheel.set_point) for wheel in report.wheels] == ["150 rpm"] * 4
    assert report.steering_degrees is None
    assert report.turn is None
    for wheel in report.wheels:
        assert wheel.velocity_rpm is None
        assert wheel.current_amperes is None
        assert wheel.position_counts is None
        assert wheel.tension_volts is None
    assert {name: count for name, count in report.counters.items() if count} == {
        "damaged": 1,
        "unexpected": 2,
    }


def test_report_of_the_worked_example_with_conditions() -> None:
    report = from_frame(example("report of cycle 8"))
    assert isinstance(report, Report)
    assert (report.cycle, report.time_ms) == (8, 800)
    assert (report.steering_degrees, report.turn) == (-12.44, -1)
    assert (report.steering_state, report.left_end, report.right_end) == ("turning", False, True)
    assert [wheel.velocity_rpm for wheel in report.wheels] == [148.0, 0.0, 0.0, 149.6]
    assert [wheel.current_amperes for wheel in report.wheels] == [2.15, 3.21, 0.0, 2.19]
    assert [wheel.position_counts for wheel in report.wheels] == [52, 0, -1, 55]
    assert [wheel.tension_volts for wheel in report.wheels] == [11.8, 12.1, 0.0, 11.95]
    assert [wheel.cut_off for wheel in report.wheels] == [False, False, True, False]
    assert [wheel.blind for wheel in report.wheels] == [False, True, False, False]
    assert [wheel.rejected_edges for wheel in report.wheels] == [0, 3, 0, 1]
    assert (report.report_cycles, report.awake_cycles, report.start_cycles) == (27354, 158211, 1043)


# name of a field of the report -> offset in the payload [byte], and format for ``struct``
FIELDS = {
    "cycle": (0, "<I"),
    "mode": (9, "<B"),
    "source": (10, "<B"),
    "flags": (11, "<B"),
    "steering": (28, "<h"),
    "measured": (62, "<H"),
    "turn": (72, "<b"),
    "applied": (73, "<B"),
    "overruns": (74, "<H"),
    "reports_not_sent": (94, "<H"),
    "steering_state": (96, "<B"),
    "ends": (97, "<B"),
    "cut_offs": (98, "<B"),
    "blind": (99, "<B"),
    "inhibit": (120, "<B"),
    "stop_cause": (121, "<B"),
    "stop_wheel": (122, "<B"),
    "stop_sources": (123, "<B"),
    "sent_at": (124, "<I"),
    "stale_orders": (128, "<H"),
}
REPORT_BYTES = LAYOUTS["Report"].size


def report_of(payload: bytes | bytearray) -> Report:
    report = from_frame(Frame(0x82, 0, bytes(payload)))
    assert isinstance(report, Report)
    return report


def report_with(**values: int) -> Report:
    payload = bytearray(REPORT_BYTES)
    for name, value in values.items():
        offset, form = FIELDS[name]
        struct.pack_into(form, payload, offset, value)
    return report_of(payload)


def test_flags_of_a_report() -> None:
    names = ("stop", "order_read", "held", "overran", "armed")
    for bit, name in enumerate(names):
        report = report_with(flags=1 << bit)
        assert [other for other in names if getattr(report, other)] == [name]


ARMED, READ = 1 << 4, 1 << 1
OF_RC, OF_PC = 0, 1


@pytest.mark.parametrize(
    ("mode", "source", "flags", "inhibit", "expected"),
    [
        (OF_PC, OF_PC, READ | ARMED, 0, True),
        (OF_PC, OF_PC, ARMED, 0, True),
        (OF_PC, OF_PC, READ, 0, True),
        (OF_PC, OF_PC, READ, 3, False),
        (OF_RC, OF_RC, READ | ARMED, 0, False),
        (OF_RC, OF_RC, READ, 0, False),
        (OF_RC, OF_PC, READ, 0, False),
    ],
)
def test_a_robot_is_ready_if_it_would_follow_the_pc(
    mode: int, source: int, flags: int, inhibit: int, expected: bool
) -> None:
    report = report_with(mode=mode, source=source, flags=flags, inhibit=inhibit)
    assert report.ready is expected


def test_each_measured_bit_makes_just_its_value_valid() -> None:
    measures = ("velocity_rpm", "current_amperes", "position_counts")
    for bit in range(12):
        report = report_with(measured=1 << bit)
        valid = [
            3 * wheel + number
            for wheel in range(4)
            for number, name in enumerate(measures)
            if getattr(report.wheels[wheel], name) is not None
        ]
        assert valid == [bit]
        assert report.steering_degrees is None
    assert report_with(measured=1 << 12, steering=-3200).steering_degrees == -32.0


def test_each_applied_bit_makes_just_its_value_valid() -> None:
    for bit in range(4):
        report = report_with(applied=1 << bit)
        valid = [n for n, wheel in enumerate(report.wheels) if wheel.tension_volts is not None]
        assert valid == [bit]
        assert report.turn is None
    assert report_with(applied=16, turn=-1).turn == -1


def test_wheel_values_have_their_own_places() -> None:
    payload = bytearray(REPORT_BYTES)
    for wheel in range(4):
        struct.pack_into("<Bh", payload, 16 + 3 * wheel, 1, 1000 * wheel)
        struct.pack_into("<hhi", payload, 30 + 8 * wheel, 10 + wheel, 20 + wheel, -70000 - wheel)
        struct.pack_into("<h", payload, 64 + 2 * wheel, -500 * wheel)
        struct.pack_into("<H", payload, 100 + 2 * wheel, 65535 - wheel)
    struct.pack_into("<H", payload, 62, 0x0FFF)
    payload[73] = 0x0F
    report = report_of(payload)
    for number, wheel in enumerate(report.wheels):
        assert wheel.set_point == ReportedSetPoint(number, "V")
        assert wheel.velocity_rpm == (10 + number) / 10
        assert wheel.current_amperes == (20 + number) / 1000
        assert wheel.position_counts == -70000 - number
        assert wheel.tension_volts == -0.5 * number
        assert wheel.rejected_edges == 65535 - number


def test_each_bit_of_a_condition_is_of_one_wheel_or_one_end() -> None:
    for bit in range(4):
        cut_off = report_with(cut_offs=1 << bit).wheels
        assert [number for number, wheel in enumerate(cut_off) if wheel.cut_off] == [bit]
        assert not any(wheel.blind for wheel in cut_off)
        blind = report_with(blind=1 << bit).wheels
        assert [number for number, wheel in enumerate(blind) if wheel.blind] == [bit]
        assert not any(wheel.cut_off for wheel in blind)
    for ends in range(4):
        report = report_with(ends=ends)
        assert (report.left_end, report.right_end) == (bool(ends & 1), bool(ends & 2))


def test_counters_are_twelve_numbers() -> None:
    report = report_with(overruns=3, reports_not_sent=65535, stale_orders=8)
    assert len(report.counters) == 12
    assert report.counters["overruns"] == 3
    assert report.counters["reports_not_sent"] == 65535
    assert report.counters["stale_orders"] == 8


def test_state_of_the_safety_functions() -> None:
    report = report_with(
        inhibit=4, stop_cause=5, stop_wheel=2, stop_sources=0b11, sent_at=4_000_000_000
    )
    assert (report.inhibit, report.stop_cause) == ("protective stop", "wrong direction")
    assert (report.stop_wheel, report.stop_sources) == (2, ("RC", "PC"))
    assert report.sent_at_ms == 4_000_000_000
    assert report_with(stop_wheel=255).stop_wheel is None


def test_every_value_on_the_line_survives_the_units() -> None:
    layout = LAYOUTS["Report"]
    zeros = dict.fromkeys(layout.names, 0)
    for quantity in Quantity:
        most = round(quantity.limit * quantity.scale)
        for raw in range(-most, most + 1, 97):
            numbers = {**zeros, "quantity0": quantity.code, "set_point0": raw}
            shown = Report.from_payload(layout.pack(**numbers)).wheels[0].set_point
            assert shown.unit == quantity.unit
            assert WheelSetPoint(quantity, shown.value).raw() == (quantity.code, raw)


def test_random_orders_hold_their_fields_where_the_protocol_says() -> None:
    source = random.Random(SEED)
    for _ in range(500):
        chosen = [source.choice(list(Quantity)) for _ in range(4)]
        points = wheels(*[(q, round(source.uniform(-q.limit, q.limit), 1)) for q in chosen])
        angle = source.randrange(-3200, 3201)
        sent = source.randrange(1 << 33)
        stop, acknowledge = source.random() < 0.5, source.random() < 0.5
        order = Order(source.randrange(65536), angle / 100, points, stop, acknowledge, sent)
        payload = order.payload()
        assert len(payload) == 21
        head = (order.order_id, sent % 2**32, angle)
        assert struct.unpack_from("<HIh", payload) == head, f"seed {SEED}"
        for wheel, point in enumerate(points):
            assert struct.unpack_from("<Bh", payload, 8 + 3 * wheel) == point.raw()
        assert payload[20] == stop + 2 * acknowledge


@pytest.mark.parametrize(
    ("quantity", "value"),
    [
        (Quantity.VELOCITY, 300.1),
        (Quantity.TENSION, -24.1),
        (Quantity.CURRENT, 10.1),
        (Quantity.CURRENT, float("nan")),
    ],
)
def test_a_set_point_out_of_range_is_refused(quantity: Quantity, value: float) -> None:
    with pytest.raises(MessageError, match="not within"):
        WheelSetPoint(quantity, value)


def test_an_order_out_of_range_is_refused() -> None:
    with pytest.raises(MessageError, match="degrees"):
        Order(1, 32.01, RPM_150)
    with pytest.raises(MessageError, match="order id"):
        Order(65536, 0.0, RPM_150)


@pytest.mark.parametrize(
    ("frame", "reason"),
    [
        (Frame(0x82, 0, bytes(REPORT_BYTES - 1)), f"{REPORT_BYTES - 1} bytes"),
        (Frame(0x81, 0, bytes(28)), "28 bytes"),
        (Frame(0x81, 0, bytes(22), version=1), "22 bytes"),
        (Frame(0x83, 0, b""), "0x83"),
        (Frame(0x82, 0, bytes(130), version=3), "version 3"),
    ],
)
def test_a_frame_that_is_no_message_is_refused(frame: Frame, reason: str) -> None:
    with pytest.raises(MessageError, match=reason):
        from_frame(frame)


def test_longer_payloads_of_later_robots_are_accepted() -> None:
    payload = bytes(REPORT_BYTES)
    assert from_frame(Frame(0x82, 0, payload + b"later")) == from_frame(Frame(0x82, 0, payload))
    frame = example("welcome: session 1")
    longer = Frame(frame.kind, frame.sequence, frame.payload + b"later")
    assert from_frame(longer) == from_frame(frame)


@pytest.mark.parametrize(
    ("offset", "field", "shown"),
    [
        (8, "state", "state 77"),
        (9, "mode", "mode 77"),
        (10, "source", "source 77"),
        (96, "steering_state", "steering state 77"),
        (120, "inhibit", "inhibit 77"),
        (121, "stop_cause", "stop cause 77"),
        (122, "stop_wheel", 77),
    ],
)
def test_a_number_without_a_name_is_shown_as_a_number(
    offset: int, field: str, shown: object
) -> None:
    payload = bytearray(REPORT_BYTES)
    payload[offset] = 77
    report = report_of(payload)
    assert getattr(report, field) == shown


def test_an_unknown_quantity_and_a_value_out_of_range_are_shown() -> None:
    payload = bytearray(REPORT_BYTES)
    struct.pack_into("<BhBh", payload, 16, 9, -123, 0, 32000)
    report = report_of(payload)
    assert str(report.wheels[0].set_point) == "-123 (quantity 9)"
    assert str(report.wheels[1].set_point) == "3200 rpm"


def test_an_unknown_source_of_a_stop_is_shown_as_a_number() -> None:
    assert report_with(stop_sources=0b10000100).stop_sources == ("Bluetooth", "source 7")


def test_the_welcome_of_version_1_names_its_version() -> None:
    welcome = from_frame(Frame(0x81, 0, bytes(23), version=1))
    assert isinstance(welcome, Welcome)
    assert welcome.protocol_versions == (1, 1)
    assert welcome.schema_hash is None


def test_the_numbers_of_all_products_have_names() -> None:
    report = report_of((bytes(8) + b"\4\2\2").ljust(REPORT_BYTES, b"\0"))
    assert (report.state, report.mode, report.source) == ("WaitingK", "Bluetooth", "Bluetooth")
