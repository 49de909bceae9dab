// What the loop owes to being linear without backlash and to repeating with its force.

#include "holdfast/contact/contact_law.hpp"
#include "property/loop_case.hpp"
#include "support/move_samples.hpp"

namespace holdfast {
namespace {

using test::LoopCase;
using test::Random;

using LinearMotion = SampledMotion<double, NoBacklash<double>>;

LinearMotion linear_motion(const LoopCase& drawn, double amplitude,
                           const Vector<double, 4>& state) {
  const SampledLoop<double> loop = sampled_loop(drawn.plant, drawn.sampling());
  const double omega = drawn.excitation.angular_frequency();
  const HarmonicInput<double> input = harmonic_input(drawn.plant, loop, drawn.hold(), omega);
  return {loop, drawn.gains, input, {amplitude, drawn.excitation.frequency}, NoBacklash<double>(),
          state};
}

test::PropertyOutcome doubles_with_the_force(const LoopCase& drawn) {
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  LinearMotion once = linear_motion(drawn, drawn.excitation.amplitude, rest);
  LinearMotion twice = linear_motion(drawn, 2.0 * drawn.excitation.amplitude, rest);
  for (int j = 0; j < drawn.samples && test::is_moderate(once.state()); ++j) {
    const auto a = once.sense(), b = twice.sense();
    if (b.state != 2.0 * a.state || b.control_force != 2.0 * a.control_force)
      return test::fails(
          test::differs("sample " + std::to_string(j) + ", z1", b.state[0], 2.0 * a.state[0]));
    once.advance();
    twice.advance();
  }
  return test::holds();
}

TEST(Linearity, TwiceTheForceMovesTwiceAsFarToTheLastBit) {
  test::expect_property(201, 2000, test::random_loop_case, doubles_with_the_force);
}

/// How far rounding can have moved z̃ = [z; u] by a sample, balanced: what each sample rounds is
/// carried on by the powers of S,
///
///     e_j = Σ_i ‖S^{j−1−i}‖ ε n |S| |z̃_i|.
class RoundingBound {
 public:
  RoundingBound(const SampledLoop<double>& loop, const PdGains<double>& gains)
      : loop_(loop),
        gains_(gains),
        balanced_(loop.engaged_map(gains)),
        power_(Matrix<double, 5>::Identity()) {}

  /// Any error (m, m/s) that a state begins with or gets, absolute.
  void add(const Vector<double, 4>& error) {
    for (int i = 0; i < 4; ++i) local_ = std::max(local_, error[i] / balanced_.factors[i]);
  }

  /// A step from a state under the forces u_{j−1} and u_j and the excitation's addition.
  void add_step(const Vector<double, 4>& state, double previous_force,
                const Vector<double, 4>& addition) {
    const double command =
        std::abs(gains_.proportional * state[0]) + std::abs(gains_.differential * state[1]);
    const Vector<double, 4> size = loop_.transition.cwiseAbs() * state.cwiseAbs() +
                                   loop_.previous_force.cwiseAbs() * std::abs(previous_force) +
                                   loop_.present_force.cwiseAbs() * command + addition;
    add(unit_ * size);
    local_ = std::max(local_, unit_ * command / balanced_.factors[4]);
  }

  /// On to the next sample. @return the bound there, for each of [z₁, ż₁, z₂, ż₂]
  Vector<double, 4> next() {
    locals_.push_back(local_);
    local_ = 0.0;
    norms_.push_back(power_.cwiseAbs().rowwise().sum().maxCoeff());
    power_ = balanced_.balanced * power_;
    double sum = 0.0;
    for (std::size_t i = 0; i < locals_.size(); ++i)
      sum += locals_[i] * norms_[locals_.size() - 1 - i];
    return sum * balanced_.factors.head<4>();
  }

