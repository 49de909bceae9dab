#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

/// How the search for the periodic orbit of a motion ended.
enum class OrbitOutcome {
  certified,    ///< the motion is within the orbit's radius of attraction: it tends to it
  approaching,  ///< a certified orbit was proposed, but the motion was not seen within its radius
                ///< of attraction
  on_surface,   ///< its contacts repeat, but the orbit touches a switching surface: the result
                ///< depends on rounding, and no certificate can be given
  incommensurate,  ///< f τ is no fraction p/q with q ≤ 10⁶: the forcing's phase is a state that
                   ///< does not repeat
  diverges,        ///< the motion grows without bound
  none_found,      ///< no orbit in the given number of samples, or q is beyond the largest period
  not_reproduced,  ///< the contacts repeat, but the solution of the sequence switches otherwise
};

/// How long and how far to look for an orbit.
struct OrbitLimits {
  std::int64_t largest_period = 1'000'000;  ///< samples, 1 … 10⁸
  /// Of the motion; 0: eight times the largest period.
  std::int64_t most_samples = 0;
  /// Called at every stroboscopic instant; may throw to end the search.
  std::function<void()> watch = {};
};

/// @throws InvalidParameter where the limits are not admissible
inline void validate(const OrbitLimits& limits) {
  require_within("largest period", static_cast<double>(limits.largest_period), "samples", 1.0, 1e8);
  require_within("number of samples", static_cast<double>(limits.most_samples), "", 0.0, 1e9);
}

/// What a search for a periodic orbit found.
struct OrbitResult {
  OrbitOutcome outcome;                ///< how the search ended
  std::optional<PeriodicOrbit> orbit;  ///< certified, approached, touching a surface, or not
                                       ///< reproduced
  std::int64_t samples = 0;            ///< of the motion that was looked at
  int candidates = 0;                  ///< sequences that were solved for
};

namespace detail {

/// The shortest period of which `itinerary` and states are a whole number of repetitions.
/// @tparam Orbit  PeriodicOrbit
template <class Orbit>
std::size_t shortest_period(const Orbit& orbit) {
  const auto samples = orbit.itinerary.size();
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  const StateScale extent(orbit.states);
  for (std::size_t period = step; period < samples; period += step) {
    if (samples % period != 0) continue;
    const auto apart = (orbit.states[period] - orbit.states.front()).eval();
    if (extent.share_of(apart) > 1e-10) continue;
    if (std::equal(orbit.itinerary.begin() + static_cast<std::ptrdiff_t>(period),
                   orbit.itinerary.end(), orbit.itinerary.begin()))
      return period;
  }
  return samples;
}

/// Looks for the orbit that one motion comes to.
///
/// At every stroboscopic instant (sampling and forcing in phase) the state is compared with a
/// reference that moves on at powers of two (R. P. Brent, An improved Monte Carlo factorization
/// algorithm, BIT 20, 1980). A near return proposes a period; its contacts, once they have
/// repeated, are solved for their exact orbit. The orbit is the motion's once the motion lies
/// within its radius of attraction at a stroboscopic instant. Proposals after the first cost about
/// as much as the motion at most: a sample solved for costs some ten to fifty samples taken, so no
/// more than a sixteenth are.
/// @tparam Scalar  `double`; a template so that only who uses it compiles it
template <class Scalar>
class OrbitSearch {
 public:
  OrbitSearch(const IdealLoop<Scalar>& loop, const Rational& ratio, const OrbitLimits& limits,
              const PeriodicallyForcedMotion<Scalar>& motion)
      : loop_(loop),
        ratio_(ratio),
        limits_(limits),
        maps_(loop, ratio),
        motion_(motion),
        weights_(DeviationScale(loop).weights()) {}

  /// Looks until the orbit is found or the limits are reached.
  OrbitResult run();

 private:
  std::int64_t taken() const { return static_cast<std::int64_t>(itinerary_.size()); }

  void take_stroboscopic_instant() {
    for (std::int64_t j = 0; j < ratio_.denominator; ++j) {
      itinerary_.push_back(motion_.sense().engaged ? 1 : 0);
      motion_.advance();
    }
    largest_ = largest_.cwiseMax(motion_.state().cwiseAbs());
    largest_ever_ = largest_ever_.cwiseMax(largest_);
    extent_.include(largest_);
  }

