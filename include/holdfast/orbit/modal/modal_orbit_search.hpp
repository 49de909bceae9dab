#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "holdfast/control/digital_loop.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/orbit/modal/modal_attraction.hpp"
#include "holdfast/orbit/modal/modal_itinerary_maps.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

/// f τ = p/q in lowest terms (control/digital_loop.hpp).
inline std::optional<Rational> forcing_ratio(const ModalLoop& loop) {
  return forcing_ratio(
      DigitalLoop{loop.sampling, loop.gains, multi_harmonic_force(loop.excitation), loop.hold});
}

/// Whether a motion at a stroboscopic instant lies in a neighbourhood.
/// @param region  at the same phase of the forcing
/// @param motion  before a sample
/// @param units   of the deviations
/// @tparam Motion  ModalMotion; a parameter so that who does not ask compiles none of it
template <class Motion>
bool attracts(const ModalAttraction& region, const Motion& motion, const Eigen::VectorXd& units) {
  const typename Motion::Memory memory = motion.memory();
  const BacklashMemory<double>& drive = memory.backlash;
  const bool same_direction = drive.previous_velocity * region.memory.previous_velocity > 0.0;
  if (drive.inside != region.memory.inside || !(drive.inside || same_direction)) return false;
  double radius = region.radius;
  if (region.stays_inside)
    radius *= std::min(region.lowest - drive.lower, drive.upper - region.highest);
  const bool gap_counts = drive.inside && !region.stays_inside;
  const Eigen::VectorXcd amplitudes = motion.amplitudes();
  const Eigen::Index order = units.size(), pairs = order - 1 - amplitudes.size();
  Eigen::VectorXd deviation(order + 1);
  deviation << amplitudes.real(), amplitudes.head(pairs).imag(), memory.previous_force, 0.0;
  deviation.head(order) = (deviation.head(order) - region.first).cwiseQuotient(units);
  if (gap_counts) deviation[order] = drive.lower - region.memory.lower;
  return (region.root.triangularView<Eigen::Upper>() * deviation).norm() < radius;
}

namespace detail {

/// The region of attraction of an orbit of a conductor by its modes.
/// @tparam Loop  ModalLoop
template <class Loop>
class ModalRegion {
 public:
  /// A sample solved for costs N² operations where one taken costs N.
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

}  // namespace detail

/// The periodic orbit that the motion of a conductor by its modes comes to, with its certificate:
/// that of find_periodic_orbit() of the two masses, the states of the orbit being what conductor
/// and absorber show, z̃_j = [z, ż, z₂, ż₂; u_{j−1}], and its multipliers the ten largest of all.
///
/// `none_found` is also the answer where `plant_poles` are not all found.
///
/// Work: that of the motion, O(N) a sample; for a period that is proposed O(N²) a sample and some
/// N³.
/// @param loop           with its excitation and backlash
/// @param initial_state  of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂]
/// @param limits         how long and how far to look
/// @throws InvalidParameter where one of them is not admissible
/// @tparam Loop  ModalLoop; a template so that only who calls it compiles it
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
OrbitResult find_periodic_orbit(const Loop& loop, const ModalMotion::Full& initial_state,
                                const OrbitLimits& limits = {}) {
  validate(limits);
  const std::optional<ModalMotion> motion = modal_motion(loop, initial_state);
  if (!motion) return {};
  const std::optional<Rational> ratio = forcing_ratio(loop);
  if (!ratio) return {OrbitOutcome::incommensurate, {}};
  if (ratio->denominator > limits.largest_period) return {};
  const ModalItineraryMaps maps(loop, plant_poles(loop.modes, loop.absorber), *ratio, limits.watch);
  return detail::orbit_by_returns(loop, *ratio, limits, *motion,
                                  detail::ModalRegion<Loop>(loop, maps));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template OrbitResult detail::orbit_by_returns(const ModalLoop&, const Rational&,
                                                     const OrbitLimits&, const ModalMotion&,
                                                     const detail::ModalRegion<ModalLoop>&);
extern template OrbitResult find_periodic_orbit(const ModalLoop&, const ModalMotion::Full&,
                                                const OrbitLimits&);
#endif

}  // namespace holdfast
