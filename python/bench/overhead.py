"""What Python adds to the kernels, and what the same costs in NumPy, SciPy and python-control.

    python python/bench/overhead.py BUILD/python/bench/holdfast_python_bench

Medians of turns in which Python and C++ take part one after the other; the peers' on fewer cells and
samples, scaled to as many.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

import numpy as np

import holdfast
from holdfast._loops import sampled_plant

TURNS = 9
WARM = 8  # repetitions of each turn that do not count, and as many that do


def seconds(work) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def in_cpp(bench: str, what: str, count: int) -> float:
    done = subprocess.run([bench, what, str(count), str(2 * WARM)], capture_output=True, text=True, check=True)
    return statistics.median(float(line) for line in done.stdout.split()[WARM:])


def compare(name: str, bench: str, what: str, count: int, work) -> float:
    work()
    ours, theirs = [], []
    for _ in range(TURNS):
        ours.append(statistics.median([seconds(work) for _ in range(2 * WARM)][WARM:]))
        theirs.append(in_cpp(bench, what, count))
    python, cpp = statistics.median(ours), statistics.median(theirs)
    print(f"{name}: Python {python * 1e3:.3f} ms, C++ {cpp * 1e3:.3f} ms, ratio {python / cpp:.3f}")
    return python


def chart_in_numpy(case: holdfast.Case, count: int) -> float:
    """Eigenvalues of all closed loops at once, seconds for 10^6 cells."""
    matrix, command, _ = sampled_plant(case.plant_matrices())
    p, d = np.meshgrid(np.linspace(-1000, 200, count), np.linspace(-40, 20, count), indexing="ij")

    def work():
        rows = np.zeros((count, count, 4))
        rows[..., 0], rows[..., 1] = p, d
        closed = matrix + command[:, None] * rows[..., None, :]
        return np.abs(np.linalg.eigvals(closed)).max(axis=-1) < 1.0

    work()
    return seconds(work) * 1e6 / count**2


def chart_in_control(case: holdfast.Case, count: int) -> float | None:
    """A system of python-control for each cell, seconds for 10^6."""
    try:
        import control
    except ImportError:
        return None
    plant = case.to_control()

    def work():
        for p in np.linspace(-1000, 200, count):
            for d in np.linspace(-40, 20, count):
                closed = control.feedback(plant, control.ss([], [], [], [[p, d]], plant.dt), sign=1)
                np.abs(closed.poles()).max()

    return seconds(work) * 1e6 / count**2


def motion_in_numpy(case: holdfast.Case, samples: int) -> float:
    """The loop with play, sample by sample, seconds for 10^6."""
    matrix, command, force = sampled_plant(case.plant_matrices())

    def work():
        x, gap, before = np.zeros(4), None, 0.0
        columns = np.zeros((samples, 7))
        for k in range(samples):
            t = k * 0.001
            dz, dv = x[2] - x[0], x[3] - x[1]
            if gap is not None:
                if not gap[0] <= dz <= gap[1]:
                    gap = None
            elif before > 0.0 >= dv:
                gap = (dz - 0.0005, dz)
            elif before < 0.0 <= dv:
                gap = (dz, dz + 0.0005)
            before = dv
            u = -557.0 * x[0] - 13.0 * x[1] if gap is None else 0.0
            columns[k] = (t, *x, u, gap is not None)
            x = matrix @ x + command * u + force * (0.5 * np.cos(62.83185307179586 * t))

    return seconds(work) * 1e6 / samples


def main() -> None:
    bench = sys.argv[1]
    case = holdfast.Case()
    p, d = (-1000.0, 200.0, 1000), (-40.0, 20.0, 1000)
    chart = compare("chart, 10^6 cells", bench, "chart", 1000, lambda: case.chart(p, d))
    compare("chart with radius, 10^6 cells", bench, "radius", 1000, lambda: case.chart(p, d, radius=True))
    motion = compare("simulate, 10^6 samples", bench, "simulate", 1_000_000, lambda: case.simulate(999.999))
    print(
        f"the same motion without the digits that simulate vouches for: C++ {in_cpp(bench, 'motion', 1_000_000) * 1e3:.3f} ms"
    )
    compiled = seconds(lambda: case.simulate(999.999, switching="exact"))
    called = seconds(lambda: case.simulate(9.999, controller=lambda k, t, z, v: -557.0 * z - 13.0 * v)) * 100
    print(
        f"simulate, exact switching, 10^6 samples: {compiled * 1e3:.0f} ms; with a controller in Python {called * 1e3:.0f} ms"
    )
    print(f"a small job (orbit): {statistics.median(seconds(case.orbit) for _ in range(20)) * 1e3:.2f} ms")
    numpy_chart, numpy_motion = chart_in_numpy(case, 200), motion_in_numpy(case, 20_000)
    print(
        f"NumPy: chart {numpy_chart:.2f} s ({numpy_chart / chart:.0f} times as long), motion {numpy_motion:.2f} s ({numpy_motion / motion:.0f} times)"
    )
    control_chart = chart_in_control(case, 12)
    if control_chart is not None:
        print(f"python-control: chart {control_chart:.0f} s ({control_chart / chart:.0f} times as long)")


if __name__ == "__main__":
    main()
