"""Exact solutions as files, for whoever wants to check a simulation without installing anything."""
