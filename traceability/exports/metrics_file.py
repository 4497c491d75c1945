"""Writes the metrics of a run to ``build/metrics.json``, so that other programs can read them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from traceability.model.design_model import Model
from traceability.model.metrics import metrics
from traceability.model.report import Report
from traceability.reading.results import METRICS
from traceability.schema import Finding


def write_metrics(root: Path, model: Model, report: Report, measured: dict[str, Any]) -> Path:
    """Writes the metrics. ``measured`` contains additional metrics, which other steps of the run
    measured."""
    path = root / METRICS
    path.parent.mkdir(parents=True, exist_ok=True)
    values = metrics(model, report) | measured
    text = json.dumps(values, indent=1, sort_keys=True) + "\n"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return path


def site_figures(site: Path, findings: Iterable[Finding]) -> dict[str, Any]:
    """Returns two metrics of the built site: the number of pages, and the number of findings about
    dead links."""
    return {
        "site.pages": len(list(site.rglob("*.html"))),
        "site.dead_links": sum(1 for finding in findings if finding.check == "link-site"),
    }
