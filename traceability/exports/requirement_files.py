"""Exports the requirements for other tools: as a CSV table, as needs of sphinx-needs, and as
ReqIF."""

from __future__ import annotations

import csv
import io
import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from itertools import groupby

from traceability.exports.trace_items import (
    METHOD,
    REQUIREMENT,
    TEST,
    VALUES,
    TraceItem,
    trace_items,
)
from traceability.model.design_model import Model
from traceability.model.report import Report

CSV, NEEDS, REQIF = "requirements.csv", "needs.json", "requirements.reqif"
PROJECT = "weeding_robot"
# ReqIF demands a date. A fixed date is used, because equal models must have equal files.
EPOCH = "1970-01-01T00:00:00+00:00"
NAMESPACE = "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"
NEED_TYPES = {REQUIREMENT: "req", TEST: "test", METHOD: "impl"}
NOT_IN_NAME = re.compile(r"[^\w.-]")


# ---- CSV -----------------------------------------------------------------------


def csv_text(model: Model, report: Report) -> str:
    """Returns a CSV table with one row for each requirement."""
    lines = io.StringIO()
    columns = ["id", "text", "state", *VALUES, "file", "line", "verified_by", "satisfied_by"]
    table = csv.DictWriter(lines, columns, lineterminator="\r\n")
    table.writeheader()
    for item in trace_items(model, report):
        if item.kind == REQUIREMENT:
            requirement = model.requirements[item.id]
            table.writerow(
                {
                    "id": item.id,
                    "text": item.text,
                    "state": item.state,
                    **item.values,
                    "file": item.file,
                    "line": item.line,
                    "verified_by": " ".join(requirement.verified_by),
                    "satisfied_by": " ".join(requirement.satisfied_by),
                }
            )
    return lines.getvalue()


# ---- sphinx-needs --------------------------------------------------------------


def needs_text(model: Model, report: Report) -> str:
    """Returns the JSON file of sphinx-needs. Each requirement, test and method is a need. The link
    ``verifies`` leads from a test to a requirement, and the link ``satisfies`` leads from a method
    to a requirement."""
    needs = {item.id: _need(item) for item in trace_items(model, report)}
    version = {"needs": needs, "needs_amount": len(needs), "filters": {}, "filters_amount": 0}
    content = {
        "project": PROJECT,
        "current_version": model.version,
        "versions": {model.version: version},
    }
    return json.dumps(content, indent=1) + "\n"


def _need(item: TraceItem) -> dict[str, object]:
    link = {TEST: "verifies", METHOD: "satisfies"}.get(item.kind)
    return {
        "id": item.id,
        "type": NEED_TYPES[item.kind],
        "title": item.title,
        "content": item.text,
        "status": item.state or None,
        "place": item.place,
        **item.values,
        **({link: list(item.links)} if link else {}),
    }


# ---- ReqIF ---------------------------------------------------------------------


def reqif_text(model: Model, report: Report) -> str:
    """Returns the XML file in ReqIF 1.0.1. Each requirement, test and method is a ReqIF object.
    Each link is a relation, and each section of the requirements is a chapter."""
    items = trace_items(model, report)
    top = ET.Element("REQ-IF", xmlns=NAMESPACE)
    header = _child(_child(top, "THE-HEADER"), "REQ-IF-HEADER", IDENTIFIER="header")
    for tag, text in {
        "CREATION-TIME": EPOCH,
        "REPOSITORY-ID": model.sources_hash,
        "REQ-IF-TOOL-ID": PROJECT,
        "REQ-IF-VERSION": "1.0",
        "SOURCE-TOOL-ID": PROJECT,
        "TITLE": f"{PROJECT} {model.version}",
    }.items():
        _child(header, tag).text = text
    content = _child(_child(top, "CORE-CONTENT"), "REQ-IF-CONTENT")
    _add_types(content)
    objects = _child(content, "SPEC-OBJECTS")
    for item in items:
        values = {"ReqIF.ForeignID": item.id, "ReqIF.Text": item.text, "state": item.state}
        _add_object(objects, item.kind, item.id, {**values, "place": item.place, **item.values})
    for section, _ in _sections(items):
        _add_object(objects, "chapter", section, {"ReqIF.ChapterName": section.partition(" ")[2]})
    relations = _child(content, "SPEC-RELATIONS")
    ids = {item.id for item in items}
    for item in items:
        for link in item.links:
            if link in ids:
                _add_relation(relations, item, link)
    _add_specification(_child(content, "SPECIFICATIONS"), items)
    ET.indent(top)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ET.tostring(top, encoding="unicode")}\n'


