# %% [markdown]
# # A controller and a force of your own
#
# In place of P and D any rule may close the loop: it is called at each sample with what the computer reads and gives
# the force that the drive holds until the next one. The play, the sampling and the plant stay holdfast's.

# %%
import math
import time

import holdfast
import matplotlib.pyplot as plt
import numpy as np

case = holdfast.Case(backlash={"width": 0.0002})
P, D, tau = (float(case["control"][key]) for key in ("proportional_gain", "differential_gain", "sampling_period"))

# %% [markdown]
# ## A gust
# The wind comes and goes: 10 Hz in a burst of 6 s. Any function of t will do, or a pair of arrays.


# %%
def gust(t: float) -> float:
    """N"""
    return 0.5 * math.sin(math.pi * t / 6.0) ** 2 * math.cos(20.0 * math.pi * t) if t < 6.0 else 0.0


# %% [markdown]
# ## Three controllers
# The built-in law as a function, to see that it is the same; on-off damping, a force of 0.4 N against the velocity;
# and the built-in law behind a low-pass filter of 100 Hz, which has a memory.


# %%
def pd(k: int, t: float, displacement: float, velocity: float) -> float:
    return P * displacement + D * velocity


def on_off(k: int, t: float, displacement: float, velocity: float) -> float:
    return -0.4 * math.copysign(1.0, velocity)


class Filtered:
    """The force of `pd` behind a filter of first order."""

    def __init__(self, corner: float) -> None:
        self.share = 1.0 - math.exp(-2.0 * math.pi * corner * tau)
        self.force = 0.0

    def __call__(self, k: int, t: float, displacement: float, velocity: float) -> float:
        self.force += self.share * (pd(k, t, displacement, velocity) - self.force)
        return self.force


duration = 10.0
runs = {
    "no control": case.simulate(duration, no_control=True, excitation=gust),
    "P and D": case.simulate(duration, controller=pd, excitation=gust),
    "on-off, 0.4 N": case.simulate(duration, controller=on_off, excitation=gust),
    "P and D, filtered": case.simulate(duration, controller=Filtered(100.0), excitation=gust),
}
built_in = case.simulate(duration, excitation=gust)
difference = np.abs(runs["P and D"]["z1_m"] - built_in["z1_m"]).max()
print(f"pd as a function and built in: {difference:.1e} m apart")
assert difference < 1e-12

# %%
figure, axes = plt.subplots(len(runs), sharex=True, sharey=True, figsize=(7, 8))
peaks = {}
for one, (name, run) in zip(axes, runs.items()):
    one.plot(run["time_s"], 1000 * run["z1_m"], linewidth=0.6)
    one.set(title=name, ylabel="z1 (mm)")
    peaks[name] = 1000 * np.abs(run["z1_m"]).max()
    print(f"{name:18s} largest displacement {peaks[name]:.3f} mm, force {np.abs(run['control_force_N']).max():.2f} N")
axes[-1].set_xlabel("time (s)")
figure.tight_layout()
figure.savefig("three_controllers.png", dpi=100, bbox_inches="tight")

# %% [markdown]
# On-off damping does better than P and D here: 0.51 mm are left of 1.26 mm, against 0.80 mm. In the gust's flanks it
# stirs the conductor where P and D would do little. A filter of 100 Hz hardly matters.

# %%
assert round(peaks["no control"], 2) == 1.26 and round(peaks["on-off, 0.4 N"], 2) == 0.51
assert round(peaks["P and D"], 2) == 0.80 and abs(peaks["P and D, filtered"] / peaks["P and D"] - 1.0) < 0.03

# %% [markdown]
# ## What a call costs
# A function in Python costs some microseconds a sample, which is enough for minutes of motion. A compiled one costs
# tens of nanoseconds beside what the motion itself does; `numba.cfunc` makes it of the same lines.

# %%
begin = time.perf_counter()
case.simulate(60.0, controller=pd)
in_python = (time.perf_counter() - begin) / 60_000
print(f"in Python {1e6 * in_python:.1f} microseconds a sample")
try:
    import numba
except ImportError:
    print("numba is not installed")
else:
    signature = numba.types.double(numba.types.int64, numba.types.double, numba.types.double, numba.types.double)
    compiled = numba.cfunc(signature)(pd)
    begin = time.perf_counter()
    motion = case.simulate(600.0, controller=compiled)
    print(f"compiled {1e9 * (time.perf_counter() - begin) / 600_000:.0f} nanoseconds a sample, the motion counted")
