"""What the paper claims and what it left open, computed: the tables of `notes/paper.md`."""
