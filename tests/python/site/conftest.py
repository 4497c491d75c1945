"""The exported model of the built site, which several tests read."""

import json
from typing import Any

import pytest

from tests.python.site.content import SITE


@pytest.fixture(scope="module")
def model() -> dict[str, Any]:
    path = SITE / "model.json"
    assert path.exists() and (SITE / "index.html").exists(), "build the portal first: ./wr portal"
    return dict(json.loads(path.read_text(encoding="utf-8")))
