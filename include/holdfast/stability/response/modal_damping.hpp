#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/response/absorber_impedance.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

/// Damping of a mode n of the conductor, without and with the controlled absorber.
struct ModeDamping {
  double angular_frequency;   ///< angular frequency ω_n (rad/s) of the bare conductor's mode
  double bare;                ///< damping ratio ζ_n without absorber
  std::complex<double> root;  ///< the loop's root s = ln λ/τ (1/s) for the mode; NaN: not found
  double first_order;         ///< first-order estimate, for a light absorber, of `damping`

  /// The damping ratio −Re s/|s| with the absorber; < 0 where the mode grows, NaN without a root.
  double damping() const { return -root.real() / std::abs(root); }
};

namespace detail {

/// The eigenvalue s (1/s) nearest to a given s, from the increments e^{sτ} − 1 of all eigenvalues.
/// @return NaN where no increment is within 10⁻⁶ of e^{sτ} − 1 for the given s
inline std::complex<double> matched_pole(const std::vector<std::complex<double>>& increments,
                                         const std::complex<double>& s, double period) {
  const std::complex<double> mu = complex_expm1(s * period);
  std::complex<double> nearest(std::numeric_limits<double>::infinity(), 0.0);
  for (const std::complex<double>& increment : increments)
    if (std::abs(increment - mu) < std::abs(nearest)) nearest = increment - mu;
  if (!(std::abs(nearest) < 1e-6)) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  return s + nearest / ((1.0 + mu) * period);
}

}  // namespace detail

/// The damping of each mode of a conductor with the controlled absorber. Each bare mode n is traced
/// to a root λ of the sampled loop while first the absorber and then the gains grow from zero. The
/// trace determines the branch of s = ln λ/τ. To first order the damping ratio is ζ_n + φ_n² Re
/// Z(iω_n)/(2 M_n ω_n), with the symbols of `PlaceMode` and Z of `absorber_impedance`.
///
/// The result is not proved. Where two traces meet, the assignment of roots to the two modes is
/// arbitrary. Where the steps of a trace become too small, `damping` is NaN. Work: some hundred
/// values of the transfer functions per mode.
/// @param modes     modes of the bare conductor at the absorber's place
/// @param absorber  absorber with its clamp
/// @param sampling  τ (s) and δ (s)
/// @param gains     P (N/m) and D (N s/m); both 0: without control
/// @param hardware  measurement filter and drive
/// @throws InvalidParameter where modes, absorber, sampling or hardware are not admissible
template <class Scalar = double>
std::vector<ModeDamping> modal_damping(
    const std::vector<PlaceMode<detail::Undeduced<Scalar>>>& modes,
    const Absorber<detail::Undeduced<Scalar>>& absorber,
    const Sampling<detail::Undeduced<Scalar>>& sampling,
    const PdGains<detail::Undeduced<Scalar>>& gains, const LoopHardware& hardware = {}) {
  using Complex = std::complex<double>;
  const auto poles = plant_poles(modes, absorber);
  const ModalResponse<Scalar> response =
      modal_response<Scalar>(ConductorWithAbsorber{modes, absorber, poles, hardware}, sampling);
  const auto of_gains = [&](const Complex& s) {
    const auto g = response.at_distance_from_one(complex_expm1(s * sampling.period));
    return gains.proportional * g.displacement + gains.differential * g.velocity;
  };
  const bool controlled = gains.proportional != 0.0 || gains.differential != 0.0;
  using Finder = detail::PoleFinder;
  const Finder finder(modes, absorber);
  const auto eigenvalues = response.pole_increments();
  std::vector<ModeDamping> found;
  found.reserve(modes.size());
  for (std::size_t n = 0; n < modes.size(); ++n) {
    Complex root = finder.of_mode(n, Finder::bare(modes[n])).s;
    // Where not all poles were found those of the response are the plant's eigenvalues.
    if (poles.empty()) root = detail::matched_pole(eigenvalues, root, sampling.period);
    if (controlled) root = root_from_pole(of_gains, root);
    // ζ_n + φ_n²/(2 M_n ω_n) Re Z(iω_n)
    const auto& [omega, damping_ratio, shape, mass] = modes[n];
    const auto z = absorber_impedance(absorber, sampling, gains, hardware, Complex(0.0, omega));
    found.push_back({omega, damping_ratio, root,
                     damping_ratio + shape * shape / (2.0 * mass * omega) * z.real()});
  }
  return found;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<ModeDamping> modal_damping<double>(
    const std::vector<PlaceMode<double>>&, const Absorber<double>&, const Sampling<double>&,
    const PdGains<double>&, const LoopHardware&);
#endif

}  // namespace holdfast
