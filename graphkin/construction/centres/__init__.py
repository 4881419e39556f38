"""Instant centres: permanent ones, Kennedy's theorem with its circle diagram, velocities by centres, centrodes."""

from graphkin.construction.centres.find import Centre, Centres, centres_on, find_centres
from graphkin.construction.centres.speed_sentences import points_asked, velocity_sentences
from graphkin.construction.centres.speeds import Turning, by_centres, error_by_centres, speeds

__all__ = [
    "Centre",
    "Centres",
    "Turning",
    "by_centres",
    "centres_on",
    "error_by_centres",
    "find_centres",
    "points_asked",
    "speeds",
    "velocity_sentences",
]
