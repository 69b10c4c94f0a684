"""Exact numbers and vectors of them."""
