#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "holdfast/chaos/chaos_indicators.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/sampled_classification.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/real_loop.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast {

/// What a search for the periodic orbit of a RealLoop's motion found, whatever its contact.
struct HybridSearch {
  /// How the search ended; `incommensurate` also under a recorded force or where samples stray.
  OrbitOutcome outcome = OrbitOutcome::none_found;
  std::optional<HybridOrbit> orbit;  ///< as in HybridOrbitResult
  std::int64_t samples = 0;          ///< of the motion that was looked at
  int candidates = 0;                ///< returns that were solved for
};

/// What a motion of a RealLoop is, with its certificate or the evidence.
struct HybridVerdict {
  Verdict verdict;          ///< what the motion is, and what that rests on
  HybridSearch search;      ///< the orbit, where there is one
  MotionEvidence evidence;  ///< of a certified orbit its period and its exponent alone
};

namespace detail {

/// A motion seen by gather_evidence(): states [z; u_{j−1}; 0; 0], as those of the evidence of a
/// ForcedLoop with room for the tangent of HybridTangent.
template <class Contact>
class WitnessedMotion {
 public:
  /// @param gap_counts  whether a deviation of the gap is one of the motion
  WitnessedMotion(const HybridMotion<Contact>& start, bool gap_counts)
      : motion_(start), tangent_(motion_), gap_counts_(gap_counts) {}

  /// The types of the callables are the same for every contact, so that gather_evidence() is
  /// compiled once.
  MotionEvidence evidence(const EvidencePlan& plan) {
    using State = Vector<double, 7>;
    const std::function<void(State&)> advance = [this](State& state) { take(state); };
    const std::function<double(const State&)> displacement = [](const State& s) { return s[0]; };
    const std::function<Matrix<double, 7>(const State&)> tangent = [this](const State&) {
      return map();
    };
    const std::function<bool()> contact = [this] { return engaged_; };
    return gather_evidence<7>(state(), advance, displacement, plan, tangent, contact);
  }

  /// The sample since which the drive has not left its gap.
  std::int64_t last_engaged() const { return last_engaged_; }
  bool accumulates() const { return motion_.counts().accumulates; }

 private:
  Vector<double, 7> state() const {
    Vector<double, 7> state;
    state << motion_.state(), motion_.previous_command(), 0.0, 0.0;
    return state;
  }

  void take(Vector<double, 7>& after) {
    const std::int64_t left = times_engaged();
    engaged_ = motion_.sense().engaged;
    tangent_.begin_sample(motion_);
    motion_.advance(tangent_);
    if (motion_.contact().word() != ContactMode::gap || times_engaged() != left)
      last_engaged_ = motion_.index();
    after = state();
  }

  std::int64_t times_engaged() const {
    return motion_.counts().entered[static_cast<std::size_t>(ContactMode::engaged)];
  }

  Matrix<double, 7> map() const {
    constexpr int gap = 5;
    Matrix<double, 7> map = tangent_.map();
    if (gap_counts_) return map;
    map.row(gap).setZero();
    map.col(gap).setZero();
    return map;
  }

