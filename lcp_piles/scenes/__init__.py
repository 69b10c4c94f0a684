"""What is to be solved: discs, contacts, the piles of the paper, mirror symmetry."""
