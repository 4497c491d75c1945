"""Writes reports as JSON messages of an MCAP file. The schema contains the unit of each value."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap.writer import Writer

from weeding_robot_client.layout import BY_QUANTITY, LAYOUTS, Field, Layout, value_name
from weeding_robot_client.messages import Report

TOPIC = "/report"
SCHEMA_NAME = "weeding_robot.Report"
ROUND_TRIP = "round_trip_ms"
CHUNK = 1 << 16  # greatest number of bytes that an interrupted run loses: reports of a few seconds
NANOSECONDS = 1_000_000  # in one ms


def schema_of(layout: Layout) -> dict[str, Any]:
    """Returns the JSON Schema of the values of a frame."""
    missing = {name for field in layout.fields for name in field.valid}
    properties: dict[str, Any] = {}
    for one in layout.fields:
        if one.bits:
            properties |= {
                bit.name: {"type": "boolean", "description": bit.meaning} for bit in one.bits
            }
        elif not one.valid:
            properties[value_name(one)] = _of_field(one, one.name in missing)
    return {"type": "object", "title": layout.name, "properties": properties}


def _of_field(one: Field, may_miss: bool) -> dict[str, Any]:
    kind = _type_of(one)
    described: dict[str, Any] = {
        "type": [kind, "null"] if may_miss or one.none is not None else kind,
        "description": f"{one.meaning} [{one.unit}]" if one.unit else one.meaning,
    }
    if one.bits_of:
        described["items"] = {"type": "string"}
    return described


def _type_of(one: Field) -> str:
    if one.bits_of:
        return "array"
    if one.values or one.type == "char8":
        return "string"
    return "number" if one.unit == BY_QUANTITY or one.scale != 1 else "integer"


class McapFile:
    """An MCAP file to which reports are written.

    The log time of a message is the time of this computer. The publish time of a message is the
    time that the clock of the robot showed.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("wb")
        self._writer = Writer(self._file, chunk_size=CHUNK)
        self._writer.start(profile="", library="weeding_robot_client")
        schema = schema_of(LAYOUTS["Report"])
        schema["properties"][ROUND_TRIP] = {
            "type": ["integer", "null"],
            "description": "time from the order to this report, by the clock of this computer [ms]",
        }
        number = self._writer.register_schema(
            SCHEMA_NAME, "jsonschema", json.dumps(schema).encode()
        )
        self._channel = self._writer.register_channel(TOPIC, "json", number)

    def add(self, report: Report) -> None:
        values = {**report.values, ROUND_TRIP: report.round_trip_ms}
        self._writer.add_message(
            self._channel,
            log_time=time.time_ns(),
            publish_time=report.time_ms * NANOSECONDS,
            sequence=report.cycle,
            data=json.dumps(values).encode(),
        )

    def close(self) -> None:
        self._writer.finish()  # type: ignore[no-untyped-call]  # mcap has no types
        self._file.close()


def read_mcap(path: Path) -> Iterator[dict[str, Any]]:
    """Returns the values of each report."""
    with path.open("rb") as file:
        for _, _, message in make_reader(file).iter_messages(topics=[TOPIC]):
            yield json.loads(message.data)
