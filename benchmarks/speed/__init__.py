"""How fast the package itself is, beside the bounds that are set for it."""
