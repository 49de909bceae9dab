#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "holdfast/chaos/chaos_indicators.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/neighbour_distance.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/return_search.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The classification of a motion with backlash, with its certified orbit or its indicators.
/// @tparam Search  OrbitResultOf<Orbit>, where Orbit is the type of the loop's periodic orbits
template <class Search>
struct ClassifiedMotion {
  Classification classification;  ///< kind of the motion and its reason
  /// Result of the search for a periodic orbit, with the orbit if one was found. The outcome
  /// `incommensurate` is also given under a recorded force or with sampling jitter.
  Search search;
  /// Indicators of the motion; for a certified orbit only its period and largest exponent.
  ChaosIndicators indicators;
};

/// The classification of a motion of an IdealLoop.
using SampledClassification = ClassifiedMotion<OrbitResult>;
/// The classification of a motion of an ImplementedLoop. @tparam States  N, the order of the plant
template <int States>
using EventClassificationOf = ClassifiedMotion<OrbitResultOf<EventOrbitOf<States>>>;
/// The classification of a motion of an ImplementedLoop with two masses.
using EventClassification = EventClassificationOf<4>;

namespace detail {

/// The reason text of a certified orbit; `shown` states what was verified about its contacts.
template <class Orbit>
std::string certificate_text(const Orbit& orbit, const std::string& shown) {
  const auto counted = [](std::int64_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::string text = "Certified orbit of " + counted(orbit.period_samples(), "sample");
  if (orbit.forcing_periods() > 0)
    text += ", " + counted(orbit.forcing_periods(), "forcing period");
  const double modulus = orbit.largest_multiplier();
  return text + ": " + shown + ", its largest multiplier is " +
         (modulus > 0.0 ? number_text(modulus)
                        : "exp(" + number_text(orbit.multipliers.front().log_modulus) + ")") +
         ", and its closure error is " + number_text(orbit.closure_error) + " (m, m/s).";
}

/// Classifies a motion by its orbit search, if that certified an orbit or saw the motion diverge.
/// @param shown   statement about the orbit's contacts, for certificate_text()
/// @return whether the search decided
template <class Search>
bool is_decided_by_search(ClassifiedMotion<Search>& found, const std::string& shown) {
  const bool certified = found.search.outcome == OrbitOutcome::certified;
  if (!certified && found.search.outcome != OrbitOutcome::diverges) return false;
  if (certified) {
    const auto& orbit = *found.search.orbit;
    const auto samples = static_cast<double>(orbit.period_samples());
    found.indicators.certified_period = orbit.period_samples();
    found.indicators.largest_exponent =
        ExponentEstimate{orbit.multipliers.front().log_modulus / samples, 0.0};
  } else {
    found.indicators.diverged_at = found.search.samples;
  }
  found.classification = classify(found.indicators);
  if (certified) found.classification.rests_on = certificate_text(*found.search.orbit, shown);
  return true;
}

/// The indicator options for a loop: some 1000 forcing periods for the 0–1 test, ≤ 10⁵ samples.
/// @param cycles  f τ, periods of the forcing per sample, > 0
inline IndicatorOptions indicator_options(double cycles) {
  IndicatorOptions options;
  const double samples_of_period = std::clamp(std::round(1.0 / cycles), 1.0, 200.0);
  options.zero_one_stride = static_cast<std::int64_t>(samples_of_period);
  options.samples = std::clamp<std::int64_t>(1008 * options.zero_one_stride, 20160, 100000);
  options.transient = options.samples;
  options.base_frequency = cycles;
  return options;
}

/// The indicators of a motion that switches at its samples, from its states [z; u_{j−1}].
/// @param engaged   set in each step: whether the drive transmits; read by `tangents`
/// @param tangents  as indicators_of_system() requires them
template <class Motion, class Tangents>
ChaosIndicators indicators_of_samples(Motion motion, const IndicatorOptions& options, bool& engaged,
                                      Tangents& tangents) {
  using Seen = Vector<double, 5>;
  const auto seen = [&] {
    Seen state;
    state << motion.state(), motion.memory().previous_force;
    return state;
  };
  const auto advance = [&](Seen& state) {
    engaged = motion.sense().engaged;
    motion.advance();
    state = seen();
  };
  ChaosIndicators indicators = indicators_of_system<5>(
      seen(), advance, [](const Seen& state) { return state[0]; }, options, tangents,
      [&] { return engaged; });
  if (!indicators.diverged_at) indicators.largest_exponent = largest_exponent(tangents.spectrum());
  return indicators;
}

template <class Scalar>
ChaosIndicators indicators_of_motion(const IdealLoop<Scalar>& loop,
                                     const HarmonicallyForcedMotion<Scalar>& motion,
                                     const IndicatorOptions& options) {
  const Matrix<double, 5> maps[] = {motion.loop().backlash_map(),
                                    motion.loop().engaged_map(loop.gains)};
  bool engaged = true;
  const TangentMaps<5>::OfState map = [&](const Vector<double, 5>&) {
    return maps[engaged ? 1 : 0];
  };
  TangentMaps<5> tangents(5, map);
  return indicators_of_samples(motion, options, engaged, tangents);
}

/// A motion with its tangent maps in the form that chaos_indicators() requires. The states are [x;
/// u_{j−1}; 0; 0]: the zeros make them as long as the deviations of VariationalFlow.
template <class Contact>
class TrajectoryWithTangent {
  static constexpr int size = VariationalFlow<Contact>::size;

 public:
  /// @param gap_counts  whether a deviation of the gap's position is part of the tangent
  TrajectoryWithTangent(const EventMotion<Contact>& start, bool gap_counts)
      : motion_(start), tangent_(motion_), gap_counts_(gap_counts) {}

  ChaosIndicators indicators(const IndicatorOptions& options) {
    using State = Vector<double, size>;
    const auto displacement = [this](const State& seen) {
      return motion_.readings().displacement(seen.head(motion_.state().size()));
    };
    return chaos_indicators<size>(
        state(), [this](State& after) { take(after); }, displacement, options,
        [this](const State&) { return map(); }, [this] { return engaged_; });
  }

  /// The index of the last sample at which the drive was outside its gap.
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

  EventMotion<Contact> motion_;
  VariationalFlow<Contact> tangent_;
  bool gap_counts_;
  bool engaged_ = true;
  std::int64_t last_engaged_ = 0;
};

/// The indicators of a motion with exact switching, from its samples.
/// @return nothing where changes of contact accumulate
template <class Contact>
std::optional<ChaosIndicators> indicators_of_motion(const EventMotion<Contact>& start,
                                                    const IndicatorOptions& options) {
  TrajectoryWithTangent<Contact> motion(start, true);
  const ChaosIndicators indicators = motion.indicators(options);
  if (motion.accumulates()) return std::nullopt;
  if (indicators.diverged_at || motion.last_engaged() > options.transient) return indicators;
  // The place of a gap that is never left has no effect on the motion: without this it would add
  // a neutral direction to the tangent.
  return TrajectoryWithTangent<Contact>(start, false).indicators(options);
}

/// The first harmonic of positive amplitude, used to count periods; null if there is none.
inline const Harmonic* first_harmonic(const MultiHarmonicForce& force) {
  const auto first =
      std::find_if(force.harmonics.begin(), force.harmonics.end(),
                   [](const Harmonic& harmonic) { return harmonic.amplitude > 0.0; });
  return first == force.harmonics.end() ? nullptr : &*first;
}

/// The natural frequency (Hz) of a plant: for two masses √(k₁/m₁) / 2π of the conductor alone, else
/// that of the plant's first natural mode or, without any mode, the norm of its state matrix / 2π.
inline double own_frequency(const TwoMass<double>& plant) {
  const double own = std::sqrt(plant.conductor_stiffness / plant.conductor_mass);
  return own / (2.0 * pi<double>);
}
template <class Plant>
double own_frequency(const Plant& plant) {
  const auto modes = natural_modes(plant);
  if (!modes.empty()) return modes.front().frequency();
  return balanced_norm(plant.state_matrix()) / (2.0 * pi<double>);
}

/// The indicator options for a loop, from the frequency of its first harmonic or, without one, its
/// natural frequency. Under a recorded force the examination ends before the record.
/// @return nothing where the record has fewer than 4200 samples
template <class Plant>
std::optional<IndicatorOptions> indicator_options(const ImplementedLoopOf<Plant>& loop) {
  const Harmonic* const harmonic = first_harmonic(loop.digital.force);
  const double frequency = harmonic != nullptr ? harmonic->frequency : own_frequency(loop.plant);
  IndicatorOptions options = indicator_options(frequency * loop.digital.sampling.period);
  if (loop.digital.force.record == nullptr) return options;
  constexpr double fewest = 2100.0, parts = 210.0;  // whole parts: see IndicatorOptions::samples
  const double recorded = loop.digital.force.record->last_time() / loop.digital.sampling.period;
  if (!(recorded >= 2.0 * fewest)) return std::nullopt;
  const double half = parts * std::floor(recorded / (2.0 * parts));
  if (half >= static_cast<double>(options.samples)) return options;
  options.samples = options.transient = static_cast<std::int64_t>(half);
  options.zero_one_stride =
      std::clamp<std::int64_t>(options.zero_one_stride, 1, options.samples / 500);
  return options;
}

/// Further data of classify(): whether the motion is forced and may be sampled longer.
struct Weighing {
  bool is_forced;               ///< whether a harmonic force acts, whose periods are counted
  bool may_look_longer = true;  ///< whether to use more samples if the planned ones do not decide
};

/// Classifies a motion by the indicators of its samples. If they do not decide, the distance of a
/// neighbouring motion is added; if that does not decide, all is repeated with 99 960 samples.
/// @param start  the motion, before a sample
/// @param look   IndicatorOptions ↦ ChaosIndicators, nothing where the motion cannot be followed
/// @return whether the motion could be followed
template <class Search, class Motion, class Look>
bool classify(ClassifiedMotion<Search>& found, const Motion& start, IndicatorOptions options,
              const Weighing& criteria, const Look& look) {
  constexpr std::int64_t longest = 99960;  // whole parts: see IndicatorOptions::samples
  const std::optional<ChaosIndicators> indicators = look(options);
  if (!indicators) return false;
  found.indicators = *indicators;
  if (criteria.is_forced) {
    found.indicators.forcing_periods =
        options.base_frequency * static_cast<double>(options.samples);
  } else if (found.indicators.lines) {
    found.indicators.lines->division = 0;  // a frequency of the plant is no base of the motion
  }
  const bool is_open = Classifier(found.indicators).lacks_neighbour();
  if (is_open)
    found.indicators.neighbour = neighbour_distance(start, options.transient, options.samples);
  found.classification = classify(found.indicators);
  const bool is_left_open = is_open && found.classification.kind == AttractorType::undecided;
  if (!is_left_open || !criteria.may_look_longer || options.samples >= longest) return true;
  options.transient = options.samples = longest;
  return classify(found, start, options, criteria, look);
}

/// The classification of a motion that switches at samples, from the orbit on which it settles or,
/// without an orbit, from the indicators that `look` computes.
/// @tparam Loop  IdealLoop or ModalLoop
template <class Loop, class Motion, class Look>
SampledClassification classify_sampled(const Loop& loop, OrbitResult search, const Motion& motion,
                                       const Look& look) {
  SampledClassification found;
  found.search = std::move(search);
  if (is_decided_by_search(found, "it reproduces its own contacts")) return found;
  IndicatorOptions options = indicator_options(loop.excitation.frequency * loop.sampling.period);
  options.forcing_incommensurate = found.search.outcome == OrbitOutcome::incommensurate;
  const auto known = [&](const IndicatorOptions& plan) { return std::optional(look(plan)); };
  classify(found, motion, options, {loop.excitation.amplitude > 0.0}, known);
  return found;
}

template <class Plant, class Contact>
void weigh_samples(const ImplementedLoopOf<Plant>& loop, const EventMotion<Contact>& start,
                   EventClassificationOf<states_of<Plant>>& found) {
  const DigitalLoop& digital = loop.digital;
  std::optional<IndicatorOptions> options = indicator_options(loop);
  if (!options) {
    found.classification.rests_on =
        "The recorded force is too short: a verdict needs at least 4200 samples.";
    return;
  }
  // Neither forcing nor samples follow a rule that is known to repeat.
  const bool irregular = digital.force.record != nullptr || digital.jitter.half_width > 0.0;
  options->forcing_incommensurate =
      found.search.outcome == OrbitOutcome::incommensurate && !irregular;
  const Weighing criteria{first_harmonic(digital.force) != nullptr,
                          digital.force.record == nullptr};
  const auto look = [&start](const IndicatorOptions& plan) {
    return indicators_of_motion(start, plan);
  };
  if (!classify(found, start, *options, criteria, look)) {
    found.classification = {};
    found.classification.rests_on =
        "Changes of contact accumulate in one period: the motion cannot be computed further.";
    return;
  }
  if (irregular)
    found.classification =
        Classifier(found.indicators).classify_irregularly_forced(digital.jitter.half_width > 0.0);
}

}  // namespace detail

/// Classifies a motion of an IdealLoop by its orbit or, without one, by the rules of `classify`.
///
///     classify_motion(loop, Vector<double, 4>::Zero()).classification.kind;  // periodic
///
/// Work: that of find_periodic_orbit() and of chaos_indicators() for N ≤ 10⁵ samples. If undecided,
/// also neighbour_distance() with 3 N samples; if still undecided, both again with N = 99 960.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s), finite
/// @param limits         longest period (samples) and number of samples of the search for an orbit
/// @throws InvalidParameter where an argument is not admissible
template <class Scalar>
SampledClassification classify_motion(const IdealLoop<Scalar>& loop,
                                      const Vector<double, 4>& initial_state,
                                      const OrbitLimits& limits = {}) {
  OrbitResult search = find_periodic_orbit(loop, initial_state, limits);
  const auto motion = harmonically_forced_motion(loop, initial_state);
  return detail::classify_sampled(loop, std::move(search), motion,
                                  [&](const IndicatorOptions& plan) {
                                    return detail::indicators_of_motion(loop, motion, plan);
                                  });
}
/// Classifies a motion of an IdealLoop from an initial state given as any Eigen column vector.
template <class Scalar, class Column>
SampledClassification classify_motion(const IdealLoop<Scalar>& loop,
                                      const Eigen::MatrixBase<Column>& initial_state,
                                      const OrbitLimits& limits = {}) {
  const Vector<double, 4> state = detail::state_of(converted<double>(loop.plant), initial_state);
  return classify_motion(loop, state, limits);
}

/// Classifies a motion of an implemented loop by the orbit on which it settles or, without one, by
/// the rules of `classify` and these additional rules:
///
/// - Under a recorded force or with a jittering clock no orbit is searched for, and no motion is
///   classified as quasi-periodic. With jitter only rest is periodic. A negative exponent means
///   `irregular_contracting`: nearby motions converge under the same forcing.
/// - A recorded force of fewer than 4200 samples leaves the motion undecided.
/// - The motion is undecided if contact changes accumulate (SwitchCounts::accumulates).
///
/// Exponents and multipliers include the saltation matrices of contact changes. In them the
/// derivative of a quantised reading counts as zero.
/// Work: that of find_event_orbit() and of chaos_indicators() for up to 10⁵ samples.
/// @param loop           the loop with its sensors, computer, drive, backlash and excitation
/// @param initial_state  x₀, N × 1, finite; for two masses [z₁, ż₁, z₂, ż₂] (m, m/s)
/// @param limits         longest period (samples) and number of samples of the search for an orbit
/// @throws InvalidParameter where an argument is not admissible
/// @tparam Plant  TwoMass<double>, a LinearPlant<double, N> or a ControlledPlant
template <class Plant>
EventClassificationOf<states_of<Plant>> classify_motion(const ImplementedLoopOf<Plant>& loop,
                                                        const StateOf<Plant>& initial_state,
                                                        const OrbitLimits& limits = {}) {
  validate(limits);
  const auto motion = event_motion(loop, initial_state);
  EventClassificationOf<states_of<Plant>> found;
  auto search = find_event_orbit(motion, limits);
  found.search = {search.outcome, std::move(search.orbit), search.samples, search.candidates,
                  search.neutral_state};
  if (detail::is_decided_by_search(found, "its contact changes agree in three successive periods"))
    return found;
  detail::weigh_samples(loop, motion, found);
  if (found.search.outcome == OrbitOutcome::neutral)
    found.classification.rests_on +=
        " A multiplier is 1: a deviation of state variable " +
        std::to_string(*found.search.neutral_state + 1) +
        " does not decay, so the motion is one of a continuum of motions.";
  return found;
}
/// Classifies a motion of an implemented loop from an initial state given as any Eigen column.
template <class Plant, class Column>
EventClassificationOf<states_of<Plant>> classify_motion(
    const ImplementedLoopOf<Plant>& loop, const Eigen::MatrixBase<Column>& initial_state,
    const OrbitLimits& limits = {}) {
  return classify_motion(loop, detail::state_of(loop.plant, initial_state), limits);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledClassification classify_motion(const IdealLoop<double>&,
                                                      const Vector<double, 4>&, const OrbitLimits&);
extern template EventClassification classify_motion(const ImplementedLoop&,
                                                    const Vector<double, 4>&, const OrbitLimits&);
extern template EventClassificationOf<Eigen::Dynamic> classify_motion(
    const ImplementedLoopOf<ControlledPlant>&, const Vector<double, Eigen::Dynamic>&,
    const OrbitLimits&);
#endif

}  // namespace holdfast
