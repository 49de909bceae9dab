"""Plants that are known by measured frequency responses alone."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._options import finite_number


class FrequencyData:
    """The response of a plant's displacement to the drive's force, z/u (m/N), at measured frequencies.

    What it answers it answers for these frequencies alone. Sampling folds what lies above half the
    sampling rate onto what lies below; of that it takes what was measured, and what was not is taken as
    nothing.
    """

    def __init__(self, frequency: np.ndarray, response: np.ndarray, stable: bool) -> None:
        #: Hz, (M,), ascending
        self.frequency = frequency
        #: m/N, (M,), complex
        self.response = response
        #: whether the plant by itself is stable
        self.stable = stable

    def __repr__(self) -> str:
        return f"<holdfast.FrequencyData {self.frequency.size} frequencies, {self.frequency[0]} to {self.frequency[-1]} Hz>"

    def _continuous(self, frequency: np.ndarray) -> np.ndarray:
        """z/u, between measured frequencies by straight lines, 0 beyond the last one."""
        size = np.abs(frequency)
        real = np.interp(size, self.frequency, self.response.real, right=0.0)
        imaginary = np.interp(size, self.frequency, self.response.imag, right=0.0)
        return real + 1j * np.sign(frequency) * imaginary

    def loop(
        self, p: float, d: float, *, sampling_period: float, processing_delay: float = 0.0
    ) -> tuple[np.ndarray, np.ndarray]:
        """L = P Gz + D Gv of the sampled loop u = P z + D v, G being the plant under a zero-order hold:

            G(e^{i w tau}) = sum over k of H(w + 2 pi k/tau),   H(w) = z/u (1 - e^{-i w tau})/(i w tau) e^{-i w delta}

        :param p: P, N/m
        :param d: D, N s/m
        :param sampling_period: tau, s
        :param processing_delay: delta, s
        :return: the measured frequencies below half the sampling rate, Hz, and L there
        """
        p, d = finite_number(p, "p"), finite_number(d, "d")
        period = finite_number(sampling_period, "sampling_period")
        delay = finite_number(processing_delay, "processing_delay")
        if not period > 0.0 or delay < 0.0:
            raise ValueError(f"sampling_period = {period}, processing_delay = {delay} s: admissible is > 0 and >= 0")
        below = self.frequency[self.frequency < 0.5 / period]
        if below.size < 2:
            raise ValueError(
                f"sampling_period = {period} s: fewer than two measured frequencies lie below half of its rate"
            )
        folds = int(np.ceil(self.frequency[-1] * period)) + 1
        loop = np.zeros(below.size, dtype=complex)
        for k in range(-folds, folds + 1):
            there = below + k / period
            s = 2j * np.pi * there
            hold = (1.0 - np.exp(-s * period)) / (s * period) * np.exp(-s * delay)
            loop += (p + d * s) * self._continuous(there) * hold
        return below, loop

    def margins(self, p: float, d: float, *, sampling_period: float, processing_delay: float = 0.0) -> dict[str, Any]:
        """Margins of 1 - L at the measured frequencies.

        ``modulus``: the least distance ``|1 - L|``, and its ``frequency_Hz``; ``gain_dB``: by how much both
        gains may grow, where L crosses the real axis beyond 0 (inf: nowhere); ``phase_degrees`` where
        ``|L| = 1`` (inf: nowhere); ``stable``: by Nyquist's criterion, None where the measured points are too
        far apart for it: L turns by more than a quarter about 1 between two of them, or is not small at the
        last one.

        :raises ValueError: as :meth:`loop`
        """
        frequency, loop = self.loop(p, d, sampling_period=sampling_period, processing_delay=processing_delay)
        away = 1.0 - loop
        nearest = int(np.argmin(np.abs(away)))
        return {
            "modulus": float(np.abs(away[nearest])),
            "frequency_Hz": float(frequency[nearest]),
            "gain_dB": _gain_margin(loop),
            "phase_degrees": _phase_margin(loop),
            "stable": self._is_stable(away),
        }

    def _is_stable(self, away: np.ndarray) -> Optional[bool]:
        if not self.stable:
            return None
        # Below the first measured frequency the response is taken to go on to its static, real value.
        path = np.concatenate([[complex(away[0].real, 0.0)], away, [complex(away[-1].real, 0.0)]])
        turns = np.angle(path[1:] / path[:-1])
        if np.any(np.abs(turns) > 0.5 * np.pi) or np.any(path == 0):
            return None
        return bool(abs(np.sum(turns)) < 1e-6)


def frequency_response(frequency: Any, response: Any, *, stable: bool = True) -> FrequencyData:
    """A plant by its measured frequency response.

    :param frequency: Hz, (M,), ascending, > 0
    :param response: displacement over force, m/N, (M,), complex
    :param stable: whether the plant by itself is stable; else nothing is said of the loop's stability
    """
    try:
        f = np.array(frequency, dtype=float)
        h = np.array(response, dtype=complex)
    except (TypeError, ValueError):
        raise ValueError("frequency and response: admissible are numbers") from None
    if f.ndim != 1 or f.size < 2 or h.shape != f.shape:
        raise ValueError(
            f"frequency has the shape {f.shape} and response {h.shape}; admissible: one dimension, the same, two or more"
        )
    if not (np.all(np.isfinite(f)) and np.all(np.isfinite(h))):
        raise ValueError("frequency and response: admissible are finite numbers")
    if not f[0] > 0.0 or not np.all(np.diff(f) > 0.0):
        raise ValueError("frequency: admissible are ascending values above 0 Hz")
    return FrequencyData(f, h, bool(stable))


def _crossings(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where a row changes its sign: the index before, and the share of the way to the next."""
    before = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0)
    return before, values[before] / (values[before] - values[before + 1])


def _gain_margin(loop: np.ndarray) -> float:
    k, share = _crossings(loop.imag)
    real = loop.real[k] + share * (loop.real[k + 1] - loop.real[k])
    factors = 1.0 / real[(real > 0.0) & (real < 1.0)]
    return float(20.0 * np.log10(factors.min())) if factors.size else float("inf")


def _phase_margin(loop: np.ndarray) -> float:
    k, share = _crossings(np.abs(loop) - 1.0)
    there = loop[k] + share * (loop[k + 1] - loop[k])
    return float(np.degrees(np.abs(np.angle(there)).min())) if there.size else float("inf")
