#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/orbit/return_search.hpp"

namespace holdfast {

namespace detail {

/// The Model of ReturnSearch for loops that switch at samples only. If state and contacts repeat,
/// it solves for the orbit exactly. A motion has settled once it is in the region of attraction.
/// @tparam Loop        IdealLoop or ModalLoop
/// @tparam MotionOf    motion of that loop
/// @tparam Attraction  type with maps() of the loop; samples_per_solved(); surround(orbit), which
///                     computes the region; holds(motion): whether the motion lies in that region
template <class Loop, class MotionOf, class Attraction>
class SampledSearchModel {
 public:
  using Motion = MotionOf;
  using Plant = TwoMass<double>;
  using State = typename Motion::State;
  using Memory = decltype(std::declval<Motion>().memory());
  using Symbol = Itinerary::value_type;
  using Result = OrbitResult;
  using Seen = SeenMotion<Symbol, Plant>;

  std::int64_t samples_per_solved() const { return attraction_.samples_per_solved(); }

  SampledSearchModel(const Loop& loop, const Rational& ratio, const Motion& motion,
                     const Attraction& attraction)
      : loop_(loop), ratio_(ratio), motion_(motion), attraction_(attraction) {}

  auto readings() const { return motion_.readings(); }
  const State& state() const { return motion_.state(); }
  Memory memory() const { return motion_.memory(); }
  bool is_followed() const { return true; }

  Symbol take_sample() {
    const bool engaged = motion_.sense().engaged;
    motion_.advance();
    return engaged ? Symbol{1} : Symbol{0};
  }

  bool has_contact_of(const Memory& other) const {
    return memory().backlash.inside == other.backlash.inside;
  }

  /// Whether the last `period` contacts equal the `period` contacts before them. If fewer than
  /// `period` samples precede the reference: true if none precede it or the period is q.
  bool may_repeat(const Seen& seen, std::int64_t period) const {
    if (seen.reference < period) return seen.reference == 0 || period == ratio_.denominator;
    const auto end = seen.itinerary.end();
    return std::equal(end - period, end, end - 2 * period);
  }

  /// Solves for the orbit with the last `period` contacts. An orbit that touches a switching
  /// surface is returned only if the motion follows() it.
  Result solve(Seen& seen, std::int64_t period, const Memory& reference) {
    Result found =
        solved({seen.itinerary.end() - period, seen.itinerary.end()}, reference.backlash);
    if (found.outcome == OrbitOutcome::on_surface && !follows(*found.orbit, seen))
      found.orbit.reset();
    return found;
  }

  bool is_same(const Result& known, const Result& other, const Seen&) const {
    return other.outcome == OrbitOutcome::certified &&
           known.orbit->itinerary == other.orbit->itinerary;
  }

  void approach(const Result& found, const Seen&) {
    if (found.outcome == OrbitOutcome::certified) attraction_.surround(*found.orbit);
  }

  bool has_come(const Result& found, const Seen&) const {
    return found.outcome == OrbitOutcome::on_surface || attraction_.holds(motion_);
  }

  /// The orbit with its shortest period; unchanged if solving for that period confirms no orbit.
  PeriodicOrbit shortened(const PeriodicOrbit& orbit) const {
    const auto step = static_cast<std::size_t>(ratio_.denominator);
    const auto period = static_cast<std::ptrdiff_t>(
        shortest_period(orbit.states, orbit.itinerary, step, StateScale(orbit.states)));
    const auto begin = orbit.itinerary.begin();
    if (begin + period == orbit.itinerary.end()) return orbit;
    const Result shorter = solved({begin, begin + period}, orbit.memory);
    const bool is_orbit =
        shorter.outcome == OrbitOutcome::certified || shorter.outcome == OrbitOutcome::on_surface;
    return is_orbit ? *shorter.orbit : orbit;
  }

 private:
  /// Whether the motion is within 10⁻⁶ of its extent from the orbit, has the orbit's contacts for
  /// one period and is no farther from the orbit afterwards. Appends the samples taken to `seen`.
  bool follows(const PeriodicOrbit& orbit, Seen& seen) {
    const State first = orbit.states.front().template head<4>();
    const double before = seen.extent.share_of(state() - first);
    bool same_itinerary = true;
    for (const Symbol contact : orbit.itinerary) {
      seen.itinerary.push_back(take_sample());
      same_itinerary = same_itinerary && seen.itinerary.back() == contact;
    }
    return same_itinerary && seen.came_nearer(first, before, seen.extent.share_of(state() - first));
  }

