"""Instant centres: permanent ones, Kennedy's theorem with its circle diagram, velocities by centres, centrodes."""

from graphkin.drafting.centres.find import Centre, Centres, find_centres

__all__ = ["Centre", "Centres", "find_centres"]
