"""From a scene to a proved solution, and what the solution means."""
