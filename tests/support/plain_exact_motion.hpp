#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

// A second way to the motions whose drive switches between the samples, in extended precision,
// which shares nothing with the library: own series over short steps, own law, roots by halving.

namespace holdfast::test {

/// Two masses under PD control, in the decimals to which doubles are nearest.
struct PlainExactLoop {
  std::array<double, 6> plant;  ///< m1 k1 c1 m2 k2 c2
  double period, delay, width, proportional, differential, force, frequency;
  bool holds_force;           ///< over each sample
  std::int64_t p = 0, q = 0;  ///< f τ; q = 0: by its digits
};

/// The numbers of a loop of the library.
template <class Loop>
PlainExactLoop plain_exact_loop(const Loop& loop) {
  const auto& plant = loop.plant;
  return {{plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
           plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping},
          loop.sampling.period,
          loop.sampling.processing_delay,
          loop.backlash_width,
          loop.gains.proportional,
          loop.gains.differential,
          loop.excitation.amplitude,
          loop.excitation.frequency,
          loop.hold == decltype(loop.hold)::sampled};
}

/// The motion from a state at the largest force.
class PlainExactMotion {
 public:
  using Real = long double;
  enum Mode { engaged, gap, stick };
  struct Change {
    double time;  ///< s
    int mode;     ///< from then on
  };

  /// [z₁, ż₁, z₂, ż₂, u, F, F_s].
  using State = std::array<Real, 7>;

  /// @param state  [z₁, ż₁, z₂, ż₂] and u_{j−1}
  /// @param sign   σ
  /// @param end    g: where the drive last reversed
  /// @param longest_step  of the series (s): an excursion within one is not seen
  PlainExactMotion(const PlainExactLoop& loop, const std::array<double, 5>& state, int mode,
                   double sign, double end, double longest_step = 5e-4)
      : loop_(loop),
        longest_(longest_step),
        m1_(decimal(loop.plant[0])),
        k1_(decimal(loop.plant[1])),
        c1_(decimal(loop.plant[2])),
        m2_(decimal(loop.plant[3])),
        k2_(decimal(loop.plant[4])),
        c2_(decimal(loop.plant[5])),
        period_(decimal(loop.period)),
        delay_(decimal(loop.delay)),
        width_(decimal(loop.width)),
        proportional_(decimal(loop.proportional)),
        differential_(decimal(loop.differential)),
        force_(decimal(loop.force)),
        frequency_(decimal(loop.frequency)),
        turns_(loop.holds_force ? 0 : 2 * pi * frequency_),
        mode_(mode),
        sign_(sign > 0.0 ? 1 : -1),
        end_(end) {
    for (std::size_t i = 0; i < 5; ++i) state_[i] = static_cast<Real>(state[i]);
  }

  /// Moves on over one sample.
  void step() {
    const Real turn = 2 * pi * phase();
    after_ = 0;
    state_[5] = force_ * std::cos(turn);
    state_[6] = force_ * std::sin(turn);
    const Real command = proportional_ * state_[0] + differential_ * state_[1];
    if (delay_ > 0) {
      jump();
      flow(delay_);
    }
    state_[4] = command;
    if (delay_ < period_) {
      jump();
      flow(period_ - delay_);
    }
    ++sample_;
  }

  const State& state() const { return state_; }
  int mode() const { return mode_; }
  /// The changes of contact so far.
  const std::vector<Change>& changes() const { return changes_; }

 private:
  static constexpr Real pi = 3.14159265358979323846264338327950288L;

  static Real decimal(double nearest) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", nearest);
    return std::strtold(digits, nullptr);
  }

  /// Of the force at the sample, in cycles without the whole ones.
  Real phase() const {
    if (loop_.q > 0)
      return static_cast<Real>((loop_.p * sample_) % loop_.q) / static_cast<Real>(loop_.q);
    const Real cycles = frequency_ * (static_cast<Real>(sample_) * period_);
    return cycles - std::floor(cycles);
  }

