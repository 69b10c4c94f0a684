"""Exit statuses of the command line."""

SOLVED, ERROR, USAGE, UNSTABLE, DIFFER, UNRESOLVED = range(6)
