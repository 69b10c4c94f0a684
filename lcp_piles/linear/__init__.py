"""Sparse linear algebra: exact solutions, kernels, proofs of definiteness, factors of bands."""
