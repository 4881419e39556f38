# %% [markdown]
# # The same polygon in four countries
#
# Letters differ: the pole is p, O or o, the velocity of C relative to B is v_CB, V_C/B or cb. What is measured is the
# same.

# %%
import graphkin

CONVENTIONS = ("chinese", "us", "british", "russian")

drawn = {convention: graphkin.draw("slider-crank-offset", convention=convention) for convention in CONVENTIONS}

# %% [markdown]
# The readings on paper, in mm, are the same four times.

# %%
readings = {convention: result.checked["v_C"].on_paper for convention, result in drawn.items()}
for convention, on_paper in readings.items():
    print(f"{convention:8} {on_paper:.2f} mm")

# %%
picture = drawn["british"].figures["velocity"]
