"""Ink: strokes, fills and texts on a page in mm, and the kinematic symbols."""
