"""Piles that are not quite rigid: the first correction exactly, and the whole nonlinear pile."""
