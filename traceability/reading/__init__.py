"""The readers of source files, comments, declarations and results. They only read; the checks judge
the result."""
