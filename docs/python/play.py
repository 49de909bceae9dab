# %% [markdown]
# # Play in the drive
#
# The belt between motor and absorber has a play of 0.5 mm. Where it is not taut no force gets through, so that the
# loop is a linear one that is switched on and off by its own motion. What does it do, and can that be proven rather
# than watched?

# %%
import holdfast
import matplotlib.pyplot as plt
import numpy as np

case = holdfast.Case()
assert case["backlash.width"] == 0.0005

# %% [markdown]
# ## The motion
# From rest, under a force of 0.5 N at 10 Hz: the conductor comes to a steady vibration of 0.68 mm, where it would
# have 1.26 mm without control.

# %%
motion = case.simulate(10.0)
alone = case.simulate(10.0, no_control=True)
steady = motion["time_s"] > 8.0
peak, peak_alone = (np.abs(run["z1_m"][steady]).max() for run in (motion, alone))
print(f"steady peak {1000 * peak:.3f} mm, without control {1000 * peak_alone:.3f} mm")
assert round(1000 * peak, 2) == 0.68 and round(1000 * peak_alone, 2) == 1.26

figure, (over_time, plane) = plt.subplots(1, 2, figsize=(11, 4))
motion.plot(over_time, linewidth=0.8)
over_time.set_title("the conductor from rest")
motion.plot(plane, kind="phase")

# %% [markdown]
# ## The orbit and its certificate
# `orbit` finds the periodic motion itself: a state that one period of the switched loop brings back. It closes to
# rounding, 42 % of its samples push, and its largest multiplier says that a small disturbance is 0.913 times as large
# after each period. The orbit is not assumed to switch as it does: its own samples are checked, and how far they stay
# from switching otherwise is told.

# %%
orbit = case.orbit()
print(orbit)
assert orbit.period_samples == 100 and abs(orbit.period_s - 0.1) < 1e-12
assert round(orbit.largest_multiplier, 3) == 0.913 and orbit.closure_error < 1e-15
assert round(100 * orbit.engaged_fraction) == 42

trace = case.orbit(trace=True)
plane.plot(trace["z1_m"], trace["v1_m_per_s"], color="red", linewidth=2, label="the orbit")
plane.set_title("the same in the phase plane")
plane.legend(loc="upper right")
figure.savefig("motion_and_orbit.png", dpi=100, bbox_inches="tight")

certificate = case.orbit(certificate=True)
print(certificate.to_pandas().to_string())

# The motion gets there by itself: 60 s later they differ by rounding alone.
late = case.simulate(60.1, from_=60.0)["z1_m"][:100]
apart = min(np.abs(np.roll(trace["z1_m"][:100], shift) - late).max() for shift in range(100))
print(f"after 60 s the motion is {apart:.1e} m from the orbit")
assert apart < 1e-12

# %% [markdown]
# ## A verdict
# `verdict` says in a word what a motion is and what that rests on. With D = -90 N s/m, far beyond the stable gains,
# the play keeps the motion bounded for as long as it was followed, and it is chaotic: neighbours part by a factor e
# in 1.4 s. A section of it comes with the warning that from some instant on rounding decides the digits: its points
# are those of a motion nearby.

# %%
verdict = case.verdict()
print(verdict.verdict, "-", verdict.rests_on)
assert verdict.verdict == "periodic(100)" and verdict.certified == 1

wild = case.with_({"control.differential_gain": -90.0})
verdict = wild.verdict()
print(verdict.verdict, "-", verdict.rests_on)
assert verdict.verdict == "chaotic"
exponents = wild.lyapunov(duration=500.0)
print(f"largest exponent {exponents['per_second'][0]:.3f} 1/s: e-fold in {1 / exponents['per_second'][0]:.2f} s")
assert round(1 / exponents["per_second"][0], 1) == 1.4

# %%
figure, (orbits, poincare) = plt.subplots(1, 2, figsize=(11, 4))
diagram = case.diagram("backlash.width", (0.0, 0.003, 301), transient=20.0, strobes=40)
diagram.plot(orbits)
orbits.set(xlabel="play (m)", title="one point a forcing period")
wild.section(400.0, from_=20.0).plot(poincare)
poincare.set_title("chaos at D = -90 N s/m: where z2 - z1 turns")
figure.tight_layout()
figure.savefig("diagram_and_section.png", dpi=100, bbox_inches="tight")
