"""Pictures of piles and paths."""
