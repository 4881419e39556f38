"""The algebra of links and groups: poses, dyads, constraints, and the bounds of their errors."""
