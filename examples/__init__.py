"""One short script a use: `python -m examples.NAME`, or read it."""
