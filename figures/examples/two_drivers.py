# %% [markdown]
# # The class of a mechanism depends on what drives it
#
# A six-bar whose dyad hangs on a coupler point: driven by its crank it is two dyads, each solved by two circles. Driven
# by its last link, the four other links move together, a group of class III: no two circles find any of their points.

# %%
import math

import graphkin

by_crank = graphkin.read("sixbar-coupler-1A")
solved = graphkin.solve(by_crank).data
now = solved["positions"][0]

# %% [markdown]
# The last link drives it in the way it was found to move. A larger group may have many assemblies; the sketch, the
# places where the points were found, says which one is meant.

# %%
last = now["links"]["6"]
by_last = by_crank.replace("driver", {"link": "6", "angle": math.degrees(last["angle"]),
                                      "omega": last["omega"], "alpha": last["alpha"]})
by_last = by_last.replace("sketch", {p: now["points"][q]["position"] for p, q in
                                     {"B": "B@1", "C": "C@2", "E": "E@2"}.items()})
driven = graphkin.solve(by_last).data

# %%
classes = {name: [(group["class"], group["links"]) for group in data["groups"]]
           for name, data in (("crank", solved), ("last link", driven))}
print(classes)
crank_rate = driven["positions"][0]["links"]["1"]["omega"]
print(f"the crank turns as before: {crank_rate:.6f} rad/s")

# %%
picture = graphkin.draw(by_last).figures["mechanism"]
