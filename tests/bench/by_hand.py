"""A four-bar and a slider-crank as somebody would write them for just this mechanism, in NumPy; and the shaper for
numba, in blocks that stay in the first cache."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

__all__ = ["WRITTEN", "compiled_shaper"]

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


def compiled_shaper(sizes: tuple[float, ...]) -> Callable[[float, float, np.ndarray], None]:
    """Function of first angle, step and twelve columns, shape (12, n), that fills them on one thread."""
    import numba

    block, fine = 512, 64
    r, high, lever, rod, guide, w = *sizes, OMEGA

    @numba.njit(error_model="numpy", fastmath={"contract"}, forceinline=True)
    def turn(angle):
        q = np.rint(angle * 0.6366197723675814)
        x = (angle - q * 1.5707963267341256) - q * 6.077100506303966e-11
        z = x * x
        s = -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10
        s = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * s))
        s = x + x * z * (-1.66666666666666324348e-01 + z * s)
        c = 2.08757232129817482790e-09 + z * -1.13596475577881948265e-11
        c = -1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * c))
        c = 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * c)
        m = q - 4.0 * np.floor(q * 0.25)
        d, e = abs(m - 2.0) - 1.0, 1.0 - abs(m - 1.0)
        return d * c - e * s, e * c + d * s

    @numba.njit(error_model="numpy", fastmath={"contract"})
    def shaper(start, step, out):
        n = out.shape[1]
        cosine, sine, fc, fs = np.empty(block), np.empty(block), np.empty(fine), np.empty(fine)
        gc, gs = np.empty(block // fine), np.empty(block // fine)
        for k in range(fine):
            fc[k], fs[k] = turn(step * k)
        for first in range(0, n, block):
            count = min(block, n - first)
            for j in range(block // fine):
                gc[j], gs[j] = turn(start + step * (first + fine * j))
            for j in range(block // fine):
                cj, sj = gc[j], gs[j]
                one, two = cosine[fine * j : fine * (j + 1)], sine[fine * j : fine * (j + 1)]
                for k in range(fine):
                    one[k], two[k] = cj * fc[k] - sj * fs[k], sj * fc[k] + cj * fs[k]
            last = first + count
            o0, o1, o2, o3 = out[0, first:last], out[1, first:last], out[2, first:last], out[3, first:last]
            o4, o5, o6, o7 = out[4, first:last], out[5, first:last], out[6, first:last], out[7, first:last]
            o8, o9, o10, o11 = out[8, first:last], out[9, first:last], out[10, first:last], out[11, first:last]
            for k in range(count):
                x, y = r * cosine[k], r * sine[k]
                up = high + y
                over = 1.0 / math.sqrt(x * x + up * up)
                ux, uy = x * over, up * over
                vx, vy = -w * y, w * x
                slip, w4 = vx * ux + vy * uy, (vy * ux - vx * uy) * over
                al4 = (w * w * (x * uy - y * ux) - 2.0 * w4 * slip) * over
                bx, by = lever * ux, lever * uy
                vbx, vby = -w4 * by, w4 * bx
                abx, aby = -w4 * w4 * bx - al4 * by, -w4 * w4 * by + al4 * bx
                rise = guide - by
                run = math.sqrt(rod * rod - rise * rise)
                short = 1.0 / run
                w5 = vby * short
                al5 = (aby - w5 * w5 * rise) * short
                o0[k], o1[k], o2[k], o3[k] = bx, by, bx - run, guide
                o4[k], o5[k], o6[k], o7[k] = vbx, vby, vbx - w5 * rise, 0.0
                o8[k], o9[k], o10[k], o11[k] = abx, aby, abx - al5 * rise + w5 * w5 * run, 0.0

    return shaper
