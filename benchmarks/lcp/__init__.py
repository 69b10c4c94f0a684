"""LCPs, games and quadratic programmes of everybody, against other solvers."""
