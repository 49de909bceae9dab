# %% [markdown]
# # Where a sampled loop is stable
#
# A cable of 6.4 m carries an absorber whose motor pushes it by u = P z1 + D dz1/dt. A computer reads z1 and dz1/dt at
# instants tau apart and holds u between them. Which gains P (N/m) and D (N s/m) keep the loop stable, and how does
# that shrink as the computer slows down? `holdfast.Case()` is the case of Kollár (2022), which this page begins with.

# %%
import holdfast
import matplotlib.pyplot as plt
import numpy as np

case = holdfast.Case(control={"sampling_period": 0.01})
print(case)

# %% [markdown]
# ## The chart
# The spectral radius is the largest modulus of a root of the loop from sample to sample; below 1 the loop is stable.
# The chart of 160 000 cells is computed by the program's own kernels. The exact boundary is another computation: the
# curves on which a root lies on the unit circle. Both must agree.

# %%
chart = case.chart(p=(-1000, 200, 400), d=(-25, 10, 400), radius=True)
axes = chart.plot(vmin=0.98, vmax=1.1, cmap="coolwarm")
curves = case.boundary(p=(-1000, 200))
for curve in np.unique(curves["curve"]):
    of = curves["curve"] == curve
    axes.plot(curves["differential_gain"][of], curves["proportional_gain"][of], "--", color="yellow", label=curve)
axes.set(xlim=(-25, 10), ylim=(-1000, 200), title="spectral radius and exact boundary, tau = 10 ms")
axes.legend(loc="lower right")
axes.figure.savefig("stability_chart.png", dpi=100, bbox_inches="tight")

# %% [markdown]
# At P = -557 N/m, which tunes the absorber to 10 Hz, D may lie between -15.5 and 3.5 N s/m. At both ends the spectral
# radius is 1.

# %%
interval = case.stable_intervals(p=-557)
lower, upper = interval.lower, interval.upper
print(f"tau = 10 ms: {lower:.2f} < D < {upper:.2f} N s/m")
assert abs(lower + 15.5) < 0.05 and abs(upper - 3.5) < 0.05
for edge in (lower, upper):
    assert abs(case.chart(-557, edge, radius=True)["spectral_radius"].item() - 1.0) < 1e-9

# %% [markdown]
# The stable region's area is known exactly as well. The share of stable cells among all of the chart comes to the
# same: 43 %.

# %%
regions = case.gain_regions(p=(-1000, 200), d=(-25, 10))
exact = regions["area"][regions["unstable_roots"] == 0].sum() / (1200 * 35)
counted = chart["stable"].mean()
print(f"stable share of the window: {exact:.4f} exactly, {counted:.4f} of the cells")
assert abs(exact - counted) < 0.005 and round(100 * exact) == 43

# %% [markdown]
# ## A slower computer
# With analogue electronics D could lie between -33.7 and 5.9 N s/m. A sample of 1 ms costs next to nothing of that,
# one of 10 ms half, and beyond 43 ms nothing is left.

# %%
fast = case.stable_intervals(p=-557, continuous=True)
print(f"continuous: {fast.lower:.1f} < D < {fast.upper:.2f} N s/m")

periods = np.concatenate([np.linspace(0.0005, 0.042, 84), np.linspace(0.042, 0.05, 33)])
lowers, uppers = np.full(periods.size, np.nan), np.full(periods.size, np.nan)
for k, period in enumerate(periods):
    try:
        found = case.with_({"control.sampling_period": period}).stable_intervals(p=-557)
    except holdfast.NoAnswer:
        continue
    lowers[k], uppers[k] = found["lower"][0], found["upper"][0]
last = periods[np.isfinite(lowers)][-1]
print(f"the last period of these with a stable D is {1000 * last:.1f} ms")
assert round(fast.lower, 1) == -33.7 and round(fast.upper, 1) == 5.9 and round(1000 * last) == 43
assert 0.4 < (upper - lower) / (fast.upper - fast.lower) < 0.55

figure, axes = plt.subplots()
axes.fill_between(1000 * periods, lowers, uppers, alpha=0.4)
axes.plot([10, 10], [lower, upper], "o-", color="black", label="the chart above")
axes.set(xlabel="sampling period (ms)", ylabel="D (N s/m)", title="stable D at P = -557 N/m")
axes.legend()
figure.savefig("stable_gain_over_period.png", dpi=100, bbox_inches="tight")

at_1_ms = case.with_({"control.sampling_period": 0.001}).stable_intervals(p=-557)
print(f"tau = 1 ms: {at_1_ms.lower:.2f} < D < {at_1_ms.upper:.2f} N s/m")
assert abs((at_1_ms.upper - at_1_ms.lower) / (fast.upper - fast.lower) - 1.0) < 0.01
