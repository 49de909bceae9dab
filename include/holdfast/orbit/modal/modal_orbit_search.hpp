#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/math/linalg/discrete_lyapunov.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/orbit/modal/modal_itinerary_maps.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

/// A neighbourhood of an orbit's first state, for a conductor given by its modes. Every motion that
/// starts in it, at the same forcing phase, has the orbit's itinerary for ever and tends to the
/// orbit. The neighbourhood is ‖R e‖ < `radius`, with the deviation e of a motion from the orbit.
///
/// The entries of e are those of ModalDeviations and the deviation of the gap's position, all in m.
/// ‖R e‖² = eᵀV e is a Lyapunov function: V − MᵀV M is positive definite, where M maps e over one
/// or more periods. The motion must also have the orbit's contact and, while engaged, the orbit's
/// last sign of Δż. For an orbit that stays in its gap, `radius` is per metre of clearance between
/// the orbit and the gap's ends.
struct ModalAttraction {
  Eigen::VectorXd first;          ///< first state of the orbit, a ModalItineraryMaps::State
  BacklashMemory<double> memory;  ///< memory of the backlash law before the first sample
  bool stays_inside;              ///< whether the drive never leaves its gap
  double lowest,                  ///< least Δz of the orbit (m)
      highest;                    ///< largest Δz of the orbit (m)
  Eigen::MatrixXd root;           ///< factor R of the norm, V = RᵀR
  double radius;  ///< bound of ‖R e‖ (m, or m per m), > 0; ∞ if no contact can change
  double inscribed_share;  ///< 1/‖R‖_F: ‖e‖ < radius · inscribed_share implies ‖R e‖ < radius
};

namespace detail {

/// The neighbourhood of an orbit whose drive never leaves its gap: natural motions then decay
/// independently. V is diagonal, with the moduli of their coefficients in Δz, bounded from below.
/// A deviation e changes Δz by at most ‖h‖ ‖R e‖ at every sample, where h is the row of Δz · R⁻¹.
/// @return nullopt with a processing delay, or where a natural motion does not decay
template <class Loop>
std::optional<ModalAttraction> idle_attraction(const Loop& loop, const ModalItineraryMaps& maps,
                                               const PeriodicOrbit& orbit) {
  const auto solution = solution_without_blocks(maps, orbit.itinerary);
  if (!solution || loop.sampling.processing_delay > 0.0 ||
      !(maps.decay().cwiseAbs().array() < 1.0).all())
    return std::nullopt;
  const Eigen::Index count = maps.decay().size(), pairs = maps.pairs(), order = maps.units().size();
  ModalAttraction found;
  found.first = solution->first;
  found.memory = orbit.memory;
  set_extent(found, orbit);
  if (!found.stays_inside) return std::nullopt;
  // |h| of each coordinate: that of a pair turns from its real to its imaginary part.
  Eigen::VectorXd reading = Eigen::VectorXd::Zero(order + 1);
  ModalItineraryMaps::State unit = maps.rest();
  for (Eigen::Index k = 0; k < count + pairs; ++k) {
    unit[k] = maps.units()[k];
    reading[k] = std::abs(relative_displacement(maps.seen(unit)));
    unit[k] = 0.0;
  }
  for (Eigen::Index k = 0; k < pairs; ++k)
    reading[k] = reading[count + k] = std::hypot(reading[k], reading[count + k]);
  const double least = 1e-6 * reading.maxCoeff();
  const Eigen::VectorXd weights = reading.cwiseMax(least).cwiseSqrt();
  found.root = weights.asDiagonal();
  found.radius = 1.0 / reading.cwiseQuotient(weights).norm();
  found.inscribed_share = 1.0 / found.root.norm();
  return found;
}

}  // namespace detail

