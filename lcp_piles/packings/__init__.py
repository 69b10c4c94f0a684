"""Packings of discs and spheres in floats, as they come from experiments and DEM codes."""