  State rate(const State& x) const {
    const Real spring = k2_ * (x[2] - x[0]) + c2_ * (x[3] - x[1]), pull = -k1_ * x[0] - c1_ * x[1];
    State result{x[1], 0, x[3], 0, 0, -turns_ * x[6], turns_ * x[5]};
    if (mode_ == stick) {
      result[1] = result[3] = (pull + x[5]) / (m1_ + m2_);
    } else {
      const Real drive = mode_ == engaged ? x[4] : 0;
      result[1] = (pull + spring + drive + x[5]) / m1_;
      result[3] = (-spring - drive) / m2_;
    }
    return result;
  }
  State after(Real time) const {
    State term = state_, sum = state_;
    for (int k = 1; k < 18; ++k) {
      const State moved = rate(term);
      for (std::size_t i = 0; i < 7; ++i) {
        term[i] = moved[i] * time / static_cast<Real>(k);
        sum[i] += term[i];
      }
    }
    return sum;
  }
  static Real apart(const State& x) { return x[2] - x[0]; }
  static Real speed(const State& x) { return x[3] - x[1]; }
  /// Δz̈ under a force of the drive.
  Real acceleration(const State& x, Real drive) const {
    const Real spring = k2_ * apart(x) + c2_ * speed(x);
    return (-spring - drive) / m2_ - (-k1_ * x[0] - c1_ * x[1] + spring + drive + x[5]) / m1_;
  }

  /// The least of what is positive while the contact stays, and which of two it is.
  Real guard(const State& x, int& which) const {
    which = 0;
    if (mode_ == engaged) return static_cast<Real>(sign_) * speed(x);
    const Real sign = static_cast<Real>(sign_);
    const Real first = mode_ == gap ? sign * (end_ - apart(x)) : sign * acceleration(x, 0);
    const Real second = mode_ == gap ? width_ - first : -sign * acceleration(x, x[4]);
    which = second < first ? 1 : 0;
    return second < first ? second : first;
  }

  void flow(Real left) {
    while (left > 0) {
      const Real length = left < longest_ ? left : longest_;
      int which = 0;
      const State next = after(length);
      if (width_ == 0 || guard(next, which) >= 0) {
        state_ = next;
        after_ += length;
        left -= length;
        continue;
      }
      Real before = 0, beyond = length;
      for (int halving = 0; halving < 80; ++halving) {
        const Real middle = (before + beyond) / 2;
        int unused = 0;
        // It begins at zero just after a change.
        (guard(after(middle), unused) >= 0 || middle < 1e-9L ? before : beyond) = middle;
      }
      guard(after(beyond), which);
      state_ = after(beyond);
      after_ += beyond;
      left -= beyond;
      change(which);
    }
  }

  void become(int mode) {
    mode_ = mode;
    changes_.push_back({static_cast<double>(static_cast<Real>(sample_) * period_ + after_), mode});
  }

  void change(int which) {
    const Real sign = static_cast<Real>(sign_);
    if (mode_ == engaged) {
      state_[3] = state_[1];
      end_ = apart(state_);
      const bool sticks =
          sign * acceleration(state_, 0) > 0 && sign * acceleration(state_, state_[4]) < 0;
      become(sticks ? stick : gap);
    } else if (mode_ == gap) {
      if (which == 1) sign_ = -sign_;
      become(engaged);
    } else {
      become(which == 0 ? gap : engaged);
    }
  }
  /// Another force: stick ends where it cannot hold.
  void jump() {
    if (mode_ != stick) return;
    const Real sign = static_cast<Real>(sign_);
    if (sign * acceleration(state_, 0) <= 0)
      become(gap);
    else if (sign * acceleration(state_, state_[4]) >= 0)
      become(engaged);
  }

  PlainExactLoop loop_;
  Real longest_, m1_, k1_, c1_, m2_, k2_, c2_;
  Real period_, delay_, width_, proportional_, differential_, force_, frequency_, turns_;
  State state_{};
  int mode_;
  int sign_;
  Real end_;
  std::int64_t sample_ = 0;
  Real after_ = 0;  // s from the sample
  std::vector<Change> changes_;
};

}  // namespace holdfast::test
