// Metrics of many motions that differ in every parameter, as a sweep asks for them, on packs.
// Peers, one motion at a time with the same metrics: the library's stepper, a loop as a textbook
// has it on Eigen's dynamic matrices, and the step integrated by Boost.Odeint (where it is
// installed). Limit: independent multiply-adds, as many as the kernel has operations. All sides
// alternate in one run; the medians and their ratios are printed.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/simd/motion_metrics.hpp"
#include "holdfast/simd/parallel_rows.hpp"
#include "medians.hpp"
#include "processor.hpp"
#include "sweep_cells.hpp"
#if __has_include(<boost/numeric/odeint.hpp>)
#include <array>
#include <boost/numeric/odeint.hpp>
#endif

namespace {

using namespace holdfast;
using Pack = simd::Pack<double>;
constexpr std::size_t lanes = Lanes<Pack>::count;
constexpr double duration = 20.0;
constexpr std::size_t cells = 256;

volatile double sink = 0.0;

double samples_of(const std::vector<SweepMotion>& motions, std::size_t stride) {
  double sum = 0.0;
  for (std::size_t k = 0; k < motions.size(); k += stride)
    sum += static_cast<double>(samples_within(duration, motions[k].loop.sampling.period));
  return sum;
}

/// The metrics of one motion, sample by sample.
class Meter {
 public:
  void operator()(const MotionSample<double>& sample) {
    const double velocity = relative_velocity(sample.state);
    seen_.observe_extremum(sample.state[0]);
    seen_.observe_load(sample.control_force, relative_displacement(sample.state));
    if (not_before(sample.time, 0.5 * duration)) {
      seen_.observe_steady(sample.state[0], sample.control_force, sample.engaged,
                           is_reversal(before_, velocity));
    }
    before_ = velocity;
  }
  double sum() const {
    return seen_.first_peak + seen_.force_peak + (seen_.highest - seen_.lowest) +
           seen_.steady_peak + seen_.squares + seen_.force_squares + seen_.engaged +
           seen_.reversals;
  }

