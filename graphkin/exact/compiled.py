"""Formulas compiled for the processor, where numba is installed (the extra ``fast``)."""

from __future__ import annotations

import math
from collections.abc import Callable
from threading import Lock
from typing import Any

import numpy as np

from graphkin.errors import CallError, Problem

__all__ = ["compiled", "turn_lines"]

_ONE_AT_A_TIME = Lock()
"""The threads of numba serve one caller at a time."""


def turn_lines(angle: str, cosine: str, sine: str) -> list[str]:
    """Code for cosine and sine in plain operations, so that several positions can be computed at once.

    The polynomials are those of fdlibm (Sun Microsystems, 1993: k_sin.c, k_cos.c), right to the last place but one;
    what is a quarter turn within the rounding of the angle gives an exact zero.
    """
    return [
        f"q = rint({angle} * 0.6366197723675814)",
        f"r = (({angle} - q * 1.5707963267341256) - q * 6.077100506303966e-11) - q * 2.0222662487959506e-21",
        "z = r * r",
        "s = r + r * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * ("
        "-1.98412698298579493134e-04 + z * (2.75573137070700676789e-06"
        " + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))))",
        "h = 0.5 * z",
        "w = 1.0 - h",
        "c = w + (((1.0 - w) - h) + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * ("
        "2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * "
        "-1.13596475577881948265e-11))))))",
        f"s = s if abs(r) > 4e-16 * abs({angle}) else 0.0",
        "m = q - 4.0 * floor(q * 0.25)",
        "d = abs(m - 2.0) - 1.0",
        "e = 1.0 - abs(m - 1.0)",
        f"{cosine} = d * c - e * s",
        f"{sine} = e * c + d * s",
    ]


def compiled(text: str, threads: bool) -> Callable[..., None]:
    """The compiled function that a text defines; with ``threads`` it runs on all cores.

    Raises
    ------
    CallError : numba is not installed
    """
    try:
        import numba  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        raise CallError(
            Problem("compiled", "needs numba, which is not installed", 'pip install "graphkin[fast]"')
        ) from None
    space: dict[str, Any] = {"sqrt": math.sqrt, "floor": math.floor, "rint": np.rint, "prange": numba.prange}
    space |= {"atan2": math.atan2, "fmin": min, "fmax": max}
    exec(compile(text, "<formulas>", "exec"), space)
    made = numba.njit(error_model="numpy", parallel=threads)(space["made"])
    if not threads:
        return made  # type: ignore[no-any-return]

    def run(*given: Any) -> None:
        with _ONE_AT_A_TIME:
            made(*given)

    return run
