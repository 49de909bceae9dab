#include "holdfast/contact/contact.hpp"
#include "motion/event/kollar_event.hpp"
#include "motion/event/slow_flow.hpp"

namespace holdfast {
namespace {

using test::BacklashMotion;
using test::kollar_digital;
using test::kollar_motion;
using test::move_samples;
using test::SlowFlow;
using test::SwitchNotes;

/// The rule of the paper, asked at every sub-step of a sampling period: two modes, no stick.
class AskedRule {
 public:
  explicit AskedRule(double width) : width_(width) {}

  bool engaged(double displacement, double velocity) {
    const double before = std::exchange(velocity_, velocity);
    if (inside_) {
      inside_ = displacement >= lower_ && displacement <= upper_;
    } else if (before != 0.0 && before * velocity <= 0.0) {
      inside_ = true;
      entries += 1;
      lower_ = before > 0.0 ? displacement - width_ : displacement;
      upper_ = lower_ + width_;
    }
    return !inside_;
  }

  int entries = 0;

 private:
  double width_, velocity_ = 0.0, lower_ = 0.0, upper_ = 0.0;
  bool inside_ = false;
};

/// The largest distance, at samples, of the motion by the asked rule from the exact one (in the
/// norm of the energy, over the largest norm of the exact motion).
double distance_of_asked_rule(const DigitalLoop& loop, double width, double duration, int parts,
                              int& entries) {
  const auto plant = kollar2022_plant();
  const EnergyNorm norm(plant);
  BacklashMotion exact = kollar_motion(loop, width);
  AskedRule rule(width);
  SlowFlow flow(plant, loop.force.harmonics);
  Vector<double, 4> state = Vector<double, 4>::Zero();
  double worst = 0.0, size = 0.0;
  const double part = loop.sampling.period / parts;
  while (exact.time() < duration) {
    worst = std::max(worst, norm(state - exact.state()));
    size = std::max(size, norm(exact.state()));
    const double command = loop.gains.proportional * state[0] + loop.gains.differential * state[1];
    for (int k = 0; k < parts; ++k) {
      const bool engaged = rule.engaged(relative_displacement(state), relative_velocity(state));
      state = flow.moved(engaged ? 0 : 1, state, command, exact.time() + k * part, part);
    }
    move_samples(exact, 1);
  }
  entries = rule.entries;
  return worst / size;
}

// A rule that is asked at sub-steps of the length s sees a reversal late by s at most, and at a
// sliding surface flickers across it with the same amplitude: the error is of first order in s,
// while the number of entries into the gap grows without limit.
TEST(EventMotion, TheRuleAskedEverMoreOftenConvergesToItAtFirstOrder) {
  for (const auto& [period, width] : {std::pair{0.001, 0.0005}, {0.001, 0.002}, {0.005, 0.001}}) {
    const DigitalLoop loop = kollar_digital(period);
    std::array<double, 4> errors{};
    std::array<int, 4> entries{};
    int parts = 10;
    for (std::size_t k = 0; k < 4; ++k, parts *= 10)
      errors[k] = distance_of_asked_rule(loop, width, 0.3, parts, entries[k]);
    std::cout << "τ = " << period << ", r0 = " << width << ":";
    for (std::size_t k = 0; k < 4; ++k)
      std::cout << "  " << errors[k] << " (" << entries[k] << " entries)";
    std::cout << '\n';
    const double order = std::log10(errors[0] / errors[3]) / 3.0;
    EXPECT_NEAR(order, 1.0, 0.15) << period << ", " << width;
    EXPECT_LT(errors[3], 1e-4);
    EXPECT_GT(entries[3], 50 * entries[0]) << "it flickers";
  }
}

// What sampling adds to the exact motion, over the first second from rest at instants common to all
// periods: root mean square in the norm of the energy, over that of the finest motion.
using CommonStates = std::vector<Vector<double, 4>>;

template <class Motion>
CommonStates states_every_4_ms(Motion motion, double period) {
  CommonStates states;
  const int apart = static_cast<int>(std::lround(0.004 / period));
  for (int k = 0; k < 250; ++k) {
    move_samples(motion, apart);
    states.push_back(motion.state());
  }
  return states;
}

double mean_distance(const CommonStates& one, const CommonStates& other) {
  const EnergyNorm norm(kollar2022_plant());
  double sum = 0.0, size = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    sum += std::pow(norm(one[k] - other[k]), 2);
    size += std::pow(norm(other[k]), 2);
  }
  return std::sqrt(sum / size);
}

/// Slope of log(error) over log(period), the periods being halved from one to the next.
double order_by_halving(const std::vector<double>& errors) {
  const auto count = static_cast<double>(errors.size());
  double mean = 0.0, covariance = 0.0, variance = 0.0;
  for (const double error : errors) mean += std::log2(error) / count;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double place = static_cast<double>(k) - 0.5 * (count - 1.0);
    covariance -= place * (std::log2(errors[k]) - mean);
    variance += place * place;
  }
  return covariance / variance;
}

