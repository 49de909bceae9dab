#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/proof/contracting_norms.hpp"
#include "holdfast/orbit/proof/enclosed_deviations.hpp"
#include "holdfast/orbit/proof/segment_of_loops.hpp"
#include "holdfast/orbit/proof/switching_tests.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

/// The outcome of the proof of an orbit.
enum class OrbitProofOutcome {
  proved,           ///< the orbit and all bounds of the proof are proved
  not_contracting,  ///< no norms found in which the maps contract: a multiplier may have |λ| ≥ 1
  other_contacts,   ///< the backlash law gives other contacts along the given states
  not_closed,       ///< one sample after a given state the motion is too far from the next one
  near_surface,     ///< a contact could not be decided: too near a switching surface
  no_ball,          ///< the periodic motion is proved, but no ball of attraction
};

/// An open interval (from, to).
struct OpenRange {
  double from = 0.0;                                    ///< lower end
  double to = std::numeric_limits<double>::infinity();  ///< upper end
};

/// The outcome of an orbit's proof, with the bounds that are proved.
struct ProvedBounds {
  OrbitProofOutcome outcome = OrbitProofOutcome::not_contracting;  ///< result of the proof
  /// Upper bound of the moduli of all Floquet multipliers of one period; < 1 where proved.
  double multiplier_bound = std::numeric_limits<double>::infinity();
  double displacement_error =
      std::numeric_limits<double>::infinity();  ///< error bound of z₁, z₂ (m)
  double velocity_error = std::numeric_limits<double>::infinity();  ///< error bound of ż₁, ż₂ (m/s)
};

/// The proof of a periodic motion of the sampled loop near the states of a computed orbit. If the
/// outcome is `proved`, the loop has exactly one periodic motion with the orbit's contacts. This
/// motion differs from the given states by at most the error bounds. Its multipliers have moduli ≤
/// `multiplier_bound`. All motions from the ball of attraction tend to it with the same contacts.
struct OrbitProof : ProvedBounds {
  /// Surface, sample and distance of the least certain contact decision (least `decided_by`).
  Border nearest;
  /// Ratio of the distance `nearest` to its error bound; > 1 if proved.
  double decided_by = std::numeric_limits<double>::infinity();
  /// Range of backlash widths r₀ (m) for which the otherwise unchanged loop has the same motion.
  /// For an orbit that stays in its gap: widths of a gap that can contain the orbit.
  OpenRange widths;
  /// Radius (m) of the ball of attraction about the first given state, in the norm and weights of
  /// AttractionBall; ∞ without backlash. If the orbit stays in its gap, so do motions in the ball.
  double radius = 0.0;
};

namespace detail {

/// Rejects a loop whose f τ differs from the fraction p/q by more than rounding.
inline void validate_ratio(const IdealLoop<double>& loop, const Rational& ratio) {
  if (!(loop.excitation.amplitude > 0.0)) return;
  const Enclosure cycles = Enclosure::of_decimal(loop.excitation.frequency) *
                           Enclosure::of_decimal(loop.sampling.period);
  if (!(cycles * Enclosure(static_cast<double>(ratio.denominator)))
           .contains(static_cast<double>(ratio.numerator)))
    throw InvalidParameter("f tau", cycles.middle(), "",
                           "equal to p/q of the orbit within the rounding of f and tau");
}

/// Rejects an orbit whose length is no multiple of q, or a loop whose f τ is not the orbit's p/q.
inline void validate_proposal(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const std::int64_t samples = orbit.period_samples(), q = orbit.ratio.denominator;
  const bool is_whole = samples > 0 && q > 0 && samples % q == 0;
  if (!is_whole || orbit.itinerary.size() != orbit.states.size() || orbit.multipliers.empty())
    throw InvalidParameter(
        "samples of the orbit", static_cast<double>(samples), "",
        "a multiple of q (f tau = p/q); the orbit must have a contact per sample and multipliers");
  validate_ratio(loop, orbit.ratio);
}

/// The prover of one orbit. States are in plant_scaling() units.
template <class Number>
class OrbitProver {
 public:
  /// @param first, last  proposed states z̃_j of the orbit of the loop at either end of the segment
  /// @param orbit        orbit of a loop between both ends
  OrbitProver(const SegmentOfLoops<Number>& loops, const PeriodicOrbit& orbit,
              const std::vector<Vector<double, 5>>& first,
              const std::vector<Vector<double, 5>>& last)
      : loops_(loops),
        orbit_(orbit),
        pattern_(switching_pattern(orbit.states,
                                   Backlash<double>(loops.width().centre.middle(), orbit.memory))) {
    const Vector<double, 5> per_unit = loops.units().cwiseInverse();
    for (std::size_t j = 0; j < orbit.states.size(); ++j)
      states_.push_back({(0.5 * (first[j] + last[j])).cwiseProduct(per_unit),
                         (last[j] - first[j]).cwiseProduct(per_unit)});
  }

