"""What is read off a solution: stress, pressure on the base, sums over layers and sizes."""
