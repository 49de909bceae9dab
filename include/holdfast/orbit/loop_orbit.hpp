#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The limit of border_share() (PeriodicOrbit, EventOrbit) below which an orbit counts as close to
/// a switching surface. A relative change of a parameter by about 10⁻⁴ may then end the orbit.
inline constexpr double near_border = 1e-4;

/// The common data of orbits that switch at samples (PeriodicOrbit) or between them (EventOrbitOf).
/// @tparam Size  length of a state: 5 for [z₁, ż₁, z₂, ż₂; last command], or the plant's order
template <int Size>
struct LoopOrbit {
  Rational ratio;                            ///< forcing frequency × sampling period, f τ = p/q
  double sampling_period;                    ///< sampling period τ (s)
  std::vector<Vector<double, Size>> states;  ///< state at each sample; forcing phase 0 at the first
  /// Floquet multipliers of one period, largest modulus first; log_modulus is −∞ for a multiplier
  /// 0. For a conductor given by its modes only the ten largest are listed.
  std::vector<Multiplier> multipliers;
  double closure_error;  ///< ‖x_N − x₀‖ after one period; x is the observed plant state (SI units)

  /// The number N of samples in a period.
  std::int64_t period_samples() const { return static_cast<std::int64_t>(states.size()); }
  /// The period N τ (s).
  double period() const { return static_cast<double>(period_samples()) * sampling_period; }
  /// The number N p/q of excitation periods in one orbit period; 0 without excitation.
  std::int64_t forcing_periods() const {
    return period_samples() / ratio.denominator * ratio.numerator;
  }
  /// The largest modulus max |λ| of the multipliers λ; 0 where it underflows.
  double largest_multiplier() const { return std::exp(multipliers.front().log_modulus); }
  /// Whether nearby motions with the same sequence of switches tend to the orbit. True if the
  /// largest modulus of the multipliers is below 1 by more than rounding.
  bool is_attracting() const {
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    return multipliers.front().log_modulus < -rounding * static_cast<double>(states.size());
  }
  /// The largest |z₁| (m) at the samples, z₁ being the first entry of the state.
  double amplitude() const {
    double largest = 0.0;
    for (const auto& state : states) largest = std::max(largest, std::abs(state[0]));
    return largest;
  }
};

/// The outcome of a search for the periodic orbit on which a motion settles. Also the outcome of a
/// single solution: the orbit for assumed contacts is computed without simulation of a motion.
enum class OrbitOutcome {
  certified,       ///< search: the motion tends to the orbit; single solution: the computed orbit
                   ///< has the assumed contacts
  approaching,     ///< an attracting orbit was found; the motion did not settle within the limits
  on_surface,      ///< the contacts repeat, but the orbit touches a switching surface: the result
                   ///< depends on rounding, and no certificate can be given
  incommensurate,  ///< forcing frequency × sampling period is no fraction p/q with q ≤ 10⁶
  diverges,        ///< the motion grows without bound
  none_found,      ///< search: no orbit within the limits, or q exceeds the largest period; single
                   ///< solution: 1 is a multiplier: none or infinitely many periodic solutions
  not_reproduced,  ///< a periodic solution was found, but its contacts are not the assumed ones
  neutral,         ///< 1 is a multiplier: the motion may drift along a continuous family of orbits.
                   ///< Remedies for the state variable with index `neutral_state`: add a restoring
                   ///< term, remove the variable, or prescribe its initial value
};

/// The result of a search for a periodic orbit, or of a single solution (OrbitOutcome).
/// @tparam Orbit  PeriodicOrbit or EventOrbitOf<N>
template <class Orbit>
struct OrbitResultOf {
  OrbitOutcome outcome = OrbitOutcome::none_found;  ///< outcome of the search or single solution
  std::optional<Orbit> orbit;  ///< the orbit; nullopt without a solution. `outcome` states
                               ///< whether the orbit is confirmed
  std::int64_t samples = 0;    ///< number of simulated samples of the motion
  int candidates = 0;          ///< number of candidate periods tried
  /// For the outcome `neutral`: index, from 0, of the state variable in which the orbits of the
  /// family differ most. The plant's variables come first, then the controller's. Else nullopt.
  std::optional<std::int64_t> neutral_state = {};
};

namespace detail {

/// The shortest period (samples) with which both the states and the itinerary repeat.
/// @param step    number q of samples; only multiples of q are considered
template <class State, class Symbol, class Extent>
std::size_t shortest_period(const std::vector<State>& states, const std::vector<Symbol>& itinerary,
                            std::size_t step, const Extent& extent) {
  const std::size_t samples = states.size();
  for (std::size_t period = step; period < samples; period += step) {
    if (samples % period != 0) continue;
    const State apart = states[period] - states.front();
    if (extent.share_of(apart) > 1e-10) continue;
    if (std::equal(itinerary.begin() + static_cast<std::ptrdiff_t>(period), itinerary.end(),
                   itinerary.begin()))
      return period;
  }
  return samples;
}

/// Whether a cyclic sequence equals another one rotated by 0, `step`, 2 `step`, … entries.
template <class Member, class Same>
bool is_rotated(const std::vector<Member>& one, const std::vector<Member>& other, std::size_t step,
                const Same& same) {
  if (one.size() != other.size()) return false;
  for (std::size_t shift = 0; shift < one.size(); shift += step) {
    const auto middle = other.begin() + static_cast<std::ptrdiff_t>(shift);
    const auto split = one.end() - static_cast<std::ptrdiff_t>(shift);
    if (std::equal(one.begin(), split, middle, same) &&
        std::equal(split, one.end(), other.begin(), same))
      return true;
  }
  return one.empty();
}

/// Whether an orbit comes so near to a switching surface that rounding may decide a contact.
/// @param error         error of the states, as a share of the extent
/// @param displacement  least distance of Δz from an end of the gap (m)
/// @param velocity      least |Δż| at a decision about a reversal (m/s)
inline bool touches_surface(const StateScale& extent, double error, double displacement,
                            double velocity) {
  const double share = 256.0 * std::numeric_limits<double>::epsilon() + 64.0 * error;
  const auto rounding = [share](double whole) { return whole > 0.0 ? share * whole : 0.0; };
  return displacement <= rounding(extent.displacement) || velocity <= rounding(extent.velocity);
}

/// The outcome of a single solution, by whether it touches a surface and switches as assumed.
inline OrbitOutcome outcome_of(bool touches, bool switches_alike) {
  if (touches) return OrbitOutcome::on_surface;
  return switches_alike ? OrbitOutcome::certified : OrbitOutcome::not_reproduced;
}

}  // namespace detail
}  // namespace holdfast
