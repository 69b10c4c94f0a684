"""Exit statuses of the command line."""

SOLVED, ERROR, USAGE, UNSTABLE, DIFFER, UNRESOLVED = range(6)
INTERRUPTED = 130
"""What shells say of a program that Ctrl-C ended: 128 and the number of the signal."""
