"""Sampled loops as systems of python-control."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def held(a: np.ndarray, b: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
    """e^{A t} and its integral times b, by one exponential."""
    from scipy.linalg import expm

    n = a.shape[0]
    block = np.zeros((n + 1, n + 1))
    block[:n, :n], block[:n, n] = a * time, b * time
    exponential = expm(block)
    return exponential[:n, :n], exponential[:n, n]


def sampled_plant(arrays: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """[x; commands on their way] from sample to sample: its matrix, what the command u_j adds and what the
    held force F_j adds."""
    a, b, c = arrays["state_matrix"], arrays["command_input"], arrays["excitation_input"]
    period, delay = arrays["sampling_period"], arrays["processing_delay"]
    late_samples = max(1, math.ceil(delay / period - 1e-12))
    late = min(max(delay - (late_samples - 1) * period, 0.0), period)
    n = a.shape[0]
    over_period, of_force = held(a, c, period)
    over_rest, of_new = held(a, b, period - late)
    of_old = over_rest @ held(a, b, late)[1]
    past = late_samples if late > 0.0 else late_samples - 1
    matrix, command, force = np.zeros((n + past, n + past)), np.zeros(n + past), np.zeros(n + past)
    matrix[:n, :n], force[:n] = over_period, of_force

    def add(effect: np.ndarray, samples_ago: int) -> None:
        if samples_ago == 0:
            command[:n] += effect
        else:
            matrix[:n, n + samples_ago - 1] += effect

    add(of_new, late_samples - 1)
    if late > 0.0:
        add(of_old, late_samples)
    if past:
        command[n] = 1.0
        for k in range(1, past):
            matrix[n + k, n + k - 1] = 1.0
    return matrix, command, force


def control_of(arrays: Mapping[str, Any], closed: bool) -> Any:
    """As ``Case.to_control``."""
    import control

    matrix, command, force = sampled_plant(arrays)
    past = np.zeros(matrix.shape[0] - arrays["state_matrix"].shape[0])
    read = [np.concatenate([arrays[f"measured_{name}"], past]) for name in ("displacement", "velocity")]
    period = arrays["sampling_period"]
    if not closed:
        return control.ss(
            matrix, command[:, None], np.vstack(read), np.zeros((2, 1)), period,
            inputs=["u"], outputs=["displacement", "velocity"],
        )  # fmt: skip
    gains = arrays["proportional_gain"] * read[0] + arrays["differential_gain"] * read[1]
    seen = [np.concatenate([arrays[name], past]) for name in ("displacement", "velocity")]
    return control.ss(
        matrix + np.outer(command, gains), force[:, None], np.vstack(seen), np.zeros((2, 1)), period,
        inputs=["F"], outputs=["displacement", "velocity"],
    )  # fmt: skip
