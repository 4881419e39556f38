"""Along the driver: paths, ranges, dead points, assemblies, and positions by name."""