  /// Proves that every loop of the segment has the orbit, and bounds the error of its states.
  OrbitProof prove(double largest_miss) {
    proof_.outcome = OrbitProofOutcome::not_contracting;
    norms_ = ContractingNorms<5>::of(loops_.ends(), orbit_.itinerary,
                                     orbit_.multipliers.front().log_modulus);
    if (!norms_) return proof_;
    proof_.multiplier_bound = norms_->contraction();
    proof_.outcome = OrbitProofOutcome::other_contacts;
    if (!has_itinerary(pattern_, orbit_.itinerary)) return proof_;
    const double missed = enclose();
    proof_.outcome = OrbitProofOutcome::not_closed;
    if (!(missed <= largest_miss)) return proof_;
    proof_.outcome = decide() ? OrbitProofOutcome::proved : OrbitProofOutcome::near_surface;
    return proof_;
  }

  /// Proves the orbit of a single loop and its ball of attraction.
  /// @param weights  deviation_weights(); the last one is 1
  OrbitProof prove_with_ball(const Vector<double, 6>& weights, double largest_miss) {
    if (prove(largest_miss).outcome == OrbitProofOutcome::proved && !attract(weights))
      proof_.outcome = OrbitProofOutcome::no_ball;
    return proof_;
  }

 private:
  using State = typename SegmentOfLoops<Number>::State;

  std::size_t samples() const { return states_.size(); }
  std::size_t after(std::size_t sample) const { return sample + 1 == samples() ? 0 : sample + 1; }
  std::size_t wrapped(std::int64_t sample) const {
    const std::int64_t count = orbit_.period_samples();
    return static_cast<std::size_t>((sample % count + count) % count);
  }

  /// The difference of a proposed state's image from the next proposed state, on the whole segment.
  /// It is quadratic in the position s along the segment, since maps and states are linear in s.
  State missed_at(std::size_t sample) const {
    const auto& map = loops_.map(orbit_.itinerary[sample]);
    const auto addition = loops_.addition(sample);
    const AlongSegment<Vector<double, 5>>& from = states_[sample];
    const AlongSegment<Vector<double, 5>>& to = states_[after(sample)];
    const State centre = from.centre.template cast<Number>(),
                slope = from.slope.template cast<Number>();
    const State constant =
        map.centre * centre + addition.centre - to.centre.template cast<Number>();
    const State linear = (map.slope * centre).eval() + map.centre * slope + addition.slope -
                         to.slope.template cast<Number>();
    const State quadratic = map.slope * slope;
    const Number s = SegmentOfLoops<Number>::position();
    return constant + linear * s + quadratic * square(s);
  }

  /// Bounds the distance of the motion from the proposed states, in the norms. The differences of
  /// images from proposed states are summed over a period, each contracted by the maps that follow.
  /// @return the largest of these differences, as a share of the states' extent
  double enclose() {
    const StateScale extent(orbit_.states);
    double largest = 0.0;
    std::vector<Number> missed(samples());
    Number around;
    const auto carried = [&](const Number& error, std::size_t j) {
      return Number((Number(norms_->factor(j)) * error + missed[j]).upper());
    };
    for (std::size_t j = 0; j < samples(); ++j) {
      const State miss = missed_at(j);
      keep_most(largest, extent.share_of(as_doubles(miss)));
      missed[j] = norms_->size(after(j), miss);
      around = carried(around, j);
    }
    Number error = around / (Number(1.0) - Number(norms_->contraction()));
    first_error_ = Number(error.upper());
    proof_.displacement_error = proof_.velocity_error = 0.0;
    for (std::size_t j = 0; j < samples(); ++j) {
      const auto most = [&](const RowVector<double, 5>& row) {
        return (error * Number(norms_->reading(j, row))).upper();
      };
      errors_.push_back({most(relative_row(false)), most(relative_row(true))});
      for (const Eigen::Index i : {0, 2}) {
        keep_most(proof_.displacement_error, most(RowVector<double, 5>::Unit(i)));
        keep_most(proof_.velocity_error,
                  most(RowVector<double, 5>::Unit(i + 1)) * loops_.units()[1]);
      }
      error = carried(error, j);
    }
    return largest;
  }
  /// Upper bounds of the moduli of the entries, in SI units.
  Vector<double, 5> as_doubles(const State& state) const {
    return state.unaryExpr([](const Number& entry) { return entry.magnitude(); })
        .cwiseProduct(loops_.units());
  }
  static void keep_most(double& most, double value) { most = std::max(most, value); }

