"""Exports the model as JSON, and the JSON schema of the model."""

from __future__ import annotations

import dataclasses
import json
import types
import typing
from collections.abc import Mapping, Sequence
from typing import Any

from traceability import schema
from traceability.model.design_model import Model
from traceability.model.report import Report, words_of

MODEL = "model.json"
SCHEMA = "model.schema.json"
DIALECT = "https://json-schema.org/draft/2020-12/schema"
# Data class -> fields that are added to the JSON objects of this class. These fields are in the
# report and not in the model.
VERDICT = {"state": str, "reasons": list[str]}
ADDED: dict[type, dict[str, Any]] = {
    Model: {"findings": list[schema.Finding]},
    schema.Requirement: VERDICT,
    schema.Evidence: {"value": float | None},
    schema.SafetyGoal: VERDICT,
    schema.FaultScenario: {"state": str},
    schema.PatternApplication: {"clauses": list[schema.Clause]},
}
PLAIN: dict[type, str] = {str: "string", int: "integer", float: "number", bool: "boolean"}


def model_text(model: Model, report: Report) -> str:
    """Returns the model with the verdicts as JSON. It contains the same places, names and texts as
    the pages."""

    def fields(record: object) -> dict[str, Any]:
        return _fields(record) | _verdict(record, report)

    return json.dumps(model, default=fields)


def _fields(record: Any) -> dict[str, Any]:
    return {field.name: getattr(record, field.name) for field in dataclasses.fields(record)}


def _verdict(record: object, report: Report) -> dict[str, Any]:
    """Returns the fields from the report that are added to the JSON object of a record."""
    fields: dict[str, Any] = {}
    match record:
        case Model():
            fields["findings"] = report.findings
        case schema.Requirement():
            verdict = report.requirements[record.id]
            fields = {"state": words_of(verdict.state), "reasons": verdict.reasons}
        case schema.SafetyGoal():
            fields = _fields(report.goals[record.id])
        case schema.Evidence():
            fields["value"] = report.measured[record.figure]
        case schema.FaultScenario():
            fields["state"] = words_of(report.scenarios[record.name])
        case schema.PatternApplication():
            fields["clauses"] = report.clauses[record.id]
    return fields


def schema_text() -> str:
    return json.dumps(schema_of(Model, "Model of the weeding robot's software"), indent=1)


def schema_of(kind: type, title: str) -> dict[str, Any]:
    """Returns the JSON schema of a file. ``kind`` is the data class of the file's content. The
    schema also describes all data classes that ``kind`` contains."""
    definitions: dict[str, Any] = {}
    top = _class(kind, definitions)
    return {"$schema": DIALECT, "title": title} | top | {"$defs": dict(sorted(definitions.items()))}


def _class(kind: type, definitions: dict[str, Any]) -> dict[str, Any]:
    fields = typing.get_type_hints(kind) | ADDED.get(kind, {})
    described = {
        "type": "object",
        "properties": {name: _type(annotation, definitions) for name, annotation in fields.items()},
        "required": list(fields),
        "additionalProperties": False,
    }
    words = (kind.__doc__ or "").strip()
    if not words.startswith(f"{kind.__name__}("):
        described["description"] = " ".join(words.split())
    return described


def _type(kind: Any, definitions: dict[str, Any]) -> dict[str, Any]:
    if kind is Any:
        return {}
    if kind in PLAIN:
        return {"type": PLAIN[kind]}
    if isinstance(kind, type) and dataclasses.is_dataclass(kind):
        name = kind.__name__
        if name not in definitions:
            # ``definitions`` receives the name before the description is ready, because a class may
            # contain objects of the same class.
            definitions[name] = {}
            definitions[name] = _class(kind, definitions)
        return {"$ref": f"#/$defs/{name}"}
    return _composed(kind, [_type(argument, definitions) for argument in typing.get_args(kind)])


def _composed(kind: Any, parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Returns the schema of a list, of a mapping, of a tuple, or of a union of types."""
    schemas: dict[Any, dict[str, Any]] = {
        types.NoneType: {"type": "null"},
        types.UnionType: {"anyOf": parts},
        Sequence: {"type": "array", "items": parts[0] if parts else {}},
        tuple: {"type": "array", "prefixItems": parts, "minItems": len(parts), "items": False},
        Mapping: {"type": "object", "additionalProperties": parts[-1] if parts else {}},
    }
    origin = typing.get_origin(kind) or kind
    origin = {list: Sequence, dict: Mapping}.get(origin, origin)
    if origin not in schemas:
        raise TypeError(f"the schema cannot describe {kind}")
    return schemas[origin]
