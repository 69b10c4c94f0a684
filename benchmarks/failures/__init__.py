"""Where floating point fails and pivoting takes long: the catalogue of `notes/stability.md`."""