  /// The proposed Δz (m) or Δż (in the unit of ż) at a sample, without the error of the proposal.
  AlongSegment<Number> relative(std::size_t sample, bool of_velocity) const {
    const Eigen::Index first = of_velocity ? 1 : 0;
    const auto& [centre, slope] = states_[sample];
    return {Number(centre[2 + first]) - Number(centre[first]),
            Number(slope[2 + first]) - Number(slope[first])};
  }
  static Number over_segment(const AlongSegment<Number>& value) {
    return value.centre + value.slope * SegmentOfLoops<Number>::position();
  }
  static Number around_zero(double error) { return {-error, error}; }

  /// The left side of a test's inequality for a given r₀, in m (for Δż in the unit of ż).
  Number value_of(const SwitchingTest& test, const AlongSegment<Number>& width) const {
    const std::size_t here = wrapped(test.sample), entry = wrapped(test.entry);
    const Number sign(test.sign), widths(test.widths);
    const auto at = relative(here, test.is_of_velocity());
    if (test.is_of_velocity()) return sign * over_segment(at) + around_zero(errors_[here].velocity);
    const auto entered = relative(entry, false);
    const AlongSegment<Number> value{sign * (at.centre - entered.centre) + widths * width.centre,
                                     sign * (at.slope - entered.slope) + widths * width.slope};
    return over_segment(value) + around_zero(errors_[here].displacement) +
           around_zero(errors_[entry].displacement);
  }

  void note(const Number& value, SwitchingSurface surface, std::int64_t sample) {
    const double unit = surface == SwitchingSurface::reversal ? loops_.units()[1] : 1.0;
    const double decided_by = value.middle() / value.radius();
    if (!(decided_by < proof_.decided_by)) return;
    proof_.decided_by = decided_by;
    proof_.nearest = {value.middle() * unit, surface, sample};
  }

  bool is_engaged_throughout() const {
    const Itinerary& contacts = orbit_.itinerary;
    return std::all_of(contacts.begin(), contacts.end(), [](auto contact) { return contact != 0; });
  }

  /// Whether every contact is proved to equal the contact of the pattern.
  bool decide() {
    if (!loops_.has_backlash()) return is_engaged_throughout();
    if (pattern_.stays_inside()) return decide_inside();
    if (!enters_at_reversals(pattern_)) return false;
    tests_ = switching_tests(pattern_);
    bool all = over_segment(loops_.width()).is_positive();
    for (const SwitchingTest& test : tests_) {
      const Number value = value_of(test, loops_.width());
      note(value, test.surface, test.sample);
      all = all && value.is_positive();
      const Number rest = value_of(test, {});
      if (test.widths > 0) proof_.widths.from = std::max(proof_.widths.from, -rest.lower());
      if (test.widths < 0) proof_.widths.to = std::min(proof_.widths.to, rest.lower());
    }
    return all;
  }

  /// Whether the gap that the drive is in is proved to contain the orbit.
  bool decide_inside() {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, error = 0.0;
    std::size_t least = 0, most = 0;
    for (std::size_t j = 0; j < samples(); ++j) {
      const Number here = over_segment(relative(j, false)) + around_zero(errors_[j].displacement);
      if (here.lower() < lowest) lowest = here.lower(), least = j;
      if (here.upper() > highest) highest = here.upper(), most = j;
      keep_most(error, errors_[j].displacement);
    }
    proof_.widths.from = (Number(highest) - Number(lowest)).upper();
    const Number lower(pattern_.memory.lower);
    const double below = (Number(lowest) - lower).lower();
    const double above = (lower + over_segment(loops_.width()) - Number(highest)).lower();
    clearance_ = std::min(below, above);
    const bool is_below = below < above;
    proof_.nearest = {clearance_ + error,
                      is_below ? SwitchingSurface::gap_lower : SwitchingSurface::gap_upper,
                      static_cast<std::int64_t>(is_below ? least : most)};
    proof_.decided_by = (clearance_ + error) / error;
    return clearance_ > 0.0;
  }

  /// Finds the largest ball whose motions keep the contacts until they are nearer to the orbit than
  /// at the beginning, and therefore for ever.
  bool attract(const Vector<double, 6>& weights) {
    constexpr std::int64_t most_samples = 1'000'000;
    proof_.radius = std::numeric_limits<double>::infinity();
    if (!loops_.has_backlash()) return true;
    EnclosedDeviations<Number> deviations(*norms_, weights, loops_.units());
    const bool with_gap = !pattern_.stays_inside();
    double radius = proof_.radius;
    proof_.radius = 0.0;
    for (std::int64_t done = 0; done < most_samples; done += orbit_.period_samples()) {
      radius = std::min(radius, limit_over_period(deviations));
      if (!deviations.have_contracted(with_gap)) continue;
      proof_.radius = (Number(radius) - distance_of_start(weights)).lower();
      return proof_.radius > 0.0;
    }
    return false;
  }

