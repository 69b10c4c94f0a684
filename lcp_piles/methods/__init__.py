"""Ways from a contact system to its solution, exact and in floating point."""
