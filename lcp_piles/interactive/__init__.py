"""A solution as a page of a browser that answers questions: one file, without a network."""
