"""The readers of sources, comments, declarations and results. They do not judge their content."""
