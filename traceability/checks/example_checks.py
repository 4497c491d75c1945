"""doc-name: mypy finds no wrong name, parameter or type in the Python examples on the pages."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from textwrap import dedent

from traceability.reading.result_cache import cached_result
from traceability.reading.source_lines import texts_below
from traceability.schema import Finding, Place
from traceability.sources import files_below, hash_of

PAGES = ("README.md", "docs", "changes", "ports")
BLOCK = re.compile(
    r"^ *\.\. code-block:: python\n((?:\n| .*\n)+)|^```python\n((?:(?!```).*\n)+)", re.MULTILINE
)
OPTIONS = ("--config-file=", "--no-incremental", "--follow-imports=silent")
PROBLEM = re.compile(r"^example(\d+)\.py:(\d+): error: (.*)  \[([\w-]+)\]$", re.MULTILINE)
NOT_INSTALLED = ("import-not-found", "import-untyped")  # examples may import other packages
CLIENT = "weeding_robot_client"


def wrong_examples(root: Path) -> Iterator[Finding]:
    """Finds errors in the Python examples of the pages. mypy stops at an example that is not valid
    Python, and then reports only this error."""
    examples = list(_examples(root))
    client = hash_of(root, files_below(root, ("client",), (".py",)))
    cache = root / "build/model/examples.pickle"
    found = cached_result(cache, [examples, client], lambda: _problems(examples, root / "client"))
    for number, line, text, kind in found:
        if kind not in NOT_INSTALLED or CLIENT in text:
            place = Place(examples[int(number)][0], int(line))
            yield Finding(place, "doc-name", text, "correct the example")


def _examples(root: Path) -> Iterator[tuple[str, str]]:
    """Yields the page and the code of each example. Blank lines precede the code, so that each line
    has the same number as on the page."""
    for file, text in texts_below(root, PAGES, (".md", ".rst")):
        for match in BLOCK.finditer(text):
            group = match.lastindex or 0
            above = "\n" * text.count("\n", 0, match.start(group))
            yield file, above + dedent(match[group])


def _problems(examples: list[tuple[str, str]], client: Path) -> list[tuple[str, ...]]:
    """Returns the errors that mypy reports. Each error has the number of its example, its line, its
    text and its kind."""
    if not examples:
        return []
    with tempfile.TemporaryDirectory() as folder:
        names = [f"example{number}.py" for number in range(len(examples))]
        for name, (_, code) in zip(names, examples, strict=True):
            Path(folder, name).write_text(code, encoding="utf-8")
        run = subprocess.run(
            [Path(sys.executable).with_name("mypy"), *OPTIONS, *names],
            cwd=folder,
            env={**os.environ, "MYPYPATH": str(client)},
            capture_output=True,
            text=True,
            check=False,
        )
    problems: list[tuple[str, ...]] = PROBLEM.findall(run.stdout)
    if run.returncode and not problems:
        raise RuntimeError(f"mypy cannot check the examples: {run.stdout}{run.stderr}")
    return problems
