#!/usr/bin/env python3
"""Eigenvalues of the loop's map of some cells of a chart of gains, by NumPy; the peer of modal_bench.

Usage: modal_chart.py [MODES [CELLS]]; prints seconds for the cells and for 121 x 121 of them.
"""
import sys
import time

import numpy as np
from scipy.linalg import expm


def string_loop(modes, period, clamp_mass=0.010):
    """Map without control, command and readings of the paper's conductor as a taut string."""
    mass, span, sag, place, damping = 0.043, 6.4, 0.29, 0.64, 0.02
    tension = mass * 9.81 * span**2 / (8 * sag)
    n = np.arange(1, modes + 1)
    omega = n * np.pi / span * np.sqrt(tension / mass)
    shape, modal = np.sin(n * np.pi * place / span), mass * span / 2
    m2, k2, c2 = 0.16, 74.4, 4.0
    size = 2 * modes + 2
    inertia = np.diag(np.full(modes + 1, modal))
    inertia[-1, -1] = m2
    inertia[:modes, :modes] += clamp_mass * np.outer(shape, shape)
    gap = np.append(-shape, 1.0)
    stiffness = np.diag(np.append(modal * omega**2, 0.0)) + k2 * np.outer(gap, gap)
    resistance = np.diag(np.append(2 * damping * omega * modal, 0.0)) + c2 * np.outer(gap, gap)
    state = np.zeros((size, size))
    state[: modes + 1, modes + 1 :] = np.eye(modes + 1)
    state[modes + 1 :, : modes + 1] = -np.linalg.solve(inertia, stiffness)
    state[modes + 1 :, modes + 1 :] = -np.linalg.solve(inertia, resistance)
    force = np.concatenate([np.zeros(modes + 1), np.linalg.solve(inertia, -gap)])
    extended = np.zeros((size + 1, size + 1))
    extended[:size, :size], extended[:size, size] = state, force
    held = expm(extended * period)
    reading = np.append(shape, np.zeros(modes + 2))
    return held[:size, :size], held[:size, size], reading, np.roll(reading, modes + 1)


def main():
    modes = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    cells = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    step, command, displacement, velocity = string_loop(modes, 0.001)
    random = np.random.default_rng(1)
    begin = time.perf_counter()
    stable = 0
    for _ in range(cells):
        gains = random.uniform(-1000, 200), random.uniform(-40, 20)
        closed = step + np.outer(command, gains[0] * displacement + gains[1] * velocity)
        stable += np.abs(np.linalg.eigvals(closed)).max() < 1
    seconds = time.perf_counter() - begin
    print(f"{modes} modes: {cells} cells {seconds:.3f} s, 121 x 121 {seconds / cells * 121**2:.1f} s, {stable} stable")


if __name__ == "__main__":
    main()
