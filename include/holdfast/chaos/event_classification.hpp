#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
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
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// What a search for the periodic orbit of a RealLoop's motion found, whatever its contact.
/// @tparam States  N, the order of the plant
template <int States>
struct HybridSearchOf {
  /// How the search ended; `incommensurate` also under a recorded force or where samples stray.
  OrbitOutcome outcome = OrbitOutcome::none_found;
  std::optional<HybridOrbitOf<States>> orbit;  ///< as in HybridOrbitResult
  std::int64_t samples = 0;                    ///< of the motion that was looked at
  int candidates = 0;                          ///< returns that were solved for
};

/// That of the two masses.
using HybridSearch = HybridSearchOf<4>;

/// What a motion of a RealLoop is, with its certificate or the evidence.
/// @tparam States  N, the order of the plant
template <int States>
struct HybridVerdictOf {
  Verdict verdict;                ///< what the motion is, and what that rests on
  HybridSearchOf<States> search;  ///< the orbit, where there is one
  MotionEvidence evidence;        ///< of a certified orbit its period and its exponent alone
};

/// That of the two masses.
using HybridVerdict = HybridVerdictOf<4>;

namespace detail {

/// A motion seen by gather_evidence(): states [x; u_{j−1}; 0; 0], as those of the evidence of a
/// ForcedLoop with room for the tangent of HybridTangent.
template <class Contact>
class WitnessedMotion {
  static constexpr int size = HybridTangent<Contact>::size;

 public:
  /// @param gap_counts  whether a deviation of the gap is one of the motion
  WitnessedMotion(const HybridMotion<Contact>& start, bool gap_counts)
      : motion_(start), tangent_(motion_), gap_counts_(gap_counts) {}

  /// The types of the callables are the same for every contact, so that gather_evidence() is
  /// compiled once.
  MotionEvidence evidence(const EvidencePlan& plan) {
    using State = Vector<double, size>;
    const std::function<void(State&)> advance = [this](State& state) { take(state); };
    const std::function<double(const State&)> displacement = [this](const State& s) {
      return motion_.readings().displacement(s.head(motion_.state().size()));
    };
    const std::function<Matrix<double, size>(const State&)> tangent = [this](const State&) {
      return map();
    };
    const std::function<bool()> contact = [this] { return engaged_; };
    return gather_evidence<size>(state(), advance, displacement, plan, tangent, contact);
  }

  /// The sample since which the drive has not left its gap.
  std::int64_t last_engaged() const { return last_engaged_; }
  bool accumulates() const { return motion_.counts().accumulates; }

 private:
  Vector<double, size> state() const {
    Vector<double, size> state(motion_.state().size() + 3);
    state << motion_.state(), motion_.previous_command(), 0.0, 0.0;
    return state;
  }

  void take(Vector<double, size>& after) {
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

  Matrix<double, size> map() const {
    const Eigen::Index gap = motion_.state().size() + 1;
    Matrix<double, size> map = tangent_.map();
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

/// The frequency (Hz) at which a plant swings by itself: the conductor's own of the two masses,
/// that of the slowest mode of another one; without any, its fastest rate.
inline double own_frequency(const TwoDof<double>& plant) {
  const double own = std::sqrt(plant.conductor_stiffness / plant.conductor_mass);
  return own / (2.0 * pi<double>);
}
template <class Plant>
double own_frequency(const Plant& plant) {
  const auto modes = natural_modes(plant);
  if (!modes.empty()) return modes.front().frequency();
  return balanced_norm(plant.state_matrix()) / (2.0 * pi<double>);
}

/// The plan for a loop, by its first harmonic or else by its own frequency. A recorded force is not
/// outlived by it.
/// @return nothing where the record ends before enough samples
template <class Plant>
std::optional<EvidencePlan> evidence_plan(const RealLoopOf<Plant>& loop) {
  const Harmonic* const harmonic = first_harmonic(loop.digital.force);
  const double frequency = harmonic != nullptr ? harmonic->frequency : own_frequency(loop.plant);
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

inline Verdict undecided_since(const std::string& why) { return {MotionKind::undecided, 0, why}; }

/// The verdict of a motion by its samples.
template <class Plant, class Contact>
void weigh_samples(const RealLoopOf<Plant>& loop, const HybridMotion<Contact>& start,
                   HybridVerdictOf<states_of<Plant>>& found) {
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
/// @param initial_state  x₀, N × 1, finite; of the two masses [z₁, ż₁, z₂, ż₂] (m, m/s)
/// @param limits         of the search for an orbit
/// Work: that of find_hybrid_orbit() and of gather_evidence() for up to 10⁵ samples.
/// @throws InvalidParameter where one of them is not admissible
/// @tparam Plant  TwoDof<double> or a LinearPlant<double, N>
template <class Plant>
HybridVerdictOf<states_of<Plant>> classify_motion(const RealLoopOf<Plant>& loop,
                                                  const StateOf<Plant>& initial_state,
                                                  const OrbitLimits& limits = {}) {
  validate(loop);
  validate(limits);
  require_finite("initial state", initial_state.sum(), "");
  return with_motion(loop, initial_state, [&](const auto& motion) {
    auto search = find_hybrid_orbit(motion, limits);
    HybridVerdictOf<states_of<Plant>> found{
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
