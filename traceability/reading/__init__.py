"""The readers of source files, comments, declarations and results. They only read. The checks judge
what was read."""