  Result solved(const Itinerary& itinerary, const BacklashMemory<double>& memory) const {
    const Backlash<double> law(loop_.backlash_width, memory);
    return orbit_of_itinerary(loop_, ratio_, attraction_.maps(), itinerary, law);
  }

  Loop loop_;
  Rational ratio_;
  Motion motion_;
  Attraction attraction_;
};

/// The region of attraction of an IdealLoop's orbit, computed by attraction_balls().
template <class Scalar>
class SampledAttraction {
 public:
  /// Cost of solving for an orbit, in simulated samples per orbit sample (measured 10 … 50).
  static std::int64_t samples_per_solved() { return 16; }

  SampledAttraction(const IdealLoop<Scalar>& loop, const Rational& ratio)
      : loop_(loop), maps_(loop, ratio), weights_(deviation_weights(loop)) {}

  const ItineraryMaps<Scalar>& maps() const { return maps_; }
  void surround(const PeriodicOrbit& orbit) { balls_ = attraction_balls(loop_, orbit); }
  bool holds(const PeriodicallyForcedMotion<Scalar>& motion) const {
    return std::any_of(balls_.begin(), balls_.end(), [&](const AttractionBall& ball) {
      return attracts(ball, motion.memory(), weights_);
    });
  }

 private:
  IdealLoop<Scalar> loop_;
  ItineraryMaps<Scalar> maps_;
  Vector<Scalar, 6> weights_;
  std::vector<AttractionBall> balls_;  // of the proposed orbit
};

template <class Loop, class Motion, class Attraction>
OrbitResult orbit_by_returns(const Loop& loop, const Rational& ratio, const OrbitLimits& limits,
                             const Motion& motion, const Attraction& attraction) {
  const SampledSearchModel<Loop, Motion, Attraction> model(loop, ratio, motion, attraction);
  OrbitResult found = ReturnSearch(model, ratio, limits).run();
  if (found.orbit && found.outcome != OrbitOutcome::not_reproduced)
    found.orbit = model.shortened(*found.orbit);
  return found;
}

/// Finds the periodic orbit of an IdealLoop's motion that begins at phase 0 of the forcing.
template <class Scalar>
OrbitResult orbit_of_motion(const IdealLoop<Scalar>& loop, const Rational& ratio,
                            const OrbitLimits& limits,
                            const PeriodicallyForcedMotion<Scalar>& motion) {
  return orbit_by_returns(loop, ratio, limits, motion, SampledAttraction<Scalar>(loop, ratio));
}

}  // namespace detail

/// Finds the periodic orbit on which a motion settles, and certifies that the motion tends to it.
///
///     const OrbitResult found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
///     if (found.outcome == OrbitOutcome::certified) use(found.orbit->period());
///
/// `certified` means that the motion has entered the orbit's region of attraction.
///
/// Work: at most `limits.most_samples` simulated samples, plus one period if the orbit touches a
/// switching surface. Solving for orbits costs at most about as much as the simulation.
/// Memory: one byte per sample of the motion, and 90 bytes per sample of the orbit.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s), finite
/// @param limits         limits of the search: longest period and number of samples
/// @return the outcome, with an orbit where a periodic solution was found
/// @throws InvalidParameter where the loop, the initial state or a limit is out of its range
template <class Scalar>
OrbitResult find_periodic_orbit(const IdealLoop<Scalar>& loop,
                                const Vector<double, 4>& initial_state,
                                const OrbitLimits& limits = {}) {
  validate(loop);
  require_finite("initial state", initial_state.sum(), "");
  validate(limits);
  const std::optional<Rational> ratio = forcing_ratio(loop);
  if (!ratio) return {OrbitOutcome::incommensurate, {}};
  if (ratio->denominator > limits.largest_period) return {};
  return detail::orbit_of_motion(loop, *ratio, limits,
                                 periodically_forced_motion(loop, *ratio, initial_state));
}
/// Finds the periodic orbit as above, for an initial state given as any Eigen column vector.
template <class Scalar, class Column>
OrbitResult find_periodic_orbit(const IdealLoop<Scalar>& loop,
                                const Eigen::MatrixBase<Column>& initial_state,
                                const OrbitLimits& limits = {}) {
  const Vector<double, 4> state = detail::state_of(converted<double>(loop.plant), initial_state);
  return find_periodic_orbit(loop, state, limits);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template OrbitResult detail::orbit_of_motion(const IdealLoop<double>&, const Rational&,
                                                    const OrbitLimits&,
                                                    const PeriodicallyForcedMotion<double>&);
extern template OrbitResult find_periodic_orbit(const IdealLoop<double>&, const Vector<double, 4>&,
                                                const OrbitLimits&);
#endif

}  // namespace holdfast
