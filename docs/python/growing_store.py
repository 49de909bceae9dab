# %% [markdown]
# # A sweep that is read while it grows
#
# A sweep writes its cells chunk by chunk into a Zarr store, a folder. xarray opens it lazily from the first chunk on,
# from this process or from any other one, and what is not computed yet is NaN. Stopped and started again, the sweep
# goes on with what is missing.

# %%
import shutil
import threading
import time

import holdfast
import matplotlib.pyplot as plt
import numpy as np
import xarray

case = holdfast.Case(control={"proportional_gain": "tuned", "differential_gain": -13.0})
axes = {"backlash.width": (0.0, 0.003, 61), "excitation.frequency": (5.0, 15.0, 201)}
shutil.rmtree("map.zarr", ignore_errors=True)

# %% [markdown]
# ## Begin
# In a batch queue each task could run this very line with a part of its own: processes that share a folder divide its
# chunks. Here it is the first of three tasks. `client=` hands the chunks to the workers of Dask or to processes of this
# machine.

# %%
metrics = ("steady_peak", "ratio_to_uncontrolled")
case.sweep(axes, metrics, duration=40.0, chunk=201, store="map.zarr", part=(1, 3))

# %% [markdown]
# ## Read meanwhile
# The map is opened by whoever likes; only what is asked for is read.

# %%
ratio = xarray.open_zarr("map.zarr")["ratio_to_uncontrolled"]
known = float(np.isfinite(ratio).mean().compute())
assert round(known, 3) == round(21 / 61, 3)
figure, before = plt.subplots()
ratio.plot(ax=before, vmin=0.4, vmax=1.6, cmap="RdBu_r", cbar_kwargs={"label": ""})
before.set(xlabel="frequency of the force (Hz)", ylabel="play (m)", title=f"{100 * known:.0f} % of the map")
figure.savefig("map_meanwhile.png", dpi=100, bbox_inches="tight")

# %% [markdown]
# ## The rest
# Without a part, all that is missing is computed. It runs without the interpreter's lock, here in a thread.

# %%
filling = threading.Thread(
    target=lambda: case.sweep(axes, metrics, duration=40.0, chunk=201, store="map.zarr")
)
filling.start()
seen = []
while filling.is_alive():
    seen.append(holdfast.open_store("map.zarr").chunks_done)
    print(f"{seen[-1]:3d} of 61 chunks can be read")
    time.sleep(0.2)
filling.join()

store = holdfast.open_store("map.zarr")
print(store)
assert store.complete and seen == sorted(seen), "what has been computed stays"

# %% [markdown]
# ## The whole map
# At 10 Hz control leaves 54 % of the vibration with 0.5 mm of play, and is of no use from 2.8 mm on: the belt is
# hardly ever taut. In the corner of low frequency and no play the tuned P is above -184 N/m, where the loop is
# unstable with this D: below 6.4 Hz.

# %%
ratio = store.to_xarray()["ratio_to_uncontrolled"].load()
figure, after = plt.subplots()
ratio.plot(ax=after, vmin=0.4, vmax=1.6, cmap="RdBu_r", cbar_kwargs={"label": ""})
after.set(xlabel="frequency of the force (Hz)", ylabel="play (m)", title="steady amplitude over that without control")
figure.savefig("map.png", dpi=100, bbox_inches="tight")

at_10 = ratio.sel(excitation_frequency=10.0, method="nearest")
some = float(at_10.sel(backlash_width=0.0005, method="nearest"))
useless = float(at_10["backlash_width"].where(at_10 > 1.0).min())
print(f"10 Hz: {some:.3f} with 0.5 mm of play, no use from {1000 * useless:.2f} mm on")
taut = ratio.sel(backlash_width=0.0)
bad = taut["excitation_frequency"].where(taut > 1.0).max().item()
print(f"without play: harm up to {bad:.2f} Hz; P = -184 N/m is tuned to", end=" ")
print(f"{np.sqrt((case['plant.absorber_stiffness'] + 184.166) / case['plant.absorber_mass']) / (2 * np.pi):.2f} Hz")
assert 6.2 < bad < 6.4 and round(100 * some) == 54 and round(1000 * useless, 1) == 2.8

# %% [markdown]
# The same question again finds everything done; another one under the same name is refused.

# %%
begin = time.perf_counter()
assert case.sweep(axes, metrics, duration=40.0, chunk=201, store="map.zarr").complete
print(f"asked again: {time.perf_counter() - begin:.2f} s")
try:
    case.sweep(axes, metrics, duration=50.0, chunk=201, store="map.zarr")
except ValueError as refusal:
    print(refusal)
else:
    raise AssertionError("another question was not refused")
