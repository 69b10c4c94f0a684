"""Solutions as files and as text."""
