# %% [markdown]
# # A plant of order 12 from python-control
#
# Six masses on a taut wire of 1.4 m between two walls, a plant that no case file describes. A drive at the second
# mass pushes against the ground, the displacement of that mass is read, and a force shakes the fifth one.
# `holdfast.plant` takes it as a system of python-control.

# %%
import control
import holdfast
import matplotlib.pyplot as plt
import numpy as np

masses, mass, tension, distance, damping = 6, 0.05, 40.0, 0.2, 0.02  # kg, N, m, N s/m
stiffness = tension / distance * (2 * np.eye(masses) - np.eye(masses, k=1) - np.eye(masses, k=-1))  # N/m
A = np.block([[np.zeros((masses, masses)), np.eye(masses)], [-stiffness / mass, -damping / mass * np.eye(masses)]])
B = np.zeros((2 * masses, 2))
B[masses + 1, 0] = 1 / mass  # the command u, N
B[masses + 4, 1] = 1 / mass  # the force F, N
C = np.zeros((1, 2 * masses))
C[0, 1] = 1.0  # the displacement that is read, m
plant = holdfast.plant(control.ss(A, B, C, 0))

frequencies = np.sort(np.abs(plant.eigenvalues().imag))[::2] / (2 * np.pi)
print("natural frequencies (Hz):", np.round(frequencies, 2))
exact = 2 * np.sqrt(tension / distance / mass) * np.sin(np.pi * np.arange(1, 7) / 14) / (2 * np.pi)
np.testing.assert_allclose(frequencies, exact, rtol=1e-4)

# %% [markdown]
# ## A loop on it
# P and D at 500 Hz, with 0.7 ms from the sample to the force. The chart is compared with the eigenvalues of the
# loop's own matrix as `to_control` gives it.

# %%
case = plant.case(
    control={
        "proportional_gain": -100.0,
        "differential_gain": -4.0,
        "sampling_period": 0.002,
        "processing_delay": 0.0007,
    },
    backlash={"width": 0.0002},
    excitation={"amplitude": 0.1, "frequency": 4.5},
)
chart = case.chart(p=(-1500, 500, 201), d=(-60, 20, 161), radius=True)
axes = chart.plot(vmin=0.995, vmax=1.005, cmap="coolwarm")
axes.set_title("spectral radius of a loop of order 12")
axes.figure.savefig("chart_of_order_12.png", dpi=100, bbox_inches="tight")

worst = 0.0
for i, j in np.random.default_rng(1).integers(0, (201, 161), (50, 2)):
    gains = {"proportional_gain": chart["proportional_gain"][i], "differential_gain": chart["differential_gain"][j]}
    roots = np.linalg.eigvals(case.with_(control=gains).to_control(closed=True).A)
    worst = max(worst, abs(np.abs(roots).max() - chart["spectral_radius"][i, j]))
print(f"50 cells against NumPy's eigenvalues: {worst:.1e} apart at most")
assert worst < 1e-9

# %% [markdown]
# ## Margins
# How far each quantity may go alone; with the sampling period the delay grows in proportion. At each of these ends
# the spectral radius of the loop in python-control is 1.

# %%
margins = case.margins()
print(margins.to_pandas()[["quantity", "value", "side", "outcome", "position", "frequency_Hz"]].to_string())
ends = 0
for quantity, outcome, position in zip(margins["quantity"], margins["outcome"], margins["position"]):
    if outcome == "boundary":
        moved = {quantity: position}
        if quantity == "sampling_period":
            moved["processing_delay"] = 0.35 * position
        roots = np.linalg.eigvals(case.with_(control=moved).to_control(closed=True).A)
        assert abs(np.abs(roots).max() - 1.0) < 1e-9, quantity
        ends += 1
print(f"{ends} ends of stability confirmed")
assert ends == 6

# %% [markdown]
# ## Motion with play
# Shaken near its first natural frequency with 0.1 N, with a play of 0.2 mm in the drive.

# %%
motion = case.simulate(20.0)
alone = case.simulate(20.0, no_control=True)
figure, axes = plt.subplots()
axes.plot(alone["time_s"], 1000 * alone["z1_m"], color="gray", label="without control")
axes.plot(motion["time_s"], 1000 * motion["z1_m"], label="with control and play")
axes.set(xlabel="time (s)", ylabel="displacement (mm)", title="the second mass, shaken at 4.5 Hz")
axes.legend(loc="upper left")
figure.savefig("motion_of_order_12.png", dpi=100, bbox_inches="tight")
late = motion["time_s"] > 15.0
left = np.abs(motion["z1_m"][late]).max() / np.abs(alone["z1_m"][late]).max()
print(f"after 15 s control leaves {100 * left:.0f} % of the vibration")
assert left < 0.1

# %% [markdown]
# Its verdicts are certified as those of any other plant: at 5 Hz the motion repeats itself after four periods of the
# force, 400 samples of 2 ms.

# %%
verdict = case.with_({"excitation.frequency": 5.0}).verdict()
print(verdict.verdict, "-", verdict.rests_on)
assert verdict.verdict == "periodic(400)" and verdict.certified == 1
