"""The paper's Z algorithm, and its comparison with Lemke's method."""
