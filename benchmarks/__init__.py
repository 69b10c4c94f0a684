"""Benchmarks of lcp_piles: each module is a script, `python -m benchmarks.NAME`."""
