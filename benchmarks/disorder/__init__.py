"""Disorder: what random initial gaps do to the four piles, and how fast samples are."""