/// Computes the neighbourhood of attraction of an orbit of a conductor given by its modes.
///
/// Φ maps the initial deviation e to the deviation at a sample; h is a switching surface's normal.
/// A contact is unchanged if |h Φ e| is below the orbit's distance from the surface. `radius` is
/// the least value of distance / ‖h Φ R⁻¹‖ over the periods of M. After them ‖R e‖ has decreased.
/// M covers the least number of periods (1, 2, 4, … 64) whose contraction exceeds rounding.
/// @param loop   the loop that has the orbit
/// @param maps   maps of that loop
/// @param orbit  orbit of that loop, attracting and certified
/// @return nullopt where no matrix V (ModalAttraction) or no orbit is found, or the radius is 0
template <class Loop>
std::optional<ModalAttraction> modal_attraction(const Loop& loop, const ModalItineraryMaps& maps,
                                                const PeriodicOrbit& orbit) {
  if (is_idle(orbit.itinerary))
    if (auto idle = detail::idle_attraction(loop, maps, orbit)) return idle;
  using Flow = detail::DeviationFlow<ModalDeviations>;
  const Flow flow(maps.deviations(), loop.backlash_width, orbit);
  maps.look();
  Eigen::MatrixXd power = Flow(flow).over(orbit.period_samples());
  const Eigen::Index order = flow.order() - 1;
  const auto solution = periodic_solution(
      maps, orbit.itinerary, std::vector<Eigen::MatrixXd>{power.topLeftCorner(order, order)});
  if (!solution) return std::nullopt;
  ModalAttraction found;
  found.first = solution->first;
  found.memory = orbit.memory;
  detail::set_extent(found, orbit);
  for (std::int64_t periods = 1; periods <= 64; periods *= 2) {
    maps.look();
    const std::optional<Eigen::MatrixXd> measure = discrete_lyapunov(power, 0.25);
    if (!measure) {
      power = Eigen::MatrixXd(power * power);
      continue;
    }
    found.root = Eigen::LLT<Eigen::MatrixXd>(*measure).matrixU();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(flow.order(), flow.order());
    const Eigen::MatrixXd sphere = found.root.triangularView<Eigen::Upper>().solve(unit);
    detail::DeviationSegment segment;
    Flow(flow).follow(sphere, periods * orbit.period_samples(), &segment);
    found.radius = segment.radius;
    found.inscribed_share = 1.0 / found.root.norm();
    return found.radius > 0.0 ? std::optional(std::move(found)) : std::nullopt;
  }
  return std::nullopt;
}

/// The ratio f τ = p/q, forcing frequency × sampling period, of a modal loop as a fraction in
/// lowest terms; nullopt if q exceeds 10⁶ (control/digital_loop.hpp).
inline std::optional<Rational> forcing_ratio(const ModalLoop& loop) {
  return forcing_ratio(
      DigitalLoop{loop.sampling, loop.gains, multi_harmonic_force(loop.excitation), loop.hold});
}

/// Whether a motion at a stroboscopic instant (sampling and forcing in phase) lies in a
/// neighbourhood of attraction. @param region  the neighbourhood
/// @param motion  the motion before the sample at this instant
/// @param units   units of the deviations, ModalItineraryMaps::units()
template <class Motion>
bool attracts(const ModalAttraction& region, const Motion& motion, const Eigen::VectorXd& units) {
  const typename Motion::Memory memory = motion.memory();
  const BacklashMemory<double>& drive = memory.backlash;
  const bool same_direction = drive.previous_velocity * region.memory.previous_velocity > 0.0;
  if (drive.inside != region.memory.inside || !(drive.inside || same_direction)) return false;
  const Eigen::VectorXcd amplitudes = motion.amplitudes();
  const Eigen::Index order = units.size(), pairs = order - 1 - amplitudes.size();
  Eigen::VectorXd deviation(order + 1);
  deviation << amplitudes.real(), amplitudes.head(pairs).imag(), memory.previous_force, 0.0;
  deviation.head(order) = (deviation.head(order) - region.first).cwiseQuotient(units);
  if (drive.inside && !region.stays_inside) deviation[order] = drive.lower - region.memory.lower;
  return (region.root.triangularView<Eigen::Upper>() * deviation).norm() <
         attraction_radius(region, drive);
}

namespace detail {

/// The region of attraction of an orbit of a conductor given by its modes.
template <class Loop>
class ModalRegion {
 public:
  /// The cost of solving for an orbit, O(N²) per sample, divided by that of simulating it, O(N).
  std::int64_t samples_per_solved() const {
    return std::max<std::int64_t>(16, maps_.units().size());
  }

  ModalRegion(const Loop& loop, const ModalItineraryMaps& maps) : loop_(loop), maps_(maps) {}

  const ModalItineraryMaps& maps() const { return maps_; }
  void surround(const PeriodicOrbit& orbit) { region_ = modal_attraction(loop_, maps_, orbit); }
  bool holds(const ModalMotion& motion) const {
    return region_ && attracts(*region_, motion, maps_.units());
  }

