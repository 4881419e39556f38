"""Ink: what a figure is made of, strokes, fills and texts on a page in mm, and the kinematic symbols."""
