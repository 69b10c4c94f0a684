"""Ensembles: thousands of proved samples of a disordered pile, in files, and their statistics."""
