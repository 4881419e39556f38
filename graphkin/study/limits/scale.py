"""A pencil drawing at different sizes: errors of points count the less the larger they are drawn."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from graphkin.checking import predict
from graphkin.construction import EXACT, Scales, execute, plan
from graphkin.scene import read
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Tools
from graphkin.study.limits.law import Law, Trial, grid
from graphkin.words import Phrase

__all__ = ["drawing_scale"]

POINTS_ONLY = Tools(line_width=0.2, ruler=0.0, compass=0.0, set_square=0.0, protractor=0.0)


def drawing_scale(mp: Any, samples: int = 1, name: str = "slider-crank-offset") -> Trial:
    """Predicted uncertainty of the slider's velocity against the length of the crank on paper, all three figures drawn
    larger alike: errors of points and lengths fall as 1/size, those of set squares stay.

    Parameters
    ----------
    mp, samples : as for the other trials; not used, since nothing is random here
    """
    scene = read(name)
    slider = scene.links[-1]
    symbol = Symbol.parse(f"v_{next(iter(slider.points))}")
    what = plan(scene, find=(symbol,))
    crank = scene.links[0].length or scene.size
    own = crank / what.scales.length
    right = abs(_value(what, symbol))
    x = [1e3 / v for v in grid(0.3e3, 1.0, 1)]  # falling ratios turned into growing sizes, mm
    x = sorted(size for size in x if 3.0 <= size <= 1000.0)
    laws = []
    for key, tools, theory in (("pencil points", POINTS_ONLY, -1.0), ("pencil all", scene.sheet.tools, None)):
        errors = []
        for size in x:
            by = own / size
            scales = Scales(*(s * by for s in (what.scales.length, what.scales.velocity, what.scales.acceleration)))
            errors.append(predict(replace(what, scales=scales), "pencil", tools)[symbol].deviation / right)
        laws.append(Law(key, tuple(x), tuple(errors), theory, lost=1.0))
    return Trial("small scale", "crank on paper", tuple(laws), (Phrase("fate scale"),))


def _value(what: Any, symbol: Symbol) -> complex:
    sheet = execute(what, EXACT)
    vector = sheet.vectors("velocity")[symbol]
    return vector.span * sheet.scales.velocity
