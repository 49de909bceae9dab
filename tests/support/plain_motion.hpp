#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

// A second way to the periodic motions of the sampled loop, which shares nothing with the library:
// own exponentials, own rule of the backlash, and a period that is looked for among the states at
// the stroboscopic instants alone.

namespace holdfast::test {

/// The two masses of Kollár 2022 under PD control without delay, the force held over each sample.
struct PlainLoop {
  double period, width;                                               ///< τ, r₀
  double proportional, differential;                                  ///< P, D
  double force, frequency;                                            ///< F_m, f
  std::int64_t coincidence;                                           ///< q, samples
  std::array<double, 6> plant{0.0767, 50.3, 0.079, 0.16, 74.4, 4.0};  ///< m1 k1 c1 m2 k2 c2
};

/// The numbers of a loop of the library, which has the paper's plant and no delay.
/// @param coincidence  q, samples
template <class Loop>
PlainLoop plain_loop(const Loop& loop, std::int64_t coincidence) {
  return {loop.sampling.period,
          loop.backlash_width,
          loop.gains.proportional,
          loop.gains.differential,
          loop.excitation.amplitude,
          loop.excitation.frequency,
          coincidence};
}

namespace detail {

using PlainMap = std::array<std::array<double, 6>, 6>;

/// e^{Ah} by its series at h/2^s, squared s times.
inline PlainMap plain_exponential(const PlainMap& rates, double length) {
  constexpr int halvings = 12;
  const double step = std::ldexp(length, -halvings);
  long double term[6][6] = {}, sum[6][6] = {};
  for (int i = 0; i < 6; ++i) term[i][i] = sum[i][i] = 1.0L;
  const auto times = [](const auto& a, const auto& b, auto& out) {
    long double product[6][6] = {};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t j = 0; j < 6; ++j)
          product[i][j] += static_cast<long double>(a[i][k]) * b[k][j];
    std::copy(&product[0][0], &product[0][0] + 36, &out[0][0]);
  };
  for (int n = 1; n <= 12; ++n) {
    times(term, rates, term);
    for (auto& row : term)
      for (long double& entry : row) entry *= step / n;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) sum[i][j] += term[i][j];
  }
  for (int k = 0; k < halvings; ++k) times(sum, sum, sum);
  PlainMap map{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) map[i][j] = static_cast<double>(sum[i][j]);
  return map;
}

/// z' = A z + b u + c F with two more rows for what is held.
inline PlainMap plain_rates(const PlainLoop& loop) {
  const auto& [m1, k1, c1, m2, k2, c2] = loop.plant;
  PlainMap rates{};
  rates[0][1] = rates[2][3] = 1.0;
  rates[1] = {-(k1 + k2) / m1, -(c1 + c2) / m1, k2 / m1, c2 / m1, 1 / m1, 1 / m1};
  rates[3] = {k2 / m2, c2 / m2, -k2 / m2, -c2 / m2, -1 / m2, 0.0};
  return rates;
}

/// F at the samples of one coincidence.
inline std::vector<double> plain_forces(const PlainLoop& loop) {
  constexpr double pi = 3.14159265358979323846;
  std::vector<double> forces;
  for (std::int64_t j = 0; j < loop.coincidence; ++j) {
    // f τ = p/q: the phase of sample j is that of (j p mod q)/q.
    const double cycles = loop.frequency * loop.period * static_cast<double>(loop.coincidence);
    const auto turned = (static_cast<std::int64_t>(std::llround(cycles)) * j) % loop.coincidence;
    forces.push_back(loop.force * std::cos(2.0 * pi * static_cast<double>(turned) /
                                           static_cast<double>(loop.coincidence)));
  }
  return forces;
}

}  // namespace detail

/// The motion from rest.
class PlainMotion {
 public:
  using State = std::array<double, 4>;

  explicit PlainMotion(const PlainLoop& loop)
      : loop_(loop),
        map_(detail::plain_exponential(detail::plain_rates(loop), loop.period)),
        forces_(detail::plain_forces(loop)) {}