 private:
  static constexpr double unit_ = 16.0 * std::numeric_limits<double>::epsilon();
  SampledLoop<double> loop_;
  PdGains<double> gains_;
  BalancedMatrix<double, 5> balanced_;
  Matrix<double, 5> power_;
  std::vector<double> locals_, norms_;
  double local_ = 0.0;
};

/// What the excitation adds to a state at most, per newton.
Vector<double, 4> addition_per_newton(const LoopCase& drawn, const SampledLoop<double>& loop) {
  const double omega = drawn.excitation.angular_frequency();
  const auto input = harmonic_input(drawn.plant, loop, drawn.hold(), omega);
  return input.cosine.cwiseAbs() + input.sine.cwiseAbs();
}

test::PropertyOutcome differs_beyond(const std::string& where, const Vector<double, 4>& found,
                                     const Vector<double, 4>& expected,
                                     const Vector<double, 4>& bound) {
  for (int i = 0; i < 4; ++i) {
    if (std::abs(found[i] - expected[i]) <= bound[i]) continue;
    return test::fails(
        test::differs(where + ", state " + std::to_string(i), found[i], expected[i]) +
        test::differs(" with a rounding of", bound[i], 0.0));
  }
  return test::holds();
}

/// The motion from a sum of two states under the force is that from the first under the force and
/// that from the second without it.
test::PropertyOutcome superposes(const LoopCase& drawn) {
  const Vector<double, 4> first = drawn.state;
  const Vector<double, 4> second(0.7 * first[2], -1.3 * first[3], 0.4 * first[0], 0.9 * first[1]);
  const double amplitude = drawn.excitation.amplitude;
  LinearMotion motions[] = {linear_motion(drawn, amplitude, first),
                            linear_motion(drawn, 0.0, second),
                            linear_motion(drawn, amplitude, first + second)};
  const Vector<double, 4> addition = addition_per_newton(drawn, motions[0].loop()) * amplitude;
  RoundingBound bound(motions[0].loop(), drawn.gains);
  bound.add(std::numeric_limits<double>::epsilon() * (first + second).cwiseAbs());
  double previous[3] = {0.0, 0.0, 0.0};
  Vector<double, 4> rounding = std::numeric_limits<double>::epsilon() * (first + second).cwiseAbs();
  for (int j = 0; j < drawn.samples && test::is_moderate(motions[2].state()); ++j) {
    const auto outcome = differs_beyond("sample " + std::to_string(j), motions[2].state(),
                                        motions[0].state() + motions[1].state(), rounding);
    if (outcome.kind != test::PropertyOutcome::Kind::holds) return outcome;
    Vector<double, 4> states = Vector<double, 4>::Zero();
    double forces = 0.0;
    for (int which = 0; which < 3; ++which) {
      const auto sample = motions[which].sense();
      states += sample.state.cwiseAbs();
      forces += std::abs(previous[which]);
      previous[which] = sample.control_force;
      motions[which].advance();
    }
    bound.add_step(states, forces, 2.0 * addition);
    rounding = bound.next();
  }
  return test::holds();
}

TEST(Linearity, MotionsAddUp) {
  test::expect_property(202, 2000, test::random_loop_case, superposes);
}

/// A loop whose samples meet its force every q of them.
struct ShiftCase {
  LoopCase loop;
  int numerator = 1, denominator = 1;  // p and q, f τ = p/q up to common factors
  int common_periods = 0;              // by how many of them the motion is shifted

  std::vector<test::Parameter> parameters() {
    std::vector<test::Parameter> all = loop.parameters();
    all.insert(
        all.end(),
        {{"p", &numerator, 1.0}, {"q", &denominator, 1.0}, {"coincidences", &common_periods, 1.0}});
    return all;
  }

