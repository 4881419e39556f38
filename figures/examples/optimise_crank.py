# %% [markdown]
# # A crank length for a wanted stroke
#
# A shaper's ram is to move 320 mm; its crank is 90 mm long and gives 298.3 mm. Which crank gives the wanted stroke?

# %%
import numpy as np

import graphkin

WANTED = 320.0  # mm

shaper = graphkin.read("shaper-scheme-2")
ram = graphkin.prepare(shaper, find=["s_6/1"])  # the travel of ram 6 along its guide in frame 1

# %% [markdown]
# `over` changes numbers of the scene without reading it again: thirteen cranks, each over a turn, are one array.

# %%
cranks = np.linspace(60, 120, 13)
travel = ram.over({"links.2.length": cranks}).sweep(720)["s_6/1"]
strokes = travel.max(axis=1) - travel.min(axis=1)

# %% [markdown]
# The stroke grows with the crank, so the answer lies between two neighbours. A sweep misses the dead positions by part
# of a step, the study of a turn does not: it gives the last digits.


# %%
def stroke_of(crank: float) -> float:
    study = graphkin.sweep(shaper.replace("links.2.length", crank), positions=1).data
    return next(output["stroke"] for output in study["outputs"] if output.get("slide") == "6/1")


low, high = np.interp([WANTED - 2, WANTED + 2], strokes, cranks)
for _ in range(4):  # the secant through two cranks
    slope = (stroke_of(high) - stroke_of(low)) / (high - low)
    low, high = high, high + (WANTED - stroke_of(high)) / slope
    if abs(high - low) < 1e-9:
        break
crank = float(high)
print(f"crank {crank:.4f} mm, stroke {stroke_of(crank):.4f} mm")

# %%
picture = graphkin.draw(shaper.replace("links.2.length", crank)).figures["mechanism"]