 private:
  Loop loop_;
  ModalItineraryMaps maps_;
  std::optional<ModalAttraction> region_;  // of the proposed orbit
};

/// The orbit of a modal loop without backlash, which attracts every motion; O(N) work per sample.
/// @return nullopt where the loop is unstable or its roots cannot be separated numerically
template <class Maps>
std::optional<PeriodicOrbit> orbit_without_backlash(const ModalLoop& loop, const Maps& maps,
                                                    const Rational& ratio) {
  std::vector<Multiplier> multipliers;
  const double samples = static_cast<double>(ratio.denominator);
  for (const std::complex<double>& root : maps.roots())
    multipliers.push_back({samples * std::log(std::abs(root)),
                           std::remainder(samples * std::arg(root), 2.0 * pi<double>)});
  std::sort(multipliers.begin(), multipliers.end(), Multiplier::is_larger);
  multipliers.resize(std::min<std::size_t>(multipliers.size(), 10));
  const Itinerary itinerary(static_cast<std::size_t>(ratio.denominator), 1);
  PeriodicOrbit orbit{
      {ratio, loop.sampling.period, {}, std::move(multipliers), 0.0}, itinerary, {}, {}};
  orbit.states.resize(itinerary.size());
  if (orbit.multipliers.empty() || !orbit.is_attracting()) return std::nullopt;
  const auto first = maps.steady();
  const auto open = maps.seen(maps.follow(first, itinerary, orbit.states) - first);
  orbit.closure_error = open.template head<4>().norm();
  const SwitchingPattern pattern =
      switching_pattern(orbit.states, Backlash<double>(loop.backlash_width));
  orbit.memory = pattern.memory;
  orbit.borders = borders_of(pattern, orbit.states, loop.backlash_width);
  return orbit;
}

}  // namespace detail

/// Finds the periodic orbit on which the motion of a conductor given by its modes settles, and
/// certifies that the motion tends to it; see the overload for two masses. The orbit's states are
/// the observed states [z, ż, z₂, ż₂; u_{j−1}]. Only the ten largest multipliers are given.
///
/// The outcome is `none_found` also where not all `plant_poles` could be computed.
///
/// Work for a state of N entries: without backlash O(N) per sample of the orbit. With backlash O(N)
/// per simulated sample; for each orbit computed, O(N²) per sample of its period plus O(N³).
/// @param loop           the loop with its excitation and backlash
/// @param poles          `plant_poles` of the loop's modes and absorber
/// @param initial_state  state of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂]
/// @param limits         limits of the search: longest period and number of samples
/// @throws InvalidParameter where the loop, the initial state or a limit is out of its range
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
OrbitResult find_periodic_orbit(const Loop& loop, const std::vector<PlantPole>& poles,
                                const ModalMotion::Full& initial_state,
                                const OrbitLimits& limits = {}) {
  validate(limits);
  const std::optional<ModalMotion> motion = modal_motion(loop, poles, initial_state);
  if (!motion) return {};
  const std::optional<Rational> ratio = forcing_ratio(loop);
  if (!ratio) return {OrbitOutcome::incommensurate, {}};
  if (ratio->denominator > limits.largest_period) return {};
  const ModalItineraryMaps maps(loop, poles, *ratio, limits.watch);
  if (loop.backlash_width == 0.0)
    if (auto orbit = detail::orbit_without_backlash(loop, maps, *ratio))
      return {OrbitOutcome::certified, std::move(orbit), 0, 1};
  return detail::orbit_by_returns(loop, *ratio, limits, *motion,
                                  detail::ModalRegion<Loop>(loop, maps));
}
/// Finds the periodic orbit as above, with poles that this overload computes.
/// @throws InvalidParameter where the loop, the initial state or a limit is out of its range
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
OrbitResult find_periodic_orbit(const Loop& loop, const ModalMotion::Full& initial_state,
                                const OrbitLimits& limits = {}) {
  validate(loop);
  return find_periodic_orbit(loop, plant_poles(loop.modes, loop.absorber), initial_state, limits);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::optional<ModalAttraction> modal_attraction(const ModalLoop&,
                                                                const ModalItineraryMaps&,
                                                                const PeriodicOrbit&);
extern template OrbitResult detail::orbit_by_returns(const ModalLoop&, const Rational&,
                                                     const OrbitLimits&, const ModalMotion&,
                                                     const detail::ModalRegion<ModalLoop>&);
extern template OrbitResult find_periodic_orbit(const ModalLoop&, const std::vector<PlantPole>&,
                                                const ModalMotion::Full&, const OrbitLimits&);
#endif

}  // namespace holdfast
