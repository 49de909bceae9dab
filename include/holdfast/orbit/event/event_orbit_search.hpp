#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_solver.hpp"
#include "holdfast/orbit/event/repeating_motion.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast {

/// What a search for the periodic orbit of an EventMotion found.
template <class Contact>
struct EventOrbitResult {
  OrbitOutcome outcome;  ///< how the search ended
  std::optional<EventOrbitOf<EventMotion<Contact>::states>>
      orbit;  ///< certified, approached, touching a surface, not reproduced
  std::optional<StroboscopicState<Contact>> point;  ///< of the orbit, at its first sample
  std::int64_t samples = 0;                         ///< of the motion that was looked at
  int candidates = 0;                               ///< returns that were solved for
};

namespace detail {

/// Looks for the orbit that one motion comes to.
///
/// At every stroboscopic instant (sampling and forcing in phase) the state is compared with a
/// reference that moves on at powers of two (R. P. Brent, An improved Monte Carlo factorization
/// algorithm, BIT 20, 1980). A near return proposes a period, whose fixed point is solved for. The
/// orbit is the motion's once the motion has come within a millionth of it, and has ended two
/// periods in succession no farther from it than it began them, in the same modes.
template <class Contact>
class EventOrbitSearch {
 public:
  using Result = EventOrbitResult<Contact>;

  /// @param start  at a stroboscopic instant
  EventOrbitSearch(const EventMotion<Contact>& start, const Rational& ratio,
                   const OrbitLimits& limits)
      : ratio_(ratio),
        limits_(limits),
        motion_(start, ratio.denominator),
        solver_(motion_, ratio),
        extent_(start.readings()) {}

  Result run() {
    if (limits_.most_samples == 0) limits_.most_samples = 8 * limits_.largest_period;
    largest_ever_ = State::Zero(state().size());
    extent_.include(state());
    set_reference();
    while (taken() + ratio_.denominator <= limits_.most_samples) {
      take_stroboscopic_instant();
      if (limits_.watch) limits_.watch();
      if (!(state().cwiseAbs().maxCoeff() < 1e100)) return finish(OrbitOutcome::diverges);
      if (motion_.motion().counts().accumulates) return unfollowed();
      look_for_return();
      if (has_come())
        return finish(on_surface_ ? OrbitOutcome::on_surface : OrbitOutcome::certified);
      if (taken() >= 2 * std::max(reference_taken_, ratio_.denominator)) set_reference();
    }
    if (proposed_) return finish(OrbitOutcome::approaching);
    proposed_ = failed_;
    return finish(failed_ ? OrbitOutcome::not_reproduced : OrbitOutcome::none_found);
  }

 private:
  using Solver = EventOrbitSolver<Contact>;
  using Candidate = typename Solver::Candidate;
  using Extent = typename Solver::Extent;
  using Orbit = typename Solver::Orbit;
  using State = typename Solver::State;

  std::int64_t taken() const { return static_cast<std::int64_t>(modes_.size()); }
  const State& state() const { return motion_.motion().state(); }

  void take_stroboscopic_instant() {
    for (std::int64_t j = 0; j < ratio_.denominator; ++j) {
      modes_.push_back(motion_.sense().mode);
      motion_.advance();
    }
    largest_ = largest_.cwiseMax(state().cwiseAbs());
    largest_ever_ = largest_ever_.cwiseMax(largest_);
    extent_.include(state());
  }

  void set_reference() {
    reference_ = state();
    reference_mode_ = motion_.motion().contact().mode();
    reference_taken_ = taken();
    largest_ = state().cwiseAbs();
  }

  bool near_reference() const {
    const State near = 1e-3 * largest_ + 1e-9 * largest_ever_;
    return motion_.motion().contact().mode() == reference_mode_ &&
           ((state() - reference_).cwiseAbs().array() <= near.array()).all();
  }

  /// Proposals after the first cost about as much as the motion at most: a sample solved for costs
  /// some sixteen to sixty samples taken.
  void look_for_return() {
    const std::int64_t period = taken() - reference_taken_;
    const bool settles = periods_on_orbit_ > 0;
    if (settles || period > limits_.largest_period || !near_reference()) return;
    if (candidates_ > 0 && 32 * (solved_samples_ + period) > taken()) return;
    solved_samples_ += period;
    ++candidates_;
    const Candidate candidate = solver_.solve(motion_.point(), period);
    if (!candidate.orbit) return;
    if (candidate.outcome == CandidateOutcome::other_itinerary)
      failed_ = candidate;
    else if (candidate.outcome == CandidateOutcome::on_surface || candidate.orbit->is_attracting())
      propose(candidate);
  }

  /// From now on the motion is watched for coming to this orbit.
  void propose(const Candidate& candidate) {
    if (proposed_ && is_same(*proposed_->orbit, *candidate.orbit)) return;
    proposed_ = candidate;
    on_surface_ = candidate.outcome == CandidateOutcome::on_surface;
    proposed_taken_ = taken();
    distance_ = distance();
    periods_on_orbit_ = 0;
  }

