"""Sphinx settings of the pages.

portal.sphinx_pages adds the paths, the first page and the navigation."""

project = "Weeding robot"
copyright = ""  # noqa: A001 - the name that Sphinx reads
extensions = ["breathe", "myst_parser", "portal.sphinx_extension"]
exclude_patterns = ["_static", "_doxygen", "_bodies"]
highlight_language = "none"
breathe_default_project = "firmware"

html_theme = "theme"
html_theme_path = ["."]
html_copy_source = False
html_show_sourcelink = False
html_use_index = False
html_domain_indices = False
html_permalinks_icon = "#"