  LoopCase commensurate() const {
    LoopCase result = loop;
    result.excitation.frequency = numerator / (denominator * loop.period);
    return result;
  }
};

ShiftCase random_shift_case(Random& random) {
  ShiftCase drawn;
  drawn.loop = test::random_loop_case(random);
  drawn.loop.samples = 20 + static_cast<int>(random.index(60));
  drawn.denominator = 1 + static_cast<int>(random.index(60));
  drawn.numerator = 1 + static_cast<int>(random.index(80));
  drawn.common_periods = 1 + static_cast<int>(random.index(5));
  return drawn;
}

/// The motion from what it has come to after whole common periods is that from the same state at
/// the beginning, but for the rounding of f τ and of the phases.
test::PropertyOutcome repeats_with_the_force(const ShiftCase& shift) {
  if (shift.denominator < 1 || shift.numerator < 1) return test::does_not_apply();
  const LoopCase drawn = shift.commensurate();
  const auto late_by = static_cast<std::int64_t>(shift.denominator) * shift.common_periods;
  auto late = harmonically_forced_motion(drawn.loop(), drawn.state);
  test::move_samples(late, late_by);
  // The same state in both, and of moderate size whatever the loop has made of it.
  auto early = harmonically_forced_motion(drawn.loop(), drawn.state);
  late.restore(early.memory());
  const double turns = 2.0 * pi<double> * drawn.excitation.frequency * drawn.period *
                       static_cast<double>(late_by + drawn.samples);
  const double phase = 8.0 * std::numeric_limits<double>::epsilon() * (2.0 * pi<double> + turns);
  const Vector<double, 4> addition =
      addition_per_newton(drawn, early.loop()) * drawn.excitation.amplitude;
  RoundingBound bound(early.loop(), drawn.gains);
  Vector<double, 4> rounding = Vector<double, 4>::Zero();
  double previous = 0.0;
  for (int j = 0; j < drawn.samples && test::is_moderate(early.state()); ++j) {
    const auto outcome =
        differs_beyond("sample " + std::to_string(j), late.state(), early.state(), rounding);
    if (outcome.kind != test::PropertyOutcome::Kind::holds) return outcome;
    const auto here = early.sense(), there = late.sense();
    // In the backlash rounding may decide a switch, and the two part.
    if (here.engaged != there.engaged) return test::does_not_apply();
    bound.add(phase * addition);
    bound.add_step(2.0 * here.state, 2.0 * previous, 2.0 * addition);
    previous = here.control_force;
    rounding = bound.next();
    early.advance();
    late.advance();
  }
  return test::holds();
}

TEST(TimeShift, ByCommonPeriodsOfSamplesAndForceLeavesTheMotion) {
  test::expect_property(
      301, 2000,
      [](Random& random) {
        ShiftCase drawn = random_shift_case(random);
        drawn.loop.width = 0.0;
        return drawn;
      },
      repeats_with_the_force);
}

/// With q samples a period that is a power of two nothing is rounded, and the backlash may switch
/// as it likes.
test::PropertyOutcome repeats_to_the_last_bit(const ShiftCase& shift) {
  if (shift.denominator < 1 || shift.numerator < 1) return test::does_not_apply();
  ShiftCase binary = shift;
  binary.loop.period = std::exp2(std::round(std::log2(shift.loop.period)));
  binary.denominator = static_cast<int>(std::exp2(std::round(std::log2(shift.denominator))));
  const LoopCase drawn = binary.commensurate();
  auto early = harmonically_forced_motion(drawn.loop(), drawn.state);
  auto late = early;
  test::move_samples(late, binary.denominator * binary.common_periods);
  // Fresh phases every 16 samples: only a shift by whole blocks of them turns by the same table.
  const bool same_table = binary.denominator * binary.common_periods % 16 == 0;
  if (!same_table) return test::does_not_apply();
  late.restore(early.memory());
  for (int j = 0; j < drawn.samples && test::is_moderate(early.state()); ++j) {
    const auto here = early.sense(), there = late.sense();
    if (!test::same_sample(here, there))
      return test::fails(
          test::differs("sample " + std::to_string(j) + ", z1", there.state[0], here.state[0]));
    early.advance();
    late.advance();
  }
  return test::holds();
}

TEST(TimeShift, ByCommonPeriodsLeavesTheMotionInTheBacklashToTheLastBit) {
  test::expect_property(302, 2000, random_shift_case, repeats_to_the_last_bit, 1.0 / 3.0);
}

}  // namespace
}  // namespace holdfast