  /// Moves on over one coincidence.
  void step() {
    for (const double force : forces_) {
      largest_ = std::max(largest_, std::abs(state_[0]));
      const double apart = state_[2] - state_[0], speed = state_[3] - state_[1];
      bool may_enter = !inside_;
      if (inside_ && (apart < lower_ || apart > upper_)) inside_ = false;
      if (may_enter && loop_.width > 0.0 &&
          ((last_speed_ > 0.0 && speed <= 0.0) || (last_speed_ < 0.0 && speed >= 0.0))) {
        inside_ = true;
        lower_ = last_speed_ > 0.0 ? apart - loop_.width : apart;
        upper_ = last_speed_ > 0.0 ? apart : apart + loop_.width;
      }
      last_speed_ = speed;
      const double command =
          inside_ ? 0.0 : loop_.proportional * state_[0] + loop_.differential * state_[1];
      State next{};
      for (std::size_t i = 0; i < 4; ++i) {
        next[i] = map_[i][4] * command + map_[i][5] * force;
        for (std::size_t k = 0; k < 4; ++k) next[i] += map_[i][k] * state_[k];
      }
      state_ = next;
    }
  }

  const State& state() const { return state_; }
  bool contact() const { return inside_; }
  /// Forgets the largest displacement.
  void begin_record() { largest_ = 0.0; }
  /// max |z₁| (m) at the samples.
  double largest_sample() const { return largest_; }

 private:
  PlainLoop loop_;
  detail::PlainMap map_;
  std::vector<double> forces_;
  State state_{};
  bool inside_ = false;
  double largest_ = 0.0;
  double lower_ = 0.0, upper_ = 0.0, last_speed_ = 0.0;
};

/// After how many coincidences a motion repeats, once it has settled; 0: in none of as many as fit
/// into the samples. The motion is left where it has shown its period.
///
/// At 128, 256, 512, … coincidences, or from another `first` on, the state is kept; the motion has
/// a period where it comes back to that within 10⁻⁹ of its extent in the same contact, does so
/// twice more, and has the same period from the next of these instants on: what is left of a
/// deviation that turns may come back sooner than it decays.
template <class Motion>
std::int64_t settled_period(Motion& motion, std::int64_t coincidence, std::int64_t most_samples,
                            std::int64_t first = 128) {
  typename Motion::State extent{};
  std::int64_t taken = 0;
  const auto step = [&] {
    motion.step();
    ++taken;
    for (std::size_t i = 0; i < 4; ++i)
      extent[i] = std::max(extent[i], std::abs(motion.state()[i]));
  };
  const auto near = [&](const typename Motion::State& kept, auto contact) {
    bool all = motion.contact() == contact;
    for (std::size_t i = 0; all && i < 4; ++i)
      all = std::abs(motion.state()[i] - kept[i]) <= 1e-9 * extent[i];
    return all;
  };
  std::int64_t before = 0;
  for (std::int64_t settled = first; 2 * settled * coincidence <= most_samples; settled *= 2) {
    while (taken < settled) step();
    const auto kept = motion.state();
    const auto contact = motion.contact();
    const std::int64_t start = taken;
    std::int64_t period = 0;
    while (taken < start + settled && period == 0) {
      step();
      if (near(kept, contact)) period = taken - start;
    }
    if (period == 0) continue;
    bool again = true;
    for (int turn = 0; again && turn < 2; ++turn) {
      for (std::int64_t k = 0; k < period; ++k) step();
      again = near(kept, contact);
    }
    if (again && period == before) return period;
    before = again ? period : 0;
  }
  return 0;
}

/// That of the motion from rest that switches at samples.
inline std::int64_t plain_period(const PlainLoop& loop, std::int64_t most_samples) {
  PlainMotion motion(loop);
  return settled_period(motion, loop.coincidence, most_samples);
}

}  // namespace holdfast::test
