"""The model, built once for documents, checks and figures."""

from __future__ import annotations

from pathlib import Path

from traceability.model.build import build
from traceability.model.schema import Model


def build_model(root: Path) -> Model:
    return build(root.resolve())
