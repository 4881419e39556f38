"""The public functions, one for each command, and the results they return: `graphkin` has them all by name."""
