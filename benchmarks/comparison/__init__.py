"""Speed against accuracy: our methods, exact baselines and the solvers that a user would pick."""