CommonStates exactly_switched(double period, double width) {
  return states_every_4_ms(kollar_motion(kollar_digital(period), width), period);
}

CommonStates switched_at_samples(double period, double width) {
  const IdealLoop<double> loop{kollar2022_plant(), {period, 0.0}, {-557.0, -13.0},
                               {0.5, 10.0},        width,         ForceHold::exact};
  return states_every_4_ms(harmonically_forced_motion(loop, Vector<double, 4>::Zero().eval()),
                           period);
}

// Both motions have the same sampled control. What differs is the contact: at samples a reversal is
// seen late by up to τ, the end of a gap is passed by up to |Δż| τ, and a stick is a flicker
// between no force and the command, whose mean over a few samples is the sliding force. Each
// changes the impulse of a half cycle by O(τ) and the motion by as much: first order. Where within
// a period a reversal falls is a matter of chance, so that the errors scatter about their line.
TEST(EventMotion, SwitchingAtSamplesConvergesToItAtFirstOrder) {
  for (const double width : {0.0005, 0.002}) {
    std::vector<double> errors;
    for (const double period : {0.004, 0.002, 0.001, 0.0005, 0.00025, 0.000125})
      errors.push_back(
          mean_distance(switched_at_samples(period, width), exactly_switched(period, width)));
    const double order = order_by_halving(errors);
    std::cout << "r0 = " << width << ": errors";
    for (const double error : errors) std::cout << ' ' << error;
    std::cout << ", order " << order << '\n';
    EXPECT_NEAR(order, 1.0, 0.25) << width;
    EXPECT_LT(errors.back(), 0.05 * errors.front());
  }
}

// With exact switching the one thing that depends on τ is the command: held over [t_j, t_j + τ) it
// is old by τ/2 in the mean, which is a delay, of first order in τ.
TEST(EventMotion, ExactSwitchingConvergesWithTheSamplingPeriodAtFirstOrder) {
  for (const double width : {0.0005, 0.002}) {
    std::vector<double> errors;
    CommonStates coarse = exactly_switched(0.002, width);
    for (const double period : {0.001, 0.0005, 0.00025, 0.000125, 0.0000625}) {
      const CommonStates fine = exactly_switched(period, width);
      errors.push_back(mean_distance(coarse, fine));
      coarse = fine;
    }
    const double order = order_by_halving(errors);
    std::cout << "r0 = " << width << ": from " << errors.front() << " to " << errors.back()
              << ", order " << order << '\n';
    EXPECT_NEAR(order, 1.0, 0.12) << width;
  }
}

// As r₀ → 0 the drive still sticks where the spring pushes on and the command turns back: the
// motion has a limit, which is not that of a drive without backlash. A gap that begins where a
// stick ends, v = v̇ = 0, is crossed in a time ∝ r₀^(1/3), and so the limit is approached.
TEST(EventMotion, ANarrowBacklashHasALimitThatSticks) {
  std::vector<double> distances;
  CommonStates wider = exactly_switched(0.001, 1e-4);
  for (const double width : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    const CommonStates narrower = exactly_switched(0.001, width);
    distances.push_back(mean_distance(wider, narrower));
    wider = narrower;
  }
  const double order = std::log10(distances.front() / distances.back()) / 4.0;
  EXPECT_NEAR(order, 1.0 / 3.0, 0.04);
  EXPECT_GT(mean_distance(wider, exactly_switched(0.001, 0.0)), 10.0 * distances.back());
}

// Without limit the paper's rule flickers; the exact law makes one phase of each mode in a half
// cycle of the force.
TEST(EventMotion, AHalfCycleHasOnePhaseOfEachMode) {
  for (const auto& [period, width] : {std::pair{0.001, 0.0005}, {0.005, 0.001}}) {
    BacklashMotion motion = kollar_motion(kollar_digital(period), width);
    SwitchNotes notes(motion);
    notes.move(static_cast<int>(std::lround(3.0 / period)));
    for (const std::int64_t entered : motion.counts().entered) {
      EXPECT_GE(entered, 59);
      EXPECT_LE(entered, 61);
    }
    for (std::size_t k = 0; k < notes.switches.size(); ++k) {
      const int after[] = {2, 0, 1};  // engaged → stick → gap → engaged
      EXPECT_EQ(notes.switches[k].to, after[notes.switches[k].from]) << k;
    }
    EXPECT_EQ(motion.counts().grazing, 0);
  }
}

}  // namespace
}  // namespace holdfast
