"""Solutions along one parameter, exactly, through every rearrangement."""