  bool left_numbers() const { return !(motion_.state().cwiseAbs().maxCoeff() < 1e100); }

  bool is_attracted() const {
    return std::any_of(points_.begin(), points_.end(), [this](const AttractionBall& point) {
      return attracts(point, motion_.memory(), weights_);
    });
  }

  void set_reference() {
    reference_ = motion_.memory();
    reference_taken_ = taken();
    largest_ = motion_.state().cwiseAbs();
  }

  bool near_reference() const {
    const Vector<Scalar, 4> near = 1e-3 * largest_ + 1e-9 * largest_ever_;
    return motion_.law().inside() == reference_.backlash.inside &&
           ((motion_.state() - reference_.state).cwiseAbs().array() <= near.array()).all();
  }

  /// Whether the contacts since the reference are those of as many samples before it.
  bool itinerary_repeats(std::int64_t period) const {
    if (reference_taken_ < period) return reference_taken_ == 0 || period == ratio_.denominator;
    return std::equal(itinerary_.end() - period, itinerary_.end(), itinerary_.end() - 2 * period);
  }

  std::optional<OrbitResult> look_for_return() {
    const std::int64_t period = taken() - reference_taken_;
    if (period > limits_.largest_period || !near_reference() || !itinerary_repeats(period))
      return std::nullopt;
    if (candidates_ > 0 && 16 * (solved_samples_ + period) > taken()) return std::nullopt;
    return try_period(period);
  }

  std::optional<OrbitResult> try_period(std::int64_t period) {
    solved_samples_ += period;
    ++candidates_;
    const Itinerary itinerary(itinerary_.end() - period, itinerary_.end());
    const Backlash<Scalar> law(loop_.backlash_width, reference_.backlash);
    OrbitCandidate candidate = orbit_of_itinerary(loop_, ratio_, maps_, itinerary, law);
    if (!candidate.orbit) return std::nullopt;
    const PeriodicOrbit& orbit = *candidate.orbit;
    if (candidate.outcome == CandidateOutcome::other_itinerary) {
      failed_ = orbit;
    } else if (candidate.outcome == CandidateOutcome::on_surface) {
      if (follows(orbit)) return finish(OrbitOutcome::on_surface, shortest(orbit));
    } else if (orbit.is_attracting()) {
      return propose(orbit);
    }
    return std::nullopt;
  }

  /// From now on the motion is watched for being attracted by this orbit.
  std::optional<OrbitResult> propose(const PeriodicOrbit& orbit) {
    if (proposed_ && proposed_->itinerary == orbit.itinerary) return std::nullopt;
    proposed_ = orbit;
    points_ = attraction_balls(loop_, orbit);
    if (!is_attracted()) return std::nullopt;
    return finish(OrbitOutcome::certified, shortest(orbit));
  }

  /// As a share of the motion's extent.
  double distance_from(const Vector<Scalar, 4>& state) const {
    return extent_.template share_of<Scalar, 4>(motion_.state() - state);
  }

  /// Whether the motion lies on the orbit but for what is still settling, keeps to its contacts for
  /// one more period and ends nearer to it.
  bool follows(const PeriodicOrbit& orbit) {
    const Vector<Scalar, 4> first = orbit.states.front().template head<4>();
    const double before = distance_from(first);
    const auto period = orbit.itinerary.size();
    bool same_itinerary = true;
    for (std::size_t j = 0; j < period; ++j) {
      const bool engaged = motion_.sense().engaged;
      itinerary_.push_back(engaged ? 1 : 0);
      motion_.advance();
      same_itinerary = same_itinerary && engaged == (orbit.itinerary[j] != 0);
    }
    const double nearest = std::max(before, 1e-12 * extent_.share_of(first));
    if (before <= 1e-6 && same_itinerary && distance_from(first) <= nearest) return true;
    set_reference();
    return false;
  }

