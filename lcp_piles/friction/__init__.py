"""Friction, exactly: which forces Coulomb's law admits, and what it leaves open."""
