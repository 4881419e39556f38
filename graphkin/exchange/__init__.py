"""Other people's mechanisms: files of PMKS and PMKS+, Linkage, pyslvs, pylinkage and GeoGebra, read and written."""

from __future__ import annotations

from graphkin.exchange.bodies import FRAME, Bodies, BodyDrive, BodySlide
from graphkin.exchange.files import READ, WRITTEN, read_bodies, write_bodies
from graphkin.exchange.pmks import is_address

__all__ = ["FRAME", "READ", "WRITTEN", "Bodies", "BodyDrive", "BodySlide", "is_address", "read_bodies", "write_bodies"]
