"""Sweeps: the motion of a whole turn, limit positions, transmission, classes, diagrams; and the same over designs."""