 private:
  MetricObserver<double> seen_;
  double before_ = 0.0;
};

template <class OneMotion>
void one_after_another(const std::vector<SweepMotion>& motions, std::size_t stride,
                       const OneMotion& one) {
  double sum = 0.0;
  for (std::size_t k = 0; k < motions.size(); k += stride) {
    Meter meter;
    one(motions[k], samples_within(duration, motions[k].loop.sampling.period), meter);
    sum += meter.sum();
  }
  sink = sum;
}

void by_stepper(const SweepMotion& motion, std::int64_t samples, Meter& meter) {
  auto stepper = harmonically_forced_motion(motion.loop, motion.initial_state);
  run_trajectory(stepper, samples, std::nullopt, meter);
}

/// What decides and measures at a sample for the peers below.
double sensed_force(const SweepMotion& motion, std::int64_t index, const Vector<double, 4>& state,
                    Backlash<double>& drive, Meter& meter) {
  const bool engaged = drive.step(relative_displacement(state), relative_velocity(state));
  const PdGains<double>& gains = motion.loop.gains;
  const double force =
      engaged ? gains.proportional * state[0] + gains.differential * state[1] : 0.0;
  meter({index, static_cast<double>(index) * motion.loop.sampling.period, state, force, engaged});
  return force;
}

double excitation_at(const SweepMotion& motion, std::int64_t index) {
  const HarmonicExcitation<double>& excitation = motion.loop.excitation;
  return excitation.amplitude * std::cos(excitation.angular_frequency() *
                                         static_cast<double>(index) * motion.loop.sampling.period);
}

void by_textbook(const SweepMotion& motion, std::int64_t samples, Meter& meter) {
  const auto loop = sampled_loop(motion.loop.plant, motion.loop.sampling);
  const Eigen::MatrixXd transition = loop.transition;
  const Eigen::VectorXd control = loop.present_force, excitation = loop.held_excitation;
  Eigen::VectorXd state = motion.initial_state;
  Backlash<double> drive(motion.loop.backlash_width);
  for (std::int64_t j = 0; j < samples; ++j) {
    const double force = sensed_force(motion, j, state, drive, meter);
    state = transition * state + control * force + excitation * excitation_at(motion, j);
  }
}

#if __has_include(<boost/numeric/odeint.hpp>)
void by_odeint(const SweepMotion& motion, std::int64_t samples, Meter& meter) {
  using State = std::array<double, 4>;
  const Matrix<double, 4> a = motion.loop.plant.state_matrix();
  const Vector<double, 4> b = motion.loop.plant.control_input(),
                          c = motion.loop.plant.excitation_input();
  boost::numeric::odeint::runge_kutta4<State> stepper;
  State state{};
  std::copy(motion.initial_state.begin(), motion.initial_state.end(), state.begin());
  Backlash<double> drive(motion.loop.backlash_width);
  const double period = motion.loop.sampling.period;
  for (std::int64_t j = 0; j < samples; ++j) {
    const double force =
        sensed_force(motion, j, Eigen::Map<const Vector<double, 4>>(state.data()), drive, meter);
    const Vector<double, 4> held = b * force + c * excitation_at(motion, j);
    const auto rate = [&](const State& at, State& derivative, double /*time*/) {
      Eigen::Map<Vector<double, 4>>(derivative.data()) =
          a * Eigen::Map<const Vector<double, 4>>(at.data()) + held;
    };
    stepper.do_step(rate, state, static_cast<double>(j) * period, period);
  }
}
#endif

/// Operations of the kernel per sample of a pack (holdfast/sweep/metric_group.hpp): 42 of the
/// motion, 15 of the backlash, 4 of the metrics, 8 more in the steady half.
constexpr double kernel_operations = 42 + 15 + 4 + 0.5 * 8;
constexpr std::int64_t limit_rounds = 2'000'000;
constexpr int chains = 16;

/// Independent multiply-adds on packs.
void multiply_adds() {
  Pack a(0.1), b(0.2), c(0.3), d(0.4), e(0.5), f(0.6), g(0.7), h(0.8);
  Pack i(0.9), j(1.0), k(1.1), l(1.2), m(1.3), n(1.4), o(1.5), p(1.6);
  const Pack factor(0.999999), term(1e-7);
  if constexpr (lanes < 8) {  // sixteen registers hold no more than fourteen numbers
    for (std::int64_t round = 0; round < limit_rounds * chains / 12; ++round) {
      a = a * factor + term, b = b * factor + term, c = c * factor + term;
      d = d * factor + term, e = e * factor + term, f = f * factor + term;
      g = g * factor + term, h = h * factor + term, i = i * factor + term;
      j = j * factor + term, k = k * factor + term, l = l * factor + term;
    }
  } else {
    for (std::int64_t round = 0; round < limit_rounds; ++round) {
      a = a * factor + term, b = b * factor + term, c = c * factor + term, d = d * factor + term;
      e = e * factor + term, f = f * factor + term, g = g * factor + term, h = h * factor + term;
      i = i * factor + term, j = j * factor + term, k = k * factor + term, l = l * factor + term;
      m = m * factor + term, n = n * factor + term, o = o * factor + term, p = p * factor + term;
    }
  }
  double values[lanes];
  Lanes<Pack>::store(a + b + c + d + e + f + g + h + i + j + k + l + m + n + o + p, values);
  sink = values[0];
}

void on_threads(const std::vector<SweepMotion>& motions, int threads) {
  std::vector<MotionMetrics> results(motions.size());
  simd::parallel_rows(static_cast<std::int64_t>(motions.size()), 32, threads, 0,
                      [&](int&, std::int64_t first, std::int64_t count) {
                        simd::motion_metrics(motions.data() + first,
                                             static_cast<std::size_t>(count), duration,
                                             results.data() + first);
                      });
  sink = results[0].steady_rms;
}

void measure() {
  const auto motions = bench::sweep_cells(cells);
  constexpr std::size_t stride = 8;
  std::vector<MotionMetrics> results(motions.size());
  std::vector<std::function<void()>> sides{
      [&] {
        simd::motion_metrics(motions.data(), motions.size(), duration, results.data());
        sink = results[0].steady_rms;
      },
      [&] { on_threads(motions, 1); },
      [&] { on_threads(motions, 2); },
      [&] { multiply_adds(); },
      [&] { motion_metrics<double>(motions.data(), cells / stride, duration, results.data()); },
      [&] { one_after_another(motions, stride, by_stepper); },
      [&] { one_after_another(motions, stride, by_textbook); }};
#if __has_include(<boost/numeric/odeint.hpp>)
  sides.emplace_back([&] { one_after_another(motions, stride, by_odeint); });
#endif
  const auto time = bench::medians(sides);
  const double all = samples_of(motions, 1), some = samples_of(motions, stride);
  const double batch = time[0] / all * 1e9;
  const auto line = [&](const char* name, double nanoseconds) {
    std::printf("  %-46s %8.2f, ratio %6.1f\n", name, nanoseconds, nanoseconds / batch);
  };
  std::printf("%zu lanes, %zu motions of %.0f samples, ns per motion and sample, one core\n", lanes,
              cells, all / cells);
  line("batch on packs", batch);
  line("the same templates on scalars", time[4] / some * 1e9);
  line("the library's stepper", time[5] / some * 1e9);
  line("textbook loop, dynamic matrices", time[6] / some * 1e9);
#if __has_include(<boost/numeric/odeint.hpp>)
  line("Boost.Odeint, one Runge-Kutta step a sample", time[7] / some * 1e9);
#endif
  const double one_operation = time[3] / (static_cast<double>(limit_rounds) * chains) * 1e9;
  const double limit = kernel_operations * one_operation / static_cast<double>(lanes);
  std::printf(
      "  %g operations at the rate of multiply-adds      %8.2f: the batch reaches %.0f %%\n",
      kernel_operations, limit, 100.0 * limit / batch);
  std::printf("  two threads against one                        %8.2f\n", time[1] / time[2]);
}

}  // namespace

int main() {
  if (!holdfast::bench::processor_suffices()) return 0;
  measure();
}
