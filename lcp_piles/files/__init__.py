"""Solutions as files."""
