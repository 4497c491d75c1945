"""An include is seen in each way in which the preprocessor lets it be written."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.reading.syntax import includes_of


@pytest.mark.parametrize(
    "line",
    [
        '#include "lamp/Lamp.hpp"',
        "#include <lamp/Lamp.hpp>",
        '/* of a lamp */ #include "lamp/Lamp.hpp"',
        '%:include "lamp/Lamp.hpp"',
        '# include /* it */ "lamp/Lamp.hpp"',
    ],
)
def test_include_is_seen(tmp_path: Path, line: str) -> None:
    (tmp_path / "src/lamp").mkdir(parents=True)
    (tmp_path / "src/lamp/Lamp.hpp").write_text("#pragma once\n")
    (tmp_path / "src/main.cpp").write_text(f"{line}\n")
    found = [(one.target, one.place.line) for one in includes_of(tmp_path, "src/main.cpp")]
    assert found == [("src/lamp/Lamp.hpp", 1)]
