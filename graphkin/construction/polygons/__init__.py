"""Velocity and acceleration polygons: the graph of relative motions, its equations, and their drawing."""
