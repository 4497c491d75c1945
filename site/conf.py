"""Sphinx settings of the portal. The program that builds it writes the pages that Sphinx reads."""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGES = HERE.parent / "build" / "pages"
sys.path.insert(0, str(HERE.parent))

project = "Weeding robot"
copyright = ""  # noqa: A001
extensions = ["breathe", "traceability.documents.extension"]
breathe_projects = {"firmware": str(PAGES / "_doxygen")}
breathe_default_project = "firmware"
root_doc = "index"
exclude_patterns = ["_static", "_doxygen"]
source_suffix = {".rst": "restructuredtext", ".page": "page"}
highlight_language = "none"
pygments_style = "default"

html_theme = "theme"
html_theme_path = ["."]
html_static_path = [str(PAGES / "_static")]
html_copy_source = False
html_show_sourcelink = False
html_use_index = False
html_domain_indices = False
html_permalinks_icon = "#"
html_context = {"groups": json.loads((PAGES / "navigation.json").read_text(encoding="utf-8"))}
