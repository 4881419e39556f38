# %% [markdown]
# # The path of a coupler point
#
# A point of the coupler runs along a curve of the sixth order. Beside it the two centrodes: the coupler moves as if the
# one rolled on the other.

# %%
import numpy as np

import graphkin

# %% [markdown]
# The curve as an array of complex numbers, in the scene's millimetres.

# %%
turn = graphkin.prepare("four-bar-coupler-point", find=["P"]).sweep(720)
path = turn["P"]
closed = np.append(path, path[0])
print(f"{abs(np.diff(closed)).sum():.1f} mm long, {np.ptp(path.real):.1f} mm wide, {np.ptp(path.imag):.1f} mm high")

# %%
picture = graphkin.centrodes("four-bar-coupler-point", link="2", point="P").figure
