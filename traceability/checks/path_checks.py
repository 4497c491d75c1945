"""link-doc: the files and folders in texts exist."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from traceability.reading.source_lines import text_lines
from traceability.schema import Finding

PAGES = (".md", ".rst", ".toml")
# Matches the path of a project file that is in backticks or is the target of a link.
NAMED = re.compile(r"(?<!:)`(\w[\w.-]*/[\w./-]*)`|\]\((\w[\w.-]*/[\w./-]*)(?:#[^)]*)?\)")
SOURCES = (".rst", ".dox", ".toml", ".tree", ".hpp", ".cpp", ".py")
# Folders that do not contain sources.
NO_SOURCES = (".git", ".venv", "build")
# In these files, a text without a suffix, such as docs/client, is the name of a page of the portal.
WITH_SUFFIX = (".py", ".html")
# Lines of code that name a file relative to another folder.
RELATIVE = re.compile(r"\s*(?:#\s*include|include\()")
PLACEHOLDER = "FILE"


def missing_paths(root: Path) -> Iterator[Finding]:
    """Finds names of files and folders that do not exist. In all texts, the paths that begin with a
    folder of the project are checked. In pages and texts of design/, other paths in backticks are
    checked too."""
    pattern = _below(root)
    for place, line in text_lines(root):
        if "/" not in line or RELATIVE.match(line):
            continue
        suffix, folder = Path(place.file).suffix, (root / place.file).parent
        names = {name for name in pattern.findall(line) if _is_file(suffix, name)}
        if suffix in PAGES and not line.startswith("#"):
            names.update(_quoted(root, place.file, line))
        for name in sorted(names):
            if not ((root / name).exists() or (folder / name).exists()):
                yield Finding(place, "link-doc", f"there is no {name}")


def _below(root: Path) -> re.Pattern[str]:
    """Returns the pattern of a path that begins with a folder of the project. The pattern does not
    match parts of longer paths, or paths with a part that represents several names."""
    folders = [path.name for path in root.iterdir() if path.is_dir()]
    tops = "|".join(re.escape(name) for name in folders if name not in NO_SOURCES)
    return re.compile(rf"(?<![\w./~$:{{}}<>*\\@-])((?:{tops})/[\w./-]*\w/?)(?![\w*{{(<$%])")


def _is_file(suffix: str, name: str) -> bool:
    """Returns whether the name can be the path of a source. The check of the links of the site
    finds wrong names of pages."""
    path = Path(name)
    if path.suffix == ".html" or path.stem == PLACEHOLDER:
        return False
    return bool(path.suffix) or suffix not in WITH_SUFFIX


def _quoted(root: Path, file: str, line: str) -> Iterator[str]:
    for named in filter(None, sum(NAMED.findall(line), ())):
        top = named.split("/")[0]
        in_list = file.endswith("README.md") and named.endswith("/")
        is_path = (root / top).is_dir() or Path(named).suffix in SOURCES or in_list
        if is_path and top != "build":
            yield named
