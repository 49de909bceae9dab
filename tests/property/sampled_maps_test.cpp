// S and S* of a sampling period against Newton's laws, integrated over it in extended precision
// under the force that comes late: no matrix exponential is made on that road.

#include "holdfast/control/loop_input.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"

#include "property/loop_case.hpp"
#include "support/polynomial/hurwitz_conditions.hpp"

namespace holdfast {
namespace {

using test::LoopCase;
using test::Random;

/// The two masses over one sampling period by Taylor's series in steps shorter than anything that
/// happens in it.
class NewtonsLaws {
 public:
  using Real = long double;
  using State = std::array<Real, 4>;

  explicit NewtonsLaws(const LoopCase& drawn) : plant_(drawn.plant), drawn_(drawn) {
    const Vector<double, 4> factors = balancing<double, 4>(plant_.state_matrix());
    for (std::size_t i = 0; i < 4; ++i) unit_[i] = factors[static_cast<Eigen::Index>(i)];
    const Matrix<double, 4> balanced = BalancedMatrix<double, 4>(plant_.state_matrix()).balanced;
    fastest_ = balanced.cwiseAbs().rowwise().sum().maxCoeff();
  }

  /// ‖A‖ τ, balanced.
  double turns() const { return fastest_ * drawn_.period; }

  /// From z under `before` up to t_j + δ and `after` from then on, with the excitation or without.
  void pass(const State& from, Real before, Real after, bool excited) {
    state_ = from;
    largest_ = size();
    elapsed_ = 0;
    excited_ = excited;
    const Real delay = drawn_.sampling().processing_delay;
    flow(delay, before);
    flow(drawn_.period - delay, after);
  }

  const State& state() const { return state_; }
  /// Largest balanced size of the state on the way.
  double largest() const { return static_cast<double>(largest_); }
  double unit(std::size_t i) const { return static_cast<double>(unit_[i]); }

 private:
  static constexpr int terms = 26;

  Real size() const {
    Real result = 0;
    for (std::size_t i = 0; i < 4; ++i) result = std::max(result, std::abs(state_[i]) / unit_[i]);
    return result;
  }

  State rate_of(const State& z, Real transmitted, Real force) const {
    const TwoMass<double>& part = plant_;
    const Real between = Real(part.absorber_stiffness) * (z[2] - z[0]) +
                         Real(part.absorber_damping) * (z[3] - z[1]) + transmitted;
    const Real support =
        -Real(part.conductor_stiffness) * z[0] - Real(part.conductor_damping) * z[1] + force;
    return {z[1], (support + between) / Real(part.conductor_mass), z[3],
            -between / Real(part.absorber_mass)};
  }

  void flow(Real length, Real transmitted) {
    const Real omega = 2 * std::acos(Real(-1)) * drawn_.excitation.frequency;
    const int steps = 1 + static_cast<int>(length * (Real(fastest_) + omega));
    for (int step = 0; step < steps && length > 0; ++step) {
      expand(length / steps, transmitted, omega);
      largest_ = std::max(largest_, size());
    }
  }

  /// z ← Σ z_k, z_{k+1} = h/(k+1) (rate of z_k under the k-th coefficient of the force).
  void expand(Real h, Real transmitted, Real omega) {
    const bool exact = drawn_.hold() == ForceHold::exact;
    const Real phase = exact ? omega * elapsed_ : 0, turn = exact ? omega * h : 0;
    const Real amplitude = excited_ ? Real(drawn_.excitation.amplitude) : 0;
    Real present = amplitude * std::cos(phase), next = -turn * amplitude * std::sin(phase);
    State term = state_;
    for (int k = 0; k < terms; ++k) {
      term = rate_of(term, k == 0 ? transmitted : 0, present);
      for (std::size_t i = 0; i < 4; ++i) state_[i] += (term[i] *= h / (k + 1));
      const Real after_next = -turn * turn * present / ((k + 1) * (k + 2));
      present = next;
      next = after_next;
    }
    elapsed_ += h;
  }

  TwoMass<double> plant_;
  LoopCase drawn_;
  State unit_{};
  double fastest_;
  State state_{};
  Real largest_ = 0, elapsed_ = 0;
  bool excited_ = false;
};

/// z_{j+1} by the laws, and how far the maps may be from it.
struct Expected {
  Vector<double, 4> state = Vector<double, 4>::Zero();
  double size = 0.0;  // sum of what the parts come to on the way, balanced

