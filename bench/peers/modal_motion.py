#!/usr/bin/env python3
"""A motion with play of the paper's conductor by its modes, sample by sample, by NumPy.

Peer of modal_bench. Usage: modal_motion.py [MODES [SAMPLES]]; prints ns a sample.
"""
import sys
import time

import numpy as np

from modal_chart import string_loop


def main():
    modes = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    samples = int(sys.argv[2]) if len(sys.argv) > 2 else 20000
    step, command, displacement, velocity = string_loop(modes, 0.001)
    gap_row, rate_row = -displacement, -velocity
    gap_row[modes], rate_row[-1] = 1.0, 1.0
    force = np.cos(2 * np.pi * 10 * 0.001 * np.arange(samples)) * 0.5
    state, inside, low, high, last = np.zeros(2 * modes + 2), False, 0.0, 0.0, 0.0
    begin = time.perf_counter()
    for j in range(samples):
        gap, rate = gap_row @ state, rate_row @ state
        if inside:
            inside = low <= gap <= high
        elif last != 0.0 and last * rate <= 0.0:
            inside, low, high = True, *((gap - 0.0005, gap) if last > 0 else (gap, gap + 0.0005))
        last = rate
        pushed = 0.0 if inside else -557.0 * (displacement @ state) - 4.0 * (velocity @ state)
        state = step @ state + command * pushed
        state[modes + 1] += 1e-3 * force[j]  # as costly as the force's own column
    seconds = time.perf_counter() - begin
    print(f"{modes} modes: {1e9 * seconds / samples:.0f} ns a sample")


if __name__ == "__main__":
    main()
