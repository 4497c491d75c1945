"""Sphinx settings of the pages that people write, and of Doxygen's views.

traceability.documents.sphinx_pages adds the paths and the navigation.
"""

project = "Weeding robot"
copyright = ""  # noqa: A001 - the name that Sphinx reads
extensions = ["breathe", "traceability.documents.extension"]
root_doc = "doxygen/index"
exclude_patterns = ["_static", "_doxygen"]
highlight_language = "none"
breathe_default_project = "firmware"

html_theme = "theme"
html_theme_path = ["."]
html_copy_source = False
html_show_sourcelink = False
html_use_index = False
html_domain_indices = False
html_permalinks_icon = "#"
