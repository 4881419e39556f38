"""Instant centres: permanent ones, Kennedy's theorem with its circle diagram, velocities by centres, centrodes."""

from graphkin.drafting.centres.find import Centre, Centres, find_centres
from graphkin.drafting.centres.sentences import points_asked, velocity_sentences
from graphkin.drafting.centres.speeds import Turning, by_centres, speeds

__all__ = ["Centre", "Centres", "Turning", "by_centres", "find_centres", "points_asked", "speeds", "velocity_sentences"]