  /// The same orbit with its shortest period.
  PeriodicOrbit shortest(const PeriodicOrbit& orbit) const {
    const std::size_t period = shortest_period(orbit);
    if (period == orbit.itinerary.size()) return orbit;
    const Itinerary itinerary(orbit.itinerary.begin(),
                              orbit.itinerary.begin() + static_cast<std::ptrdiff_t>(period));
    const Backlash<Scalar> law(loop_.backlash_width, orbit.memory);
    OrbitCandidate candidate = orbit_of_itinerary(loop_, ratio_, maps_, itinerary, law);
    return candidate.outcome == CandidateOutcome::verified ||
                   candidate.outcome == CandidateOutcome::on_surface
               ? *candidate.orbit
               : orbit;
  }

  OrbitResult finish(OrbitOutcome outcome,
                     const std::optional<PeriodicOrbit>& orbit = std::nullopt) const {
    return {outcome, orbit, taken(), candidates_};
  }

  using Memory = decltype(std::declval<PeriodicallyForcedMotion<Scalar>>().memory());

  IdealLoop<Scalar> loop_;
  Rational ratio_;
  OrbitLimits limits_;
  ItineraryMaps<Scalar> maps_;
  PeriodicallyForcedMotion<Scalar> motion_;
  Itinerary itinerary_;
  Memory reference_{};
  std::int64_t reference_taken_ = 0;
  Vector<Scalar, 4> largest_ = Vector<Scalar, 4>::Zero();
  Vector<Scalar, 4> largest_ever_ = Vector<Scalar, 4>::Zero();
  StateScale extent_;  // of the motion
  std::int64_t solved_samples_ = 0;
  int candidates_ = 0;
  Vector<Scalar, 6> weights_;
  std::optional<PeriodicOrbit> proposed_;  // certified, and the motion not yet attracted by it
  std::vector<AttractionBall> points_;     // of the proposed orbit
  std::optional<PeriodicOrbit> failed_;
};

template <class Scalar>
OrbitResult OrbitSearch<Scalar>::run() {
  if (limits_.most_samples == 0) limits_.most_samples = 8 * limits_.largest_period;
  set_reference();
  while (taken() + ratio_.denominator <= limits_.most_samples) {
    take_stroboscopic_instant();
    if (limits_.watch) limits_.watch();
    if (left_numbers()) return finish(OrbitOutcome::diverges);
    if (is_attracted()) return finish(OrbitOutcome::certified, shortest(*proposed_));
    if (const auto result = look_for_return()) return *result;
    if (taken() >= 2 * std::max(reference_taken_, ratio_.denominator)) set_reference();
  }
  if (proposed_) return finish(OrbitOutcome::approaching, shortest(*proposed_));
  if (failed_) return finish(OrbitOutcome::not_reproduced, *failed_);
  return finish(OrbitOutcome::none_found);
}

}  // namespace detail

/// The periodic orbit that a motion comes to, with its certificate.
///
///     const OrbitResult found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
///     if (found.outcome == OrbitOutcome::certified) use(found.orbit->period());
///
/// Bounded work: at most `most_samples` samples of the motion (one period more where the orbit
/// touches a surface) and as many to be solved for, one byte each; and 70 bytes a sample of the
/// orbit.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s), finite
/// @param limits         how long and how far to look
/// @throws InvalidParameter where one of them or the limits are not admissible
template <class Scalar>
OrbitResult find_periodic_orbit(const IdealLoop<Scalar>& loop,
                                const Vector<double, 4>& initial_state,
                                const OrbitLimits& limits = {}) {
  validate(loop);
  require_finite("initial state", initial_state.sum(), "");
  validate(limits);
  const std::optional<Rational> ratio = forcing_ratio(loop);
  if (!ratio) return {OrbitOutcome::incommensurate, std::nullopt, 0, 0};
  if (ratio->denominator > limits.largest_period)
    return {OrbitOutcome::none_found, std::nullopt, 0, 0};
  return detail::OrbitSearch<Scalar>(loop, *ratio, limits,
                                     periodically_forced_motion(loop, *ratio, initial_state))
      .run();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template OrbitResult detail::OrbitSearch<double>::run();
extern template OrbitResult find_periodic_orbit(const IdealLoop<double>&, const Vector<double, 4>&,
                                                const OrbitLimits&);
#endif

}  // namespace holdfast
