"""Exit statuses of the command line."""

SOLVED, ERROR, USAGE, UNSTABLE = 0, 1, 2, 3
