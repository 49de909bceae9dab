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

/// The weights of the samples in a Fourier transform.
enum class SpectralWindow {
  rectangular,  ///< w_n = 1: exact amplitudes for a record of whole periods
  hann,         ///< w_n = ½ (1 − cos 2πn/N): for motions whose period does not fit the record
};

/// One line of a one-sided amplitude spectrum.
struct SpectralLine {
  double frequency;  ///< frequency (Hz)
  double amplitude;  ///< amplitude in the signal's unit; a sine of amplitude a on this line gives a
};

/// The one-sided amplitude spectrum of a real signal:
///
///     X_k = Σ w_n x_n e^{−2πikn/N},   amplitude_k = 2 |X_k| / Σ w_n
///     (factor 1 in place of 2 at zero and at the Nyquist frequency)
///
/// @param signal           samples x_n, N ≥ 2, finite
/// @param sampling_period  τ (s), > 0
/// @param window           weights w_n; `rectangular` for a record of whole periods
/// Work: N log N where N has small prime factors only, N times the largest factor otherwise.
/// @return N/2 + 1 lines at k / (N τ)
/// @throws InvalidParameter for fewer than two or more than 10⁹ samples, or τ ≤ 0
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

/// The smallest number q of samples that last a whole number p of forcing periods: f τ = p/q.
/// @return q; 0 where f τ is no fraction with q ≤ `largest`
/// @throws InvalidParameter unless f is finite and ≥ 0, τ finite and > 0
inline std::int64_t samples_per_common_period(double frequency, double sampling_period,
                                              std::int64_t largest = 1'000'000) {
  require_non_negative("frequency", frequency, "Hz");
  require_positive("sampling period tau", sampling_period, "s");
  if (!(frequency * sampling_period < 1e15)) return 0;
  const auto ratio = reconstruct_rational(frequency * sampling_period, largest);
  return ratio ? ratio->denominator : 0;
}

/// The length of the longest record, at most `available` samples, with a whole number of forcing
/// periods and of sampling periods: a rectangular window does not leak at the forcing frequency and
/// its harmonics.
/// @return `available` itself where no common period is short enough
/// @throws InvalidParameter under the conditions of samples_per_common_period()
inline std::int64_t whole_period_samples(std::int64_t available, double frequency,
                                         double sampling_period) {
  const std::int64_t common = samples_per_common_period(frequency, sampling_period);
  if (common == 0 || common > available) return available;
  return available - available % common;
}

}  // namespace holdfast
