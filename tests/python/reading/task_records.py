"""Records of tasks, in the form in which the task runner doit writes them."""

import json
from pathlib import Path
from typing import Any

from doit.dependency import MD5Checker

from traceability.reading.task_record import RECORD


def record_task(root: Path, task: str, *folders: str) -> None:
    """Records that a task was done with the present contents of its input files. The list
    ``folders`` contains the input files, and folders with input files."""
    found = [path for name in folders for path in (root / name, *(root / name).rglob("*"))]
    files = {
        str(path.relative_to(root)): MD5Checker().get_state(str(path), None)
        for path in found
        if path.is_file()
    }
    path = root / RECORD
    known: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {}
    known[task] = {"deps:": list(files), "checker:": "MD5Checker", **files}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(known))
