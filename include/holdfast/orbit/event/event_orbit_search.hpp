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
#include "holdfast/orbit/return_search.hpp"

namespace holdfast {

/// What a search for the periodic orbit of an EventMotion found.
template <class Contact>
struct EventOrbitResult : OrbitResultOf<EventOrbitOf<EventMotion<Contact>::states>> {
  std::optional<StroboscopicState<Contact>> point;  ///< of the orbit, at its first sample
};

namespace detail {

/// An EventMotion as ReturnSearch asks for it: a return is solved for its fixed point, and the
/// motion has come to an orbit once it was within a millionth of it, and has ended two periods in
/// succession no farther from it than it began them, in the same modes.
template <class Contact>
class EventSearchModel {
 public:
  using Motion = EventMotion<Contact>;
  using Plant = typename Motion::Plant;
  using State = typename Motion::State;
  using Memory = StroboscopicState<Contact>;
  using Symbol = ContactMode;
  using Candidate = typename EventOrbitSolver<Contact>::Candidate;
  using Result = EventOrbitResult<Contact>;
  using Seen = SeenMotion<Symbol, Plant>;

  /// A sample solved for costs some sixteen to sixty samples taken.
  static constexpr std::int64_t samples_per_solved = 32;

  /// @param start  at a stroboscopic instant
  EventSearchModel(const Motion& start, const Rational& ratio)
      : motion_(start, ratio.denominator), solver_(motion_, ratio) {}

  const PortReadings<Plant>& readings() const { return motion_.motion().readings(); }
  const State& state() const { return motion_.motion().state(); }
  Memory memory() const { return motion_.point(); }
  bool is_followed() const { return !motion_.motion().counts().accumulates; }

  Symbol take_sample() {
    const ContactMode mode = motion_.sense().mode;
    motion_.advance();
    return mode;
  }

  bool has_contact_of(const Memory& other) const {
    return motion_.motion().contact().mode() == other.contact.mode();
  }

  /// Not while the motion settles on an orbit.
  bool may_repeat(const Seen&, std::int64_t) const { return periods_on_orbit_ == 0; }

  Candidate solve(const Seen&, std::int64_t period, const Memory&) {
    return solver_.solve(motion_.point(), period);
  }

  bool is_same(const Candidate& known, const Candidate& other, const Seen& seen) const {
    if (known.orbit->modes != other.orbit->modes) return false;
    StateScaleOf<Plant> extent(readings(), known.orbit->states);
    extent.widen(1e-3, seen.extent);
    return extent.share_of(first_state(other) - first_state(known)) <= 1e-9;
  }

  void approach(const Candidate& candidate, const Seen& seen) {
    approached_ = seen.taken();
    distance_ = seen.extent.share_of(state() - first_state(candidate));
    periods_on_orbit_ = 0;
  }

  /// Looks at those instants at which the motion began the orbit's period.
  bool has_come(const Candidate& candidate, const Seen& seen) {
    const std::vector<ContactMode>& modes = candidate.orbit->modes;
    const auto period = static_cast<std::int64_t>(modes.size());
    const std::int64_t passed = seen.taken() - approached_;
    if (passed == 0 || passed % period != 0) return false;
    const double before = distance_;
    distance_ = seen.extent.share_of(state() - first_state(candidate));
    const bool nearer = seen.came_nearer(first_state(candidate), before, distance_);
    const bool same_modes = std::equal(modes.begin(), modes.end(), seen.itinerary.end() - period);
    periods_on_orbit_ = nearer && same_modes ? periods_on_orbit_ + 1 : 0;
    return periods_on_orbit_ >= 2;
  }

  Result result_of(const Candidate& found) const { return {{{}, found.orbit, 0, 0}, found.point}; }

 private:
  static const State& first_state(const Candidate& candidate) {
    return candidate.orbit->states.front();
  }

  RepeatingMotion<Contact> motion_;
  EventOrbitSolver<Contact> solver_;
  std::int64_t approached_ = 0;  // samples before the orbit was proposed
  double distance_ = 0.0;        // of the motion from it, as a share of the motion's extent
  int periods_on_orbit_ = 0;
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
    return {{OrbitOutcome::none_found, std::nullopt, 0, 0}, std::nullopt};
  EventMotion<Contact> motion = start;
  for (; motion.index() % ratio.denominator != 0; motion.advance()) motion.sense();
  return detail::ReturnSearch(detail::EventSearchModel<Contact>(motion, ratio), ratio, limits)
      .run();
}

/// The same where the ratio is not known yet: incommensurate where there is none.
template <class Contact>
EventOrbitResult<Contact> find_event_orbit(const EventMotion<Contact>& start,
                                           const OrbitLimits& limits = {}) {
  validate(limits);
  const std::optional<Rational> ratio = forcing_ratio(start.loop());
  if (!ratio) return {{OrbitOutcome::incommensurate, std::nullopt, 0, 0}, std::nullopt};
  return find_event_orbit(start, *ratio, limits);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template EventOrbitResult<DriveContact<>> find_event_orbit(
    const EventMotion<DriveContact<>>&, const Rational&, const OrbitLimits&);
#endif

}  // namespace holdfast
