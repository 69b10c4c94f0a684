"""Benchmarks of lcp_piles: four programs, each a folder and `python -m benchmarks.FOLDER`."""
