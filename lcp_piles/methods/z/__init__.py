"""The paper's Z algorithm."""
