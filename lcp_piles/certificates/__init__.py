"""Certificates: what was found, in a file that anyone can prove without this package."""
