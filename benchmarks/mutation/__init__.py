"""Mutants of the package: which errors in the code no test would notice."""
