"""Linear complementarity problems and Lemke's method, exactly."""
