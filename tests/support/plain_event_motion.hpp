#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "plain_motion.hpp"

// A second way to the motions whose drive enters and leaves its backlash between the samples, which
// shares nothing with the library: own exponentials over short parts of a sampling period, and in
// those in which the contact changes a power series and bisection.

namespace holdfast::test {

/// What the drive does, as a letter of the word of a motion.
namespace plain_contact {
constexpr char engaged = 'e', gap = 'g', stick = 's';
}

/// The motion from rest of the play that switches when it happens; r₀ > 0.
class PlainEventMotion {
 public:
  using State = std::array<double, 4>;

  explicit PlainEventMotion(const PlainLoop& loop)
      : loop_(loop),
        parts_(static_cast<int>(std::ceil(loop.period / longest_part))),
        part_(loop.period / parts_),
        forces_(detail::plain_forces(loop)) {
    const auto& [m1, k1, c1, m2, k2, c2] = loop.plant;
    rates_[0] = rates_[1] = rates_[2] = detail::plain_rates(loop);
    // In the gap the command is without effect; in stick both masses are one.
    for (auto& row : rates_[1]) row[4] = 0.0;
    rates_[2][1] = rates_[2][3] = {-k1 / (m1 + m2), -c1 / (m1 + m2), 0, 0, 0, 1 / (m1 + m2)};
    rates_[2][2] = rates_[2][0];
    rates_[2][0][1] = rates_[2][2][1] = 1.0;
    for (std::size_t k = 0; k < 6; ++k) push_[k] = rates_[1][3][k] - rates_[1][1][k];
    mobility_ = rates_[0][3][4] - rates_[0][1][4];
    slopes_[0] = push_;
    slopes_[0][4] = mobility_;
    slopes_[1] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0};
    for (std::size_t mode = 0; mode < 3; ++mode) {
      const detail::PlainMap map = detail::plain_exponential(rates_[mode], part_);
      for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t i = 0; i < 4; ++i) maps_[mode][k][i] = map[i][k];
        if (mode == 2)
          for (std::size_t i = 0; i < 4; ++i) slopes_[2][k] += push_[i] * rates_[2][i][k];
      }
    }
  }

  /// Moves on over one coincidence.
  void step() {
    const std::size_t half = forces_.size() / 2;
    for (std::size_t j = 0; j < forces_.size(); ++j) {
      if (j == half) half_way_ = state_;
      const double force = forces_[j];
      largest_ = std::max(largest_, std::abs(state_[0]));
      held_ = {loop_.proportional * state_[0] + loop_.differential * state_[1], force};
      if (contact_ == plain_contact::stick) leave_stick();
      for (int k = 0; k < parts_; ++k) pass_part();
    }
  }

  /// Forgets the word and the largest displacement.
  void begin_record() {
    word_.clear();
    largest_ = 0.0;
  }

  const State& state() const { return state_; }
  char contact() const { return contact_; }
  /// Whether the last coincidence ended in the mirror image of its middle, to a millionth.
  bool mirrors_itself() const {
    const auto scale = [](const State& of, std::size_t k) {
      return std::max(std::abs(of[k]), 1e-3 * std::abs(of[(k + 2) % 4]));
    };
    bool all = forces_.size() % 2 == 0;
    for (std::size_t k = 0; k < 4; ++k)
      all = all && std::abs(state_[k] + half_way_[k]) <= 1e-6 * scale(state_, k);
    return all;
  }
  /// The contacts that have begun, in their order.
  const std::string& word() const { return word_; }
  /// max |z₁| (m) at the samples.
  double largest_sample() const { return largest_; }

 private:
  static constexpr double longest_part = 1e-3;  // s
  static constexpr std::size_t terms = 12;
  // m, m/s, m/s²: what is nearer to zero is rounding.
  static constexpr double rounding = 1e-13;

  /// ℓ z + constant, positive while the contact stays, and the sign of its slope against that of
  /// the mode.
  struct Guard {
    State row;
    double constant, sign;
  };
  using Guards = std::array<Guard, 2>;
  using Terms = std::array<double, terms>;

  std::size_t mode() const {
    return contact_ == plain_contact::engaged ? 0 : contact_ == plain_contact::gap ? 1 : 2;
  }

  /// Δz̈ under a force s between the masses.
  double acceleration(double transmitted) const {
    double sum = mobility_ * transmitted + push_[5] * held_[1];
    for (std::size_t k = 0; k < 4; ++k) sum += push_[k] * state_[k];
    return sum;
  }

  Guards guards() const {
    if (contact_ == plain_contact::engaged) {
      const Guard forward{{0.0, -sign_, 0.0, sign_}, 0.0, sign_};
      return {forward, forward};
    }
    if (contact_ == plain_contact::gap)
      return {Guard{{1.0, 0.0, -1.0, 0.0}, upper_, -1.0},
              Guard{{-1.0, 0.0, 1.0, 0.0}, -lower_, 1.0}};
    Guard on{}, back{};
    for (std::size_t k = 0; k < 4; ++k) {
      on.row[k] = sign_ * push_[k];
      back.row[k] = -on.row[k];
    }
    on.constant = sign_ * push_[5] * held_[1];
    back.constant = -on.constant - sign_ * mobility_ * held_[0];
    on.sign = sign_;
    back.sign = -sign_;
    return {on, back};
  }

  static double dot(const State& a, const State& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  }
  State after_part() const {
    const auto& map = maps_[mode()];
    State to{};
    for (std::size_t i = 0; i < 4; ++i) {
      to[i] = map[4][i] * held_[0] + map[5][i] * held_[1];
      for (std::size_t k = 0; k < 4; ++k) to[i] += map[k][i] * state_[k];
    }
    return to;
  }
  /// Of the guards of the mode, but for their signs.
  double slope(const State& at) const {
    const auto& row = slopes_[mode()];
    double sum = row[4] * held_[0] + row[5] * held_[1];
    for (std::size_t k = 0; k < 4; ++k) sum += row[k] * at[k];
    return sum;
  }

  void pass_part() {
    const State after = after_part();
    // At rest: which way it goes first.
    if (sign_ == 0.0) sign_ = after[3] >= after[1] ? 1.0 : -1.0;
    const double begin = slope(state_), end = slope(after);
    bool stays = true;
    for (const Guard& guard : guards()) {
      const bool passes = dot(guard.row, after) + guard.constant < 0.0;
      const bool dips = guard.sign * begin < 0.0 && guard.sign * end > 0.0;
      stays = stays && !passes && !dips;
    }
    if (stays) return go_to(after);
    for (double left = part_; left > 0.0;) left -= pass_to_event(left);
  }

  void go_to(const State& after) {
    const double apart = state_[2] - state_[0];
    state_ = after;
    if (contact_ != plain_contact::stick) return;
    state_[2] = state_[0] + apart;
    state_[3] = state_[1];
  }

  /// Passes to the next change of contact, or to the end. @return the time that it took
  double pass_to_event(double length) {
    std::array<State, terms> series{state_};
    for (std::size_t n = 1; n < terms; ++n) {
      // What is held acts in the first derivative alone.
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& rates = rates_[mode()][i];
        double sum = n == 1 ? rates[4] * held_[0] + rates[5] * held_[1] : 0.0;
        for (std::size_t k = 0; k < 4; ++k) sum += rates[k] * series[n - 1][k];
        series[n][i] = sum / static_cast<double>(n);
      }
    }
    double first = length;
    int reached = -1;
    const Guards all = guards();
    for (int g = 0; g < 2; ++g) {
      const Guard& guard = all[static_cast<std::size_t>(g)];
      Terms value{};
      for (std::size_t n = 0; n < terms; ++n) value[n] = dot(guard.row, series[n]);
      value[0] += guard.constant;
      const double at = first_zero(value, length);
      if (at >= first) continue;
      first = at;
      reached = g;
    }
    State there{};
    for (std::size_t n = terms; n-- > 0;)
      for (std::size_t i = 0; i < 4; ++i) there[i] = there[i] * first + series[n][i];
    go_to(there);
    if (reached >= 0) change(reached);
    return first;
  }

  static double value_at(const Terms& p, double t) {
    double sum = 0.0;
    for (std::size_t n = terms; n-- > 0;) sum = sum * t + p[n];
    return sum;
  }
  static double slope_at(const Terms& p, double t) {
    double sum = 0.0;
    for (std::size_t n = terms; n-- > 1;) sum = sum * t + static_cast<double>(n) * p[n];
    return sum;
  }

  /// Where f changes from `low`, where it is not below zero, to `high`, where it is.
  template <class Function>
  static double bisected(double low, double high, const Function& f) {
    for (int k = 0; k < 54; ++k) {
      const double middle = 0.5 * (low + high);
      (f(middle) < 0.0 ? high : low) = middle;
    }
    return high;
  }

  /// Where the guard comes to zero before the length; else the length.
  static double first_zero(const Terms& p, double length) {
    const auto value = [&](double t) { return value_at(p, t); };
    double end = length;
    if (slope_at(p, 0.0) < 0.0 && slope_at(p, length) > 0.0) {
      const double lowest = bisected(0.0, length, [&](double t) { return -slope_at(p, t); });
      if (value(lowest) < -rounding) end = lowest;
    }
    return value(end) < -rounding ? bisected(0.0, end, value) : length;
  }

  void become(char contact) {
    contact_ = contact;
    word_ += contact;
  }

  void change(int guard) {
    if (contact_ == plain_contact::stick)
      return become(guard == 0 ? plain_contact::gap : plain_contact::engaged);
    if (contact_ == plain_contact::gap) {
      sign_ = guard == 0 ? 1.0 : -1.0;
      return become(plain_contact::engaged);
    }
    state_[3] = state_[1];
    const double here = state_[2] - state_[0];
    lower_ = sign_ > 0.0 ? here - loop_.width : here;
    upper_ = sign_ > 0.0 ? here : here + loop_.width;
    const bool sticks = sign_ * acceleration(0.0) > 0.0 && sign_ * acceleration(held_[0]) < 0.0;
    become(sticks ? plain_contact::stick : plain_contact::gap);
  }

  /// At a sample, where force and command jump.
  void leave_stick() {
    if (sign_ * acceleration(0.0) <= 0.0) return become(plain_contact::gap);
    if (sign_ * acceleration(held_[0]) >= 0.0) become(plain_contact::engaged);
  }

  PlainLoop loop_;
  int parts_;
  double part_;                                 // s
  std::array<detail::PlainMap, 3> rates_;       // of engaged, gap, stick
  std::array<std::array<State, 6>, 3> maps_{};  // over a part, by columns
  std::array<std::array<double, 6>, 3> slopes_{};  // of Δż, Δz and Δz̈ without a transmitted force
  std::array<double, 6> push_{};                   // Δz̈ without a transmitted force
  double mobility_ = 0.0;                          // Δz̈ of a newton between the masses
  std::vector<double> forces_;
  std::array<double, 2> held_{};  // u, F
  State state_{}, half_way_{};
  char contact_ = plain_contact::engaged;
  double sign_ = 0.0, lower_ = 0.0, upper_ = 0.0;
  std::string word_;
  double largest_ = 0.0;
};

/// The letter of a mode of the library, of which the words are the same three.
template <class Mode>
char letter_of(Mode mode) {
  return mode == Mode::engaged ? plain_contact::engaged
         : mode == Mode::gap   ? plain_contact::gap
                               : plain_contact::stick;
}

/// Whether two words are one, wherever they begin.
inline bool same_turn(const std::string& one, const std::string& other) {
  return one.size() == other.size() && (other + other).find(one) != std::string::npos;
}

}  // namespace holdfast::test
