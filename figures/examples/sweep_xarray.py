# %% [markdown]
# # Five cranks over a turn, as a data set of xarray
#
# `graphkin.sweep` over designs gives one table; xarray asks it by names and units instead of columns.

# %%
import graphkin

designs = {"links.2.length": "80:100:5"}  # mm
swept = graphkin.sweep("shaper-scheme-2", positions=360, find=["v_C"], designs=designs)
turns = swept.to_xarray()

print(turns)

# %% [markdown]
# The ram's greatest speed on its way back, for each crank.

# %%
fastest = abs(turns["v_C.x"]).max("position")
for crank, speed in zip(turns["links.2.length"].values, fastest.values, strict=True):
    print(f"crank {crank:g} mm: {speed:.1f} {turns['v_C.x'].attrs['units']}")

# %%
from matplotlib.figure import Figure  # noqa: E402

by_angle = turns["v_C.x"].assign_coords({"crank angle (deg)": ("position", turns["driver_2"].values[0])})
picture = Figure(figsize=(6, 3.5), layout="constrained")
by_angle.plot.line(x="crank angle (deg)", hue="links.2.length", ax=picture.subplots())