  /// An upper bound of the distance of the motion's first state and gap from the given ones (m).
  Number distance_of_start(const Vector<double, 6>& weights) const {
    Number distance;
    for (Eigen::Index i = 0; i < 5; ++i)
      distance += Number(weights[i]) * Number(loops_.units()[i]) * first_error_ *
                  Number(norms_->reading(0, RowVector<double, 5>::Unit(i)));
    if (pattern_.stays_inside() || !pattern_.decisions.front().was_inside) return distance;
    const auto test = std::find_if(tests_.begin(), tests_.end(),
                                   [](const auto& one) { return !one.is_of_velocity(); });
    const std::size_t entry = wrapped(test->entry);
    // Entered with Δż > 0, the gap lies below Δz.
    const bool from_positive =
        (test->surface == SwitchingSurface::gap_lower) == (test->widths != 0);
    const Number entered = over_segment(relative(entry, false));
    const Number lower = from_positive ? entered - over_segment(loops_.width()) : entered;
    return distance + abs(lower - Number(pattern_.memory.lower)) +
           Number(errors_[entry].displacement);
  }

  /// The largest initial deviation for which all tests of one more period are true.
  double limit_over_period(EnclosedDeviations<Number>& deviations) const {
    double limit = std::numeric_limits<double>::infinity();
    auto test = tests_.begin();
    for (std::size_t j = 0; j < samples(); ++j) {
      for (; test != tests_.end() && wrapped(test->sample) == j; ++test) {
        RowWithError row = deviations.relative(j, test->is_of_velocity());
        if (!test->is_of_velocity()) row = row - deviations.gap();
        limit = std::min(limit, allowed(value_of(*test, loops_.width()).lower(), row));
      }
      if (pattern_.stays_inside())
        limit = std::min(limit, allowed(clearance_, deviations.relative(j, false)));
      deviations.advance(j, after(j), pattern_.decisions[j],
                         loops_.ends().front().at(orbit_.itinerary[j]));
    }
    return limit;
  }
  static double allowed(double distance, const RowWithError& row) {
    return (Number(distance) / row.length()).lower();
  }

  struct Errors {
    double displacement, velocity;  // of Δz (m) and of Δż (units)
  };

  const SegmentOfLoops<Number>& loops_;
  const PeriodicOrbit& orbit_;
  SwitchingPattern pattern_;
  std::vector<AlongSegment<Vector<double, 5>>> states_;  // proposed, in units
  std::optional<ContractingNorms<5>> norms_;
  std::vector<Errors> errors_;
  Number first_error_;  // of the first state, in its norm
  std::vector<SwitchingTest> tests_;
  double clearance_ = 0.0;  // of an orbit that stays inside (m)
  OrbitProof proof_;
};

}  // namespace detail

/// Proves that the sampled loop has a computed orbit; if no proof is found, the outcome states why.
/// The proof covers all loops whose numbers round to the given doubles, with f τ exactly p/q.
///
/// The maps of the sampling periods and the contributions of the force are enclosed in intervals.
/// The maps for the orbit's contacts are proved to contract (ContractingNorms); hence these maps
/// have exactly one periodic motion. Its distance from the given states is bounded by means of
/// their closure errors. Strict inequalities (SwitchingTest) then prove each contact. For the ball
/// of attraction, deviations are propagated until they are shorter than at the beginning.
/// @param loop           the loop, its numbers in doubles
/// @param orbit          the orbit to be proved: its states and contacts are used
/// @param largest_miss   largest allowed difference of the image of a given state one sample later
///                       from the next given state, relative to StateScale; else `not_closed`
/// @throws InvalidParameter where the loop is not admissible, its f τ is not the orbit's p/q, or
///         the orbit's number of samples is no multiple of q
/// Work: about 30 µs per sample of the orbit, and 20 µs per sample of propagated deviations.
template <class Scalar>
OrbitProof prove_orbit(const IdealLoop<Scalar>& loop, const PeriodicOrbit& orbit,
                       double largest_miss = 1e-12) {
  detail::validate_proposal(loop, orbit);
  const detail::SegmentOfLoops loops(enclosed(loop), orbit.ratio);
  return detail::OrbitProver(loops, orbit, orbit.states, orbit.states)
      .prove_with_ball(deviation_weights(loop), largest_miss);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class detail::OrbitProver<Enclosure>;
extern template OrbitProof prove_orbit(const IdealLoop<double>&, const PeriodicOrbit&, double);
#endif

}  // namespace holdfast