  bool is_same(const Orbit& known, const Orbit& other) const {
    if (known.modes != other.modes) return false;
    Extent extent(motion_.motion().readings(), known.states);
    extent.widen(1e-3, extent_);
    return extent.share_of(other.states.front() - known.states.front()) <= 1e-9;
  }

  const State& proposed_state() const { return proposed_->orbit->states.front(); }

  /// Of the motion from the proposed orbit, as a share of the motion's extent.
  double distance() const { return extent_.share_of(state() - proposed_state()); }

  /// Asked at every stroboscopic instant, looks at those at which the motion began the proposed
  /// orbit.
  bool has_come() {
    if (!proposed_) return false;
    const std::vector<ContactMode>& modes = proposed_->orbit->modes;
    const auto period = static_cast<std::int64_t>(modes.size());
    const std::int64_t passed = taken() - proposed_taken_;
    if (passed == 0 || passed % period != 0) return false;
    const double before = distance_;
    distance_ = distance();
    const double nearest = std::max(before, 1e-12 * extent_.share_of(proposed_state()));
    const bool nearer = before <= 1e-6 && distance_ <= nearest;
    const bool same_modes = std::equal(modes.begin(), modes.end(), modes_.end() - period);
    periods_on_orbit_ = nearer && same_modes ? periods_on_orbit_ + 1 : 0;
    return periods_on_orbit_ >= 2;
  }

  Result unfollowed() const {
    return {OrbitOutcome::none_found, std::nullopt, std::nullopt, taken(), candidates_};
  }

  Result finish(OrbitOutcome outcome) const {
    Result result{outcome, std::nullopt, std::nullopt, taken(), candidates_};
    const bool shown = proposed_ && outcome != OrbitOutcome::diverges;
    if (shown) result.orbit = proposed_->orbit;
    if (shown) result.point = proposed_->point;
    return result;
  }

  Rational ratio_;
  OrbitLimits limits_;
  RepeatingMotion<Contact> motion_;
  Solver solver_;
  std::vector<ContactMode> modes_;
  State reference_;
  int reference_mode_ = 0;
  std::int64_t reference_taken_ = 0;
  State largest_, largest_ever_;  // |x_i| since the reference, and of all
  Extent extent_;                 // of the motion
  std::int64_t solved_samples_ = 0;
  int candidates_ = 0;
  std::optional<Candidate> proposed_;  // certified but for the motion's coming to it
  bool on_surface_ = false;            // the proposed one
  std::int64_t proposed_taken_ = 0;
  double distance_ = 0.0;  // of the motion from it
  int periods_on_orbit_ = 0;
  std::optional<Candidate> failed_;
};

}  // namespace detail

/// The periodic orbit that a motion comes to, with its numerical certificate (EventOrbit).
///
///     EventMotion<ExactBacklash> motion(loop, ExactBacklash(plant, width), state);
///     const auto found = find_event_orbit(motion, *forcing_ratio(loop), {});
///     if (found.outcome == OrbitOutcome::certified) use(found.orbit->period());
///
/// `certified` means beside what EventOrbit says that the motion was seen to come to the orbit:
/// within a millionth of its size, nearer still over two further periods. `none_found` is also the
/// answer where changes of contact accumulate.
///
/// Bounded work: at most `most_samples` samples of the motion, and about as much again for what is
/// solved for. Memory: a byte a sample of the motion, some 150 a sample of the orbit.
/// @param start   the motion, before a sample; it is left as it is
/// @param ratio   of forcing_ratio()
/// @param limits  how long and how far to look
/// @throws InvalidParameter where the limits are not admissible, or where sampling and forcing do
///         not coincide every q samples: other frequencies, a recorded force, samples that jitter
template <class Contact>
EventOrbitResult<Contact> find_event_orbit(const EventMotion<Contact>& start, const Rational& ratio,
                                           const OrbitLimits& limits) {
  validate(limits);
  const std::optional<Rational> fits = forcing_ratio(start.loop());
  if (!fits || ratio.denominator < 1 || ratio.denominator % fits->denominator != 0)
    throw InvalidParameter("samples from one coincidence with the forcing to the next",
                           static_cast<double>(ratio.denominator), "",
                           "a multiple of those after which sampling and forcing repeat");
  if (ratio.denominator > limits.largest_period)
    return {OrbitOutcome::none_found, std::nullopt, std::nullopt, 0, 0};
  EventMotion<Contact> motion = start;
  for (; motion.index() % ratio.denominator != 0; motion.advance()) motion.sense();
  return detail::EventOrbitSearch<Contact>(motion, ratio, limits).run();
}

/// The same where the ratio is not known yet: incommensurate where there is none.
template <class Contact>
EventOrbitResult<Contact> find_event_orbit(const EventMotion<Contact>& start,
                                           const OrbitLimits& limits = {}) {
  validate(limits);
  const std::optional<Rational> ratio = forcing_ratio(start.loop());
  if (!ratio) return {OrbitOutcome::incommensurate, std::nullopt, std::nullopt, 0, 0};
  return find_event_orbit(start, *ratio, limits);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template EventOrbitResult<DriveContact<>> find_event_orbit(
    const EventMotion<DriveContact<>>&, const Rational&, const OrbitLimits&);
#endif

}  // namespace holdfast
