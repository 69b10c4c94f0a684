"""Linear programmes: solved exactly, with certificates."""
