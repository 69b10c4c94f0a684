"""Forces that somebody computed, held against ours."""