def _child(parent: ET.Element, tag: str, **attributes: str) -> ET.Element:
    return ET.SubElement(
        parent, tag, {key.replace("_", "-"): text for key, text in attributes.items()}
    )


def _named(parent: ET.Element, tag: str, identifier: str, **attributes: str) -> ET.Element:
    return _child(parent, tag, IDENTIFIER=identifier, LAST_CHANGE=EPOCH, **attributes)


def _id(kind: str, name: str) -> str:
    return f"{kind}-{NOT_IN_NAME.sub('_', name)}"


# Requirements tools expect these names for the first two attributes.
ATTRIBUTES = {
    REQUIREMENT: ("ReqIF.ForeignID", "ReqIF.Text", "state", "place", *VALUES),
    TEST: ("ReqIF.ForeignID", "ReqIF.Text", "state", "place"),
    METHOD: ("ReqIF.ForeignID", "place"),
    "chapter": ("ReqIF.ChapterName",),
}
RELATIONS = {TEST: "verifies", METHOD: "satisfies"}


def _add_types(content: ET.Element) -> None:
    _named(_child(content, "DATATYPES"), "DATATYPE-DEFINITION-STRING", "string",
           LONG_NAME="string", MAX_LENGTH="100000")  # fmt: skip
    types = _child(content, "SPEC-TYPES")
    for kind, names in ATTRIBUTES.items():
        described = _named(types, "SPEC-OBJECT-TYPE", f"type-{kind}", LONG_NAME=kind)
        attributes = _child(described, "SPEC-ATTRIBUTES")
        for name in names:
            attribute = _named(
                attributes, "ATTRIBUTE-DEFINITION-STRING", _attribute(kind, name), LONG_NAME=name
            )
            _child(_child(attribute, "TYPE"), "DATATYPE-DEFINITION-STRING-REF").text = "string"
    for name in RELATIONS.values():
        _named(types, "SPEC-RELATION-TYPE", f"type-{name}", LONG_NAME=name)
    _named(types, "SPECIFICATION-TYPE", "type-specification", LONG_NAME="specification")


def _attribute(kind: str, name: str) -> str:
    return f"attribute-{kind}-{name}"


def _add_object(objects: ET.Element, kind: str, name: str, values: dict[str, str]) -> None:
    made = _named(objects, "SPEC-OBJECT", _id(kind, name), LONG_NAME=name)
    _child(_child(made, "TYPE"), "SPEC-OBJECT-TYPE-REF").text = f"type-{kind}"
    attributes = _child(made, "VALUES")
    for attribute in filter(values.get, ATTRIBUTES[kind]):  # StrictDoc rejects an empty value.
        value = _child(attributes, "ATTRIBUTE-VALUE-STRING", THE_VALUE=values[attribute])
        reference = _child(_child(value, "DEFINITION"), "ATTRIBUTE-DEFINITION-STRING-REF")
        reference.text = _attribute(kind, attribute)


def _sections(items: list[TraceItem]) -> Iterable[tuple[str, list[TraceItem]]]:
    """Returns the sections with their requirements, in the order of the model. If a requirement of
    another section is between the requirements of a section, this section occurs twice."""
    requirements = [item for item in items if item.kind == REQUIREMENT]
    for number, (section, group) in enumerate(
        groupby(requirements, lambda item: item.values["section"]), 1
    ):
        yield f"{number} {section}", list(group)


def _add_relation(relations: ET.Element, item: TraceItem, link: str) -> None:
    name = RELATIONS[item.kind]
    relation = _named(relations, "SPEC-RELATION", _id(name, f"{item.id}-{link}"))
    _child(_child(relation, "TYPE"), "SPEC-RELATION-TYPE-REF").text = f"type-{name}"
    _child(_child(relation, "SOURCE"), "SPEC-OBJECT-REF").text = _id(item.kind, item.id)
    _child(_child(relation, "TARGET"), "SPEC-OBJECT-REF").text = _id(REQUIREMENT, link)


def _add_specification(specifications: ET.Element, items: list[TraceItem]) -> None:
    made = _named(specifications, "SPECIFICATION", "specification", LONG_NAME=PROJECT)
    _child(_child(made, "TYPE"), "SPECIFICATION-TYPE-REF").text = "type-specification"
    children = _child(made, "CHILDREN")
    for section, members in _sections(items):
        chapter = _add_place(children, "chapter", section)
        inner = _child(chapter, "CHILDREN")
        for item in members:
            _add_place(inner, item.kind, item.id)


def _add_place(parent: ET.Element, kind: str, name: str) -> ET.Element:
    place = _named(parent, "SPEC-HIERARCHY", _id(f"place-{kind}", name))
    _child(_child(place, "OBJECT"), "SPEC-OBJECT-REF").text = _id(kind, name)
    return place