  void add(const NewtonsLaws& laws) {
    for (int i = 0; i < 4; ++i)
      state[i] += static_cast<double>(laws.state()[static_cast<std::size_t>(i)]);
    size += laws.largest();
  }
};

test::PropertyOutcome maps_obey_newton(const LoopCase& drawn) {
  NewtonsLaws laws(drawn);
  // Beyond that the steps of the series take long, and every exponential has lost digits.
  if (laws.turns() > 200.0) return test::does_not_apply();
  const auto& z = drawn.state;
  const double previous = 0.5 * drawn.excitation.amplitude;
  const double command = drawn.gains.proportional * z[0] + drawn.gains.differential * z[1];
  Expected engaged, idle;
  laws.pass({z[0], z[1], z[2], z[3]}, 0, 0, false);
  engaged.add(laws);
  laws.pass({}, previous, 0, false);
  engaged.add(laws);
  laws.pass({}, 0, 0, true);
  engaged.add(laws);
  idle = engaged;
  laws.pass({}, 0, command, false);
  engaged.add(laws);

  const SampledLoop<double> loop = sampled_loop(drawn.plant, drawn.sampling());
  const HarmonicInput<double> input =
      harmonic_input(drawn.plant, loop, drawn.hold(), drawn.excitation.angular_frequency());
  Vector<double, 5> extended;
  extended << z, previous;
  const Vector<double, 4> forced = input.cosine * drawn.excitation.amplitude;
  const Vector<double, 5> with_force = loop.engaged_map(drawn.gains) * extended;
  const Vector<double, 5> in_backlash = loop.backlash_map() * extended;
  if (with_force[4] != command || in_backlash[4] != 0.0) return test::fails("the stored force");
  const double omega_turns = drawn.excitation.angular_frequency() * drawn.period;
  const double rounding =
      64.0 * std::numeric_limits<double>::epsilon() * (1.0 + laws.turns() + omega_turns);
  for (int i = 0; i < 4; ++i) {
    const double unit = laws.unit(static_cast<std::size_t>(i));
    if (!(std::abs(with_force[i] + forced[i] - engaged.state[i]) <= rounding * unit * engaged.size))
      return test::fails(test::differs("S, state " + std::to_string(i), with_force[i] + forced[i],
                                       engaged.state[i]));
    if (!(std::abs(in_backlash[i] + forced[i] - idle.state[i]) <= rounding * unit * idle.size))
      return test::fails(test::differs("S*, state " + std::to_string(i), in_backlash[i] + forced[i],
                                       idle.state[i]));
  }
  return test::holds();
}

TEST(SampledMaps, ObeyNewtonsLawsUnderALateForce) {
  test::expect_property(601, 2000, test::random_loop_case, maps_obey_newton, 0.75);
}

// Verdicts on the stability of the sampled loop are those of its roots in extended precision,
// unless a root lies so near to the unit circle that rounding decides.

bool any_contains(const std::vector<Interval<double>>& intervals, double value) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [value](const auto& interval) { return interval.contains(value); });
}

test::PropertyOutcome verdicts_agree(const LoopCase& drawn) {
  const test::Growth truth = test::growth(drawn.plant, drawn.sampling(), drawn.gains);
  if (!(std::abs(truth.excess) > 1e-9)) return test::does_not_apply();
  const bool stable = truth.excess < 0.0;
  const auto is_wrong = [&](const std::string& verdict) {
    return test::fails(verdict + (stable ? " calls it unstable, " : " calls it stable, ") +
                       test::differs("max |lambda| - 1", truth.excess, 0.0));
  };
  const SampledLoop<double> loop = sampled_loop(drawn.plant, drawn.sampling());
  const auto polynomial = characteristic_polynomial(loop);
  const auto in_mu = polynomial.at(drawn.gains);
  Polynomial<double, 5> in_w = in_half_plane<double, 6>(in_mu);
  if (in_w[5] < 0.0) in_w = -in_w;
  if (test::hurwitz_conditions<double, 6>(in_w).satisfied() != stable)
    return is_wrong("Routh-Hurwitz");
  if (is_hurwitz<double, 6>(in_w) != stable) return is_wrong("Lienard-Chipart");
  if ((spectral_radius<double, 5>(loop.engaged_map(drawn.gains)) < 1.0) != stable)
    return is_wrong("the spectral radius");
  const auto& [p, d] = drawn.gains;
  if (any_contains(stable_differential_gains(polynomial, p), d) != stable)
    return is_wrong("the stable intervals of D");
  if (any_contains(stable_proportional_gains(polynomial, d), p) != stable)
    return is_wrong("the stable intervals of P");
  return test::holds();
}

TEST(StabilityVerdicts, AgreeWithTheRoots) {
  test::expect_property(701, 2000, test::random_loop_case, verdicts_agree, 0.9);
}

/// A gain is moved to within 10⁻⁸ … 10⁻² of itself of an end of a stable interval.
LoopCase random_case_near_the_boundary(test::Random& random) {
  LoopCase drawn = test::random_loop_case(random);
  const auto polynomial = characteristic_polynomial(sampled_loop(drawn.plant, drawn.sampling()));
  const auto intervals = stable_differential_gains(polynomial, drawn.gains.proportional);
  if (intervals.empty()) return drawn;
  const auto& interval = intervals[random.index(intervals.size())];
  const double end = random.unit() < 0.5 ? interval.lower : interval.upper;
  if (!std::isfinite(end)) return drawn;
  drawn.gains.differential = end * (1.0 + random.sign() * random.log_uniform(1e-8, 1e-2));
  return drawn;
}

TEST(StabilityVerdicts, AgreeWithTheRootsNearTheBoundary) {
  test::expect_property(702, 2000, random_case_near_the_boundary, verdicts_agree, 0.5);
}

}  // namespace
}  // namespace holdfast
