# %% [markdown]
# # A controller for each frequency, and how slow its computer may be
#
# The wind pushes the conductor at one frequency f. P = k2 - m2 (2 pi f)^2 tunes the absorber to it; D is left to be
# chosen, and must be stable with a margin. How much vibration is left, and how long may a sample take before control
# does more harm than good?

# %%
import holdfast
import matplotlib.pyplot as plt
import numpy as np

case = holdfast.Case()

# %% [markdown]
# ## The best D
# `design` looks for the D of least steady amplitude that keeps half of its way from the boundary of stability. At 10
# Hz that is -14.2 N s/m, which leaves 29 % of the vibration, 10.6 dB less.

# %%
design = case.design((5, 20, 31))
at_10 = int(np.argmin(np.abs(design["frequency_Hz"] - 10.0)))
gain, ratio = design["least_amplitude_gain"][at_10], design["ratio_to_uncontrolled"][at_10]
print(
    f"10 Hz: P = {design['proportional_gain'][at_10]:.1f} N/m, D = {gain:.2f} N s/m leaves {ratio:.3f} of the amplitude"
)
assert round(gain, 1) == -14.2 and round(100 * ratio) == 29
assert round(design["attenuation_dB"][at_10], 1) == 10.6

m2, k2 = case["plant.absorber_mass"], case["plant.absorber_stiffness"]
np.testing.assert_allclose(design["proportional_gain"], k2 - m2 * (2 * np.pi * design["frequency_Hz"]) ** 2, rtol=1e-12)

# %% [markdown]
# The response over both gains shows where that point lies: on the way down to larger |D|, where the loop becomes
# unstable.

# %%
tuned = case.with_({"control.proportional_gain": design["proportional_gain"][at_10]})
response = case.response(p=(-1000, 200, 241), d=(-36, 8, 221))
axes = response.plot(vmin=0, vmax=1.5, cmap="viridis")
axes.plot(gain, design["proportional_gain"][at_10], "o", color="red", label="the design at 10 Hz")
axes.set_title("steady amplitude over that without control, 10 Hz")
axes.legend()
axes.figure.savefig("response_over_gains.png", dpi=100, bbox_inches="tight")

# The closed form against a motion of 200 s without play.
free = tuned.with_({"control.differential_gain": gain, "backlash.law": "none"})
end = free.simulate(200.0, from_=199.0)["z1_m"]
alone = free.simulate(200.0, from_=199.0, no_control=True)["z1_m"]
print(f"simulated: {np.ptp(end) / np.ptp(alone):.4f} of the amplitude, by the closed form {ratio:.4f}")
assert abs(np.ptp(end) / np.ptp(alone) - ratio) < 0.01

# %% [markdown]
# ## How far it is from instability
# `margins` moves one quantity at a time. With this D the sampling period may grow from 1 to 10.9 ms before the loop
# is unstable.

# %%
margins = tuned.with_({"control.differential_gain": gain}).margins()
print(margins.to_pandas().to_string())
slower = (margins["quantity"] == "sampling_period") & (margins["side"] == "above")
longest = float(margins["position"][slower][0])
print(f"stable up to a sampling period of {1000 * longest:.2f} ms")
assert round(1000 * longest, 1) == 10.9

# %% [markdown]
# ## The largest delay
# With a D chosen anew for each period there is a largest one at which control still reduces the vibration: 32.3 ms at
# 10 Hz, and the less the higher the frequency: about a third of the force's period at all of them.

# %%
delay = case.max_delay((8, 20, 25))
periods = delay["max_sampling_period_s"]
at_10 = int(np.argmin(np.abs(delay["frequency_Hz"] - 10.0)))
print(f"10 Hz: {1000 * periods[at_10]:.2f} ms, {periods[at_10] * 10:.3f} periods of the force")
assert round(1000 * periods[at_10], 1) == 32.3
shares = periods * delay["frequency_Hz"]
print(f"over all frequencies {shares.min():.3f} to {shares.max():.3f} periods of the force")

figure, axes = plt.subplots()
axes.plot(delay["frequency_Hz"], 1000 * periods, ".-")
axes.set(xlabel="frequency (Hz)", ylabel="largest sampling period (ms)", ylim=(0, None), title="at which some D helps")
figure.savefig("largest_delay.png", dpi=100, bbox_inches="tight")

# %% [markdown]
# A little faster than that some D helps, a little slower none does. Over such long samples the force counts as held
# under control, and as the true one without, which is what control is compared with: the program says so.

# %%
for period, helps in ((0.99 * periods[at_10], True), (1.01 * periods[at_10], False)):
    slow = case.with_({"control.sampling_period": period})
    over_d = slow.response(delay["proportional_gain"][at_10], (-8, 4, 2001))
    best = over_d["ratio_to_uncontrolled"][over_d["stable"]].min()
    print(f"{1000 * period:.2f} ms: the best D leaves {best:.4f}")
    assert (best < 1.0) == helps
