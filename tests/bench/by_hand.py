"""A four-bar and a slider-crank as somebody would write them for just this mechanism, in NumPy."""

from __future__ import annotations

import numpy as np

__all__ = ["WRITTEN"]

OMEGA = 10.0


def four_bar(angle: np.ndarray) -> np.ndarray:
    """Twelve columns of the four-bar, shape (12, n)."""
    r, b, c, d = 0.15, 0.5, 0.3, 0.4
    cos, sin = np.cos(angle), np.sin(angle)
    bx, by = r * cos, r * sin
    lx, ly = d - bx, -by
    square = lx * lx + ly * ly
    along = (b * b - c * c) / (2 * square) + 0.5
    inside = (b / np.sqrt(square)) ** 2 - along * along
    height = np.sqrt(inside)
    px, py = lx * along - ly * height, ly * along + lx * height
    qx, qy = px - lx, py - ly
    vbx, vby = -OMEGA * by, OMEGA * bx
    abx, aby = -OMEGA * OMEGA * bx, -OMEGA * OMEGA * by
    det = px * qy - py * qx
    w2 = -(vbx * qx + vby * qy) / det
    w3 = -(vbx * px + vby * py) / det
    vcx, vcy = -w3 * qy, w3 * qx
    fx = -w3 * w3 * qx + w2 * w2 * px - abx
    fy = -w3 * w3 * qy + w2 * w2 * py - aby
    a3 = (fx * px + fy * py) / det
    acx, acy = -w3 * w3 * qx - a3 * qy, -w3 * w3 * qy + a3 * qx
    return np.array([bx, by, bx + px, by + py, vbx, vby, vcx, vcy, abx, aby, acx, acy])


def slider_crank(angle: np.ndarray) -> np.ndarray:
    """Twelve columns of the slider-crank, shape (12, n)."""
    r, rod, e = 0.05, 0.15, 0.02
    cos, sin = np.cos(angle), np.sin(angle)
    bx, by = r * cos, r * sin
    rise = e - by
    run = np.sqrt(rod * rod - rise * rise)
    vbx, vby = -OMEGA * by, OMEGA * bx
    abx, aby = -OMEGA * OMEGA * bx, -OMEGA * OMEGA * by
    w = -vby / run
    vcx = vbx - w * rise
    alpha = (w * w * rise - aby) / run
    acx = abx - alpha * rise - w * w * run
    zero = np.zeros_like(bx)
    return np.array([bx, by, bx + run, zero + e, vbx, vby, vcx, zero, abx, aby, acx, zero])


WRITTEN = {"four-bar": four_bar, "slider-crank": slider_crank}
