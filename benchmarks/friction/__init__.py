"""What friction leaves open: the figures and tables of `notes/friction.md`."""
