"""Linear and convex quadratic programmes, exactly."""
