"""The model, built once for documents, checks and figures."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

from traceability.model.build import build
from traceability.model.schema import Model

MODEL = Path("build/model/model.json")


def build_model(root: Path) -> Model:
    """Reads all sources, and leaves the model in a file for other programs."""
    model = build(root.resolve())
    text = json.dumps(dataclasses.asdict(dataclasses.replace(model, facts=None)), indent=1)
    path = root / MODEL
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return model
