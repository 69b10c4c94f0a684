"""What a solution is, what it means, and the check of it from the scene alone."""
