"""Exit statuses of the command line."""

SOLVED, ERROR, USAGE, UNSTABLE, DIFFER = 0, 1, 2, 3, 4
