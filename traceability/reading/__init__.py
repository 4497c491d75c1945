"""The readers of sources, comments, declarations and results. They do not judge what they read."""
