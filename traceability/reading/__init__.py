"""The readers of source files, comments, declarations and results. The readers do not judge the
texts that they read. The checks judge them."""
