#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The window function of a Fourier transform: weights w_n of the samples n = 0 … N − 1.
enum class SpectralWindow {
  rectangular,  ///< w_n = 1: exact amplitudes if the record is a whole number of periods
  hann,         ///< w_n = ½ (1 − cos 2πn/N): less leakage if the record is not whole periods
};

/// One line of a one-sided amplitude spectrum.
struct SpectralLine {
  double frequency;  ///< frequency (Hz)
  double amplitude;  ///< amplitude a, in the signal's unit, of the component a sin(2π f t + φ)
};

/// The one-sided amplitude spectrum of a real signal:
///
///     X_k = Σ w_n x_n e^{−2πikn/N},   amplitude_k = 2 |X_k| / Σ w_n
///     (factor 1 in place of 2 at frequency 0 and at the Nyquist frequency)
///
/// @param signal           samples x_n, N ≥ 2, finite
/// @param sampling_period  sampling period τ (s), > 0
/// @param window           window function, which defines the weights w_n
/// Work: N log N if N has only small prime factors, else N times its largest prime factor.
/// @return lines at the frequencies k/(N τ), k = 0 … N/2 (rounded down)
/// @throws InvalidParameter for fewer than 2 samples or more than 10⁹, or unless τ > 0
template <class Scalar = double>
std::vector<SpectralLine> amplitude_spectrum(std::vector<Scalar> signal, double sampling_period,
                                             SpectralWindow window) {
  require_positive("sampling period tau", sampling_period, "s");
  const std::size_t size = signal.size();
  require_within("number of samples", static_cast<double>(size), "", 2.0, 1e9);
  double weight_sum = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const double phase = 2.0 * pi<double> * static_cast<double>(n) / static_cast<double>(size);
    const double weight = window == SpectralWindow::hann ? 0.5 * (1.0 - std::cos(phase)) : 1.0;
    signal[n] *= weight;
    weight_sum += weight;
  }
  std::vector<std::complex<Scalar>> transform;
  Eigen::FFT<Scalar> fft;
  fft.fwd(transform, signal);

  std::vector<SpectralLine> lines(size / 2 + 1);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool counted_once = k == 0 || 2 * k == size;
    lines[k].frequency = static_cast<double>(k) / (static_cast<double>(size) * sampling_period);
    lines[k].amplitude = (counted_once ? 1.0 : 2.0) * std::abs(transform[k]) / weight_sum;
  }
  return lines;
}

/// The number q of samples after which a signal of frequency f (Hz), sampled with period τ (s),
/// repeats: f τ = p/q in lowest terms. @return q; 0 if there is no such q ≤ `largest`
/// @throws InvalidParameter unless f is finite and ≥ 0, τ finite and > 0
inline std::int64_t samples_per_common_period(double frequency, double sampling_period,
                                              std::int64_t largest = 1'000'000) {
  require_non_negative("frequency", frequency, "Hz");
  require_positive("sampling period tau", sampling_period, "s");
  if (!(frequency * sampling_period < 1e15)) return 0;
  const auto ratio = reconstruct_rational(frequency * sampling_period, largest);
  return ratio ? ratio->denominator : 0;
}

/// The length in samples, at most `available`, of the longest record of whole periods of a force.
/// `frequency` is that of the force (Hz), `sampling_period` in s. With a rectangular window such a
/// record has no leakage from the force and its harmonics. @return length, or else `available`
/// @throws InvalidParameter under the conditions of samples_per_common_period()
inline std::int64_t whole_period_samples(std::int64_t available, double frequency,
                                         double sampling_period) {
  const std::int64_t common = samples_per_common_period(frequency, sampling_period);
  if (common == 0 || common > available) return available;
  return available - available % common;
}

}  // namespace holdfast
