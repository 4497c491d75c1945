"""Shows the reports of the robot as they arrive."""

from __future__ import annotations

import argparse
import sys
import time

from weeding_robot_client.exit_codes import DONE
from weeding_robot_client.link import Link
from weeding_robot_client.messages import WHEELS, Report
from weeding_robot_client.options import add_link, opened, positive
from weeding_robot_client.orders import not_connected
from weeding_robot_client.reasons import conditions, faults, latched

DESCRIPTION = """\
Connects to the robot and shows its reports. In a terminal, the command shows a table and
updates it. Otherwise, the command prints one line for each report. The table and the lines contain
the reason why the robot does not move, and the source of a stop. The table also shows the round
trip time of the handshake. A value that is missing or stale is shown as '-'. Ctrl-C ends the
program. Only one program may use the serial port at a time. ./wr drive also shows the reports."""
EPILOG = ""
MISSING = "-"
CLEAR = "\x1b[H\x1b[J"
PATIENCE_S = 0.1


def add_options(parser: argparse.ArgumentParser) -> None:
    add_link(parser)
    parser.add_argument("--lines", action="store_true", help="print one line for each report")
    parser.add_argument(
        "--reports", type=positive, metavar="N", help="end after this number of reports"
    )


def run(options: argparse.Namespace) -> int:
    table = sys.stdout.isatty() and not options.lines
    count = 0
    state: tuple[bool, str] | None = None
    with opened(options) as (link, recording):
        while options.reports is None or count < options.reports:
            reports = link.service(PATIENCE_S)
            if state != (link.connected, not_connected(link)):
                state = (link.connected, not_connected(link))
                print(status(link), file=sys.stderr)
            for report in reports:
                recording.add(report)
                print(CLEAR + as_table(report, link) if table else as_line(report), flush=True)
                count += 1
                if count == options.reports:
                    break
    return DONE


def status(link: Link) -> str:
    """Returns the state of the connection, with the time of day."""
    text = not_connected(link)
    if link.connected and link.welcome:
        text = f"connected to {firmware(link)}; last reset: {link.welcome.start}"
        text += f"\n{link.welcome.schema_note}" if link.welcome.schema_note else ""
    return f"{time.strftime('%H:%M:%S')} {text}"


def firmware(link: Link) -> str:
    if link.welcome is None:
        return "an unknown firmware"
    return f"firmware {'.'.join(map(str, link.welcome.version))} build {link.welcome.build_id}"


def shown(value: float | None, form: str) -> str:
    return MISSING if value is None else format(value, form)


def flags(report: Report) -> str:
    marks = [
        ("armed", report.armed),
        ("stop", report.stop),
        ("held", report.held),
        ("overrun", report.overran),
    ]
    return " ".join(name for name, is_set in marks if is_set)


def inhibit(report: Report) -> str:
    """Returns a short form of the reason why the robot does not follow its set-points."""
    if report.inhibit == "none":
        return ""
    detail = ""
    if report.inhibit == "stop":
        detail = f" of {', '.join(report.stop_sources)}" if report.stop_sources else ""
    if latched(report):
        detail += "" if report.inhibit == "protective stop" else "; protective stop"
        detail += f": {report.stop_cause}"
    return f"[{report.inhibit}{detail}] "


def source(report: Report) -> str:
    if report.source is None:
        return "no order yet"
    if report.source == "RC":
        return "order of the RC"
    device = "PC" if report.source == "PC" else f"{report.source} device"
    return f"order {report.order_id} of the {device}"


def as_line(report: Report) -> str:
    ordered = dict.fromkeys(str(wheel.set_point) for wheel in report.wheels)
    velocities = " ".join(shown(wheel.velocity_rpm, ".1f") for wheel in report.wheels)
    return (
        f"{report.cycle:7} {report.time_ms / 1000:9.1f} s  {report.state:12} {report.mode}  "
        f"{source(report):22} {report.steering_set_point_degrees:g} deg, {', '.join(ordered)}  "
        f"measured {shown(report.steering_degrees, '.2f')} deg, {velocities} rpm  "
        f"{inhibit(report)}{flags(report)}"
    ).rstrip() + "".join(f"; {fault}" for fault in faults(report))


def session(link: Link) -> str:
    if link.welcome is None:
        return f"session {MISSING}"
    return f"session {link.welcome.session}   last reset: {link.welcome.start}"


def as_table(report: Report, link: Link) -> str:
    lines = [
        f"{firmware(link)}, {session(link)}",
        f"cycle {report.cycle}, {report.time_ms / 1000:.1f} s   state {report.state}   "
        f"reading mode {report.mode}   {source(report)}   {flags(report)}".rstrip(),
        f"stop ordered by: {', '.join(report.stop_sources) or 'nobody'}   round trip: order "
        f"{shown(report.round_trip_ms, 'd')} ms, at connect {shown(link.handshake_ms, 'd')} ms",
        "",
        f"steering: set-point {report.steering_set_point_degrees:.2f} deg, measured "
        f"{shown(report.steering_degrees, '.2f')} deg, turn {shown(report.turn, 'd')}, "
        f"{report.steering_state}",
        "",
        f"{'wheel':12} {'set-point':>12} {'rpm':>8} {'A':>8} {'counts':>9} {'V applied':>10} "
        f"{'rejected':>9}",
    ]
    for name, wheel in zip(WHEELS, report.wheels, strict=True):
        lines.append(
            f"{name:12} {wheel.set_point!s:>12} {shown(wheel.velocity_rpm, '.1f'):>8} "
            f"{shown(wheel.current_amperes, '.2f'):>8} {shown(wheel.position_counts, 'd'):>9} "
            f"{shown(wheel.tension_volts, '.2f'):>10} {wheel.rejected_edges:>9}"
        )
    lines += ["", *(conditions(report) or ["no fault; the robot follows its orders"])]
    raised = [f"{name} {count}" for name, count in report.counters.items() if count]
    lines += ["", "counters: " + (", ".join(raised) or "all 0")]
    if link.welcome and link.welcome.schema_note:
        lines += ["", link.welcome.schema_note]
    if link.damaged:
        lines.append(f"frames from the robot that were damaged: {link.damaged}")
    return "\n".join(lines)
