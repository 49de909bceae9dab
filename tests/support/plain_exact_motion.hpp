#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

// A second way to the motions whose drive switches between the samples, in extended precision,
// which shares nothing with the library: own series over short steps, own law, roots by halving.

namespace holdfast::test {

/// The two masses of Kollár 2022 under PD control, in the decimals to which doubles are nearest.
struct PlainExactLoop {
  double period, delay, width, proportional, differential, force, frequency;
  std::int64_t p, q;  ///< f τ
  bool holds_force;   ///< over each sample
};

/// The numbers of a loop of the library, which has the paper's plant.
template <class Loop, class Ratio>
PlainExactLoop plain_exact_loop(const Loop& loop, const Ratio& ratio, bool holds_force) {
  return {loop.sampling.period,      loop.sampling.processing_delay,
          loop.backlash_width,       loop.gains.proportional,
          loop.gains.differential,   loop.excitation.amplitude,
          loop.excitation.frequency, ratio.numerator,
          ratio.denominator,         holds_force};
}

/// The motion from a state at a coincidence of sampling and force.
class PlainExactMotion {
 public:
  using Real = long double;
  enum Mode { engaged, gap, stick };

  /// [z₁, ż₁, z₂, ż₂, u, F, F_s].
  using State = std::array<Real, 7>;

  /// @param state  [z₁, ż₁, z₂, ż₂] and u_{j−1}
  /// @param sign   σ
  /// @param end    g: where the drive last reversed
  PlainExactMotion(const PlainExactLoop& loop, const std::array<double, 5>& state, int mode,
                   double sign, double end)
      : loop_(loop),
        period_(decimal(loop.period)),
        delay_(decimal(loop.delay)),
        width_(decimal(loop.width)),
        proportional_(decimal(loop.proportional)),
        differential_(decimal(loop.differential)),
        force_(decimal(loop.force)),
        turns_(loop.holds_force ? 0 : 2 * pi * decimal(loop.frequency)),
        mode_(mode),
        sign_(sign > 0.0 ? 1 : -1),
        end_(end) {
    for (std::size_t i = 0; i < 5; ++i) state_[i] = static_cast<Real>(state[i]);
  }

  /// Moves on over one sample.
  void step() {
    const Real turn =
        2 * pi * static_cast<Real>((loop_.p * sample_) % loop_.q) / static_cast<Real>(loop_.q);
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
  /// Changes of contact so far.
  int switches() const { return switches_; }

 private:
  static constexpr Real pi = 3.14159265358979323846264338327950288L;
  static constexpr Real m1 = 0.0767L, k1 = 50.3L, c1 = 0.079L, m2 = 0.16L, k2 = 74.4L, c2 = 4.0L;

  static Real decimal(double nearest) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g", nearest);
    return std::strtold(digits, nullptr);
  }

  State rate(const State& x) const {
    const Real spring = k2 * (x[2] - x[0]) + c2 * (x[3] - x[1]), pull = -k1 * x[0] - c1 * x[1];
    State result{x[1], 0, x[3], 0, 0, -turns_ * x[6], turns_ * x[5]};
    if (mode_ == stick) {
      result[1] = result[3] = (pull + x[5]) / (m1 + m2);
    } else {
      const Real drive = mode_ == engaged ? x[4] : 0;
      result[1] = (pull + spring + drive + x[5]) / m1;
      result[3] = (-spring - drive) / m2;
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
  static Real acceleration(const State& x, Real drive) {
    const Real spring = k2 * apart(x) + c2 * speed(x);
    return (-spring - drive) / m2 - (-k1 * x[0] - c1 * x[1] + spring + drive + x[5]) / m1;
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
    constexpr Real longest = 0.0005L;
    while (left > 0) {
      const Real length = left < longest ? left : longest;
      int which = 0;
      const State next = after(length);
      if (width_ == 0 || guard(next, which) >= 0) {
        state_ = next;
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
      left -= beyond;
      change(which);
    }
  }

  void change(int which) {
    ++switches_;
    const Real sign = static_cast<Real>(sign_);
    if (mode_ == engaged) {
      state_[3] = state_[1];
      end_ = apart(state_);
      const bool sticks =
          sign * acceleration(state_, 0) > 0 && sign * acceleration(state_, state_[4]) < 0;
      mode_ = sticks ? stick : gap;
    } else if (mode_ == gap) {
      if (which == 1) sign_ = -sign_;
      mode_ = engaged;
    } else {
      mode_ = which == 0 ? gap : engaged;
    }
  }
  /// Another force: stick ends where it cannot hold.
  void jump() {
    if (mode_ != stick) return;
    const Real sign = static_cast<Real>(sign_);
    const int before = mode_;
    if (sign * acceleration(state_, 0) <= 0)
      mode_ = gap;
    else if (sign * acceleration(state_, state_[4]) >= 0)
      mode_ = engaged;
    switches_ += mode_ == before ? 0 : 1;
  }

  PlainExactLoop loop_;
  Real period_, delay_, width_, proportional_, differential_, force_, turns_;
  State state_{};
  int mode_;
  int sign_;
  Real end_;
  std::int64_t sample_ = 0;
  int switches_ = 0;
};

}  // namespace holdfast::test
