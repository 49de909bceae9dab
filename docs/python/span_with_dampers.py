# %% [markdown]
# # A line of 300 m with its dampers
#
# One ACSR "Drake" conductor at a fifth of its strength, a Stockbridge damper 1 m from each support, and the wind of
# an open site. What do the dampers do, where do they do nothing, and how long does the conductor live?

# %%
import holdfast
import matplotlib.pyplot as plt
import numpy as np

print(holdfast.conductors("Drake").to_pandas().to_string())

# %% [markdown]
# A Stockbridge damper has a weight on each end of its messenger cable, each with two resonances: two devices at one
# place, the first of which has the clamp. Where the wind is asked for, the conductor's own damping follows from laws
# of measured self-damping.

# %%
weights = [
    {"mass": 0.93943, "frequencies": [11.26, 38.111], "mass_share": 0.77019, "clamp_mass": 0.42972},
    {"mass": 0.81997, "frequencies": [18.335, 66.25], "mass_share": 0.75761},
]
dampers = [
    {"kind": "stockbridge", "position": position, "damping_ratios": [0.0667, 0.0667], **weight}
    for position in (1.0, 299.0)
    for weight in weights
]
line = holdfast.Case(
    conductor={"name": "Drake", "span": 300.0, "tension": 28020.0, "damping_ratio": 0.0002},
    plant={"model": "string", "absorber_mass": 0.0},  # no absorber: the dampers alone
    control={"proportional_gain": 0.0, "differential_gain": 0.0},
    site={"weibull_scale": 5.0, "weibull_shape": 2.0, "years": 40.0},
    device=dampers,
)
speed = np.sqrt(28020.0 / 1.628)
print(f"waves run at {speed:.1f} m/s; a half-wave at 40 Hz is {speed / 80:.2f} m")
assert round(speed, 1) == 131.2

# %% [markdown]
# ## Waves at the end
# At 40 Hz the damper takes 96 % of a wave's power. Near 65 Hz half a wave fits between support and damper: the damper
# sits in a node and takes nothing.

# %%
absorption = line.absorption((5, 80, 751), end="left")
share = absorption["absorbed_fraction"]
at = {f: float(np.interp(f, absorption["frequency_Hz"], share)) for f in (10.0, 20.0, 40.0)}
least = absorption["frequency_Hz"][40:][np.argmin(share[40:])]
print(
    {f"{f:g} Hz": f"{100 * s:.0f} %" for f, s in at.items()},
    f"least at {least:.1f} Hz, half-wave {speed / 2 / least:.2f} m",
)
assert round(100 * at[40.0]) == 96 and abs(speed / 2 / least - 1.0) < 0.05

# %% [markdown]
# ## In the wind
# Two laws of the wind's power and three of self-damping: their band is the answer. 75 microstrain from zero to peak
# at the clamp are the customary limit. From 10 Hz on the dampers keep the strain below it by all laws; below 9 Hz
# they are too stiff to do anything. Where the band is a line the amplitude is below a hundredth of the diameter, for
# which no wind was measured.

# %%
wind = line.aeolian((4, 80, 153))
figure, (top, bottom) = plt.subplots(2, sharex=True, figsize=(7, 7))
top.plot(absorption["frequency_Hz"], share)
top.set(ylabel="absorbed share of a wave's power", ylim=(0, 1))
frequency = np.unique(wind["frequency_Hz"])


def band(column: str) -> tuple[np.ndarray, np.ndarray]:
    values = [1e6 * wind[column][wind["frequency_Hz"] == f] for f in frequency]
    return np.array([v.min() for v in values]), np.array([v.max() for v in values])


for column, color, label in (("strain_bare", "gray", "without dampers"), ("strain", "tab:blue", "with dampers")):
    bottom.fill_between(frequency, *band(column), color=color, alpha=0.5, label=label)
bottom.axhline(75.0, color="black", linestyle="--", label="customary limit")
bottom.set(xlabel="frequency (Hz)", ylabel="strain at the clamp (1e-6)", yscale="log")
bottom.legend()
figure.tight_layout()
figure.savefig("line_in_the_wind.png", dpi=100, bbox_inches="tight")

above = frequency[band("strain")[1] > 75.0]
assert above.max() < 9.5
print(
    "above the limit by some law:",
    above.min(),
    "to",
    above.max(),
    "Hz,",
    above.size,
    "of",
    frequency.size,
    "frequencies",
)

# %% [markdown]
# ## Damping of the modes
# The roots of the string with its devices, all modes at once.

# %%
modes = line.modal_damping(count=350)
figure, axes = plt.subplots()
axes.semilogy(modes["frequency_Hz"], modes["damping_ratio"], ".", label="with dampers")
axes.semilogy(modes["frequency_Hz"], modes["damping_ratio_bare"], "-", label="without")
axes.set(xlabel="frequency (Hz)", ylabel="damping ratio")
axes.legend()
figure.savefig("damping_of_modes.png", dpi=100, bbox_inches="tight")

# %% [markdown]
# ## Life
# Miner's sum over the wind of a year. Without turbulence of the site the laws are those of laminar flow, so that
# lives are short; what counts is the comparison: dampers make it five to six times as long.

# %%
life = line.fatigue()
print(life.to_pandas().to_string())
longer = life.value("life") / life.value("life_bare")
print(
    f"life {life.value('life_bare'):.2f} years without, {life.value('life'):.2f} years with dampers: {longer:.1f} times"
)
assert 5.0 < longer < 6.0