  HybridMotion<Contact> motion_;
  HybridTangent<Contact> tangent_;
  bool gap_counts_;
  bool engaged_ = true;
  std::int64_t last_engaged_ = 0;
};

/// What the samples of a motion show.
/// @return nothing where its changes of contact accumulate
template <class Contact>
std::optional<MotionEvidence> evidence_of_motion(const HybridMotion<Contact>& start,
                                                 const EvidencePlan& plan) {
  WitnessedMotion<Contact> motion(start, true);
  const MotionEvidence evidence = motion.evidence(plan);
  if (motion.accumulates()) return std::nullopt;
  if (evidence.diverged_at || motion.last_engaged() > plan.transient) return evidence;
  // Where a gap lies that is never left is without effect: no direction of the motion, but a
  // neutral one of the tangent.
  return WitnessedMotion<Contact>(start, false).evidence(plan);
}

/// Whether neither forcing nor samples follow a rule that is known to repeat.
inline bool is_irregularly_forced(const DigitalLoop& loop) {
  return loop.force.record != nullptr || loop.jitter.half_width > 0.0;
}

/// The harmonic that motions are measured by; null without one.
inline const Harmonic* first_harmonic(const ComposedForce& force) {
  const auto first =
      std::find_if(force.harmonics.begin(), force.harmonics.end(),
                   [](const Harmonic& harmonic) { return harmonic.amplitude > 0.0; });
  return first == force.harmonics.end() ? nullptr : &*first;
}

/// The plan for a loop, by its first harmonic or else by the conductor's own frequency. A recorded
/// force is not outlived by it.
/// @return nothing where the record ends before enough samples
inline std::optional<EvidencePlan> evidence_plan(const RealLoop& loop) {
  const Harmonic* const harmonic = first_harmonic(loop.digital.force);
  const double own = std::sqrt(loop.plant.conductor_stiffness / loop.plant.conductor_mass);
  const double frequency = harmonic != nullptr ? harmonic->frequency : own / (2.0 * pi<double>);
  EvidencePlan plan = evidence_plan(frequency * loop.digital.sampling.period);
  if (loop.digital.force.record == nullptr) return plan;
  constexpr double fewest = 2100.0, parts = 210.0;  // whole parts: see EvidencePlan::samples
  const double recorded = loop.digital.force.record->last_time() / loop.digital.sampling.period;
  if (!(recorded >= 2.0 * fewest)) return std::nullopt;
  const double half = parts * std::floor(recorded / (2.0 * parts));
  if (half >= static_cast<double>(plan.samples)) return plan;
  plan.samples = plan.transient = static_cast<std::int64_t>(half);
  plan.zero_one_stride = std::clamp<std::int64_t>(plan.zero_one_stride, 1, plan.samples / 500);
  return plan;
}

/// Weighs the evidence of a motion under a recorded force, or with samples that stray.
///
/// Its spectrum, its 0–1 test and its repetitions are those of the forcing as much as its own, and
/// a forcing that does not repeat is no sum of incommensurate harmonics. So nothing is called
/// quasi-periodic. Divergence stands, and so does chaos, by an exponent above zero. Where the
/// samples stray nothing is called periodic but rest; a recurrence under a recorded force is one of
/// the series. Else an exponent below zero decides, whatever the rest: neighbours come together
/// under one and the same forcing, so that the motion follows it.
inline Verdict judge_irregularly_forced(const MotionEvidence& evidence, bool samples_stray) {
  Verdict verdict = judge(evidence);
  const bool repeats = verdict.kind == MotionKind::periodic;
  if (verdict.kind == MotionKind::diverges || verdict.kind == MotionKind::chaotic) return verdict;
  if (repeats && (!samples_stray || verdict.period == 1)) return verdict;
  if (evidence.forcing_periods && *evidence.forcing_periods < fewest_forcing_periods)
    return verdict;
  const EvidenceWords words(evidence);
  if (evidence.largest_exponent && evidence.largest_exponent->negative()) {
    return {MotionKind::irregular_contracting, 0,
            "Neighbours come together and follow a forcing or samples that do not repeat: " +
                words.all() + words.switching() + "."};
  }
  if (verdict.kind == MotionKind::undecided) return verdict;
  return undecided("The forcing or the samples do not repeat, and the exponent does not decide",
                   words);
}

inline Verdict undecided_since(const std::string& why) { return {MotionKind::undecided, 0, why}; }

/// The verdict of a motion by its samples.
template <class Contact>
void weigh_samples(const RealLoop& loop, const HybridMotion<Contact>& start, HybridVerdict& found) {
  const DigitalLoop& digital = loop.digital;
  std::optional<EvidencePlan> plan = evidence_plan(loop);
  if (!plan) {
    found.verdict =
        undecided_since("The recorded force ends before the samples that a verdict needs.");
    return;
  }
  const bool irregular = is_irregularly_forced(digital);
  plan->forcing_incommensurate = found.search.outcome == OrbitOutcome::incommensurate && !irregular;
  const std::optional<MotionEvidence> evidence = evidence_of_motion(start, *plan);
  if (!evidence) {
    found.verdict =
        undecided_since("Changes of contact accumulate: the motion cannot be followed further.");
    return;
  }
  found.evidence = *evidence;
  if (first_harmonic(digital.force) != nullptr)
    found.evidence.forcing_periods = plan->base_frequency * static_cast<double>(plan->samples);
  found.verdict = irregular
                      ? judge_irregularly_forced(found.evidence, digital.jitter.half_width > 0.0)
                      : judge(found.evidence);
}

}  // namespace detail

/// Says what a motion of a loop as it is built is: by the orbit that it comes to, or, where none is
/// found, by the evidence of its samples, with the saltation at every change of contact in the
/// tangent.
///
///     classify_motion(loop, Vector<double, 4>::Zero()).verdict.kind;   // MotionKind::periodic
///
/// The rules are those of `judge`. Three things are beyond a ForcedLoop:
///  - a recorded force or a clock that strays: no orbit is looked for, and nothing is called
///    quasi-periodic or, with such a clock, periodic, rest apart. An exponent below zero is
///    `irregular_contracting`: neighbours come together under one and the same forcing. The
///    evidence is of the samples before the record ends; undecided where those are fewer than 4200;
///  - a quantised measurement has no tangent at its steps: exponents and multipliers are those
///    between them;
///  - where changes of contact accumulate the verdict is undecided.
/// @param loop           as it is built
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s), finite
/// @param limits         of the search for an orbit
/// Work: that of find_hybrid_orbit() and of gather_evidence() for up to 10⁵ samples.
/// @throws InvalidParameter where one of them is not admissible
/// @tparam Loop  RealLoop; a template so that only who calls it compiles it
template <class Loop, std::enable_if_t<std::is_same_v<Loop, RealLoop>, int> = 0>
HybridVerdict classify_motion(const Loop& loop, const Vector<double, 4>& initial_state,
                              const OrbitLimits& limits = {}) {
  validate(loop);
  validate(limits);
  require_finite("initial state", initial_state.sum(), "");
  return with_motion(loop, initial_state, [&](const auto& motion) {
    auto search = find_hybrid_orbit(motion, limits);
    HybridVerdict found{
        {}, {search.outcome, std::move(search.orbit), search.samples, search.candidates}, {}};
    if (!detail::is_decided_by_search(found, "it switches alike in three successive periods"))
      detail::weigh_samples(loop, motion, found);
    return found;
  });
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template HybridVerdict classify_motion(const RealLoop&, const Vector<double, 4>&,
                                              const OrbitLimits&);
#endif

}  // namespace holdfast
