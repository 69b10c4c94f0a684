"""Proofs for packings in floats, of exactly the packing that was given."""
