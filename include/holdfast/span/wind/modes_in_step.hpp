#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// An integrator of the modes of a span, η̈ + 2 ζ ω η̇ + ω² η = g, all at once. For g constant over
/// a step its solution is exact, however long the step. ζ may change between steps and may be
/// negative.
template <class Scalar = double>
class ModesInStep {
 public:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;  ///< one number for each mode

  /// Constructs the modes at rest.
  /// @param frequencies  ω (rad/s), > 0
  /// @param step         h (s), > 0
  ModesInStep(const Column& frequencies, double step)
      : position(Column::Zero(frequencies.size())),
        velocity(Column::Zero(frequencies.size())),
        omega_(frequencies),
        step_(step) {}

  const Column& frequencies() const { return omega_; }  ///< ω (rad/s)

  /// The squared amplitude η² + (η̇/ω)² of each mode.
  Column squared_amplitudes() const { return position.square() + (velocity / omega_).square(); }

  /// Sets the damping of the coming steps.
  /// @param ratios  ζ; values outside ±0.9 are replaced by ±0.9
  void damp(const Column& ratios) {
    const Column zeta = ratios.max(Scalar(-0.9)).min(Scalar(0.9));
    const Column turning = omega_ * (Scalar(1) - zeta.square()).sqrt();
    const Column decay = (-zeta * omega_ * Scalar(step_)).exp();
    const Column cosine = decay * (turning * Scalar(step_)).cos();
    const Column sine = decay * (turning * Scalar(step_)).sin() / turning;
    keep_position_ = cosine + zeta * omega_ * sine;
    keep_velocity_ = cosine - zeta * omega_ * sine;
    exchange_ = sine;
  }

  /// Performs one step.
  /// @param force  g (m/s²), the force on each mode over its modal mass
  void step(const Column& force) {
    rest_ = force / omega_.square();
    position -= rest_;
    moved_ = keep_position_ * position + exchange_ * velocity;
    velocity = keep_velocity_ * velocity - omega_.square() * exchange_ * position;
    position = moved_ + rest_;
  }

  Column position;  ///< η (m)
  Column velocity;  ///< η̇ (m/s)

 private:
  Column omega_, keep_position_, keep_velocity_, exchange_, rest_, moved_;
  double step_;
};

/// The mean squares of a motion of the modes sin(nπx/L) in successive windows of time.
template <class Scalar = double>
class AmplitudeRecord {
 public:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;                ///< a number per mode
  using Square = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;  ///< modes by modes

  /// @param modes    number of modes
  /// @param samples  number of samples in all windows together, ≥ windows
  /// @param windows  number of windows, ≥ 1
  AmplitudeRecord(Eigen::Index modes, long samples, int windows)
      : samples_(samples),
        sums_(static_cast<std::size_t>(windows), Square::Zero(modes, modes)),
        counts_(static_cast<std::size_t>(windows), 0),
        velocities_(Column::Zero(modes)) {}

  /// Adds the present state of the modes.
  void add(const ModesInStep<Scalar>& motion) {
    const auto window =
        static_cast<std::size_t>(seen_++ * static_cast<long>(sums_.size()) / samples_);
    if (window >= sums_.size()) return;
    sums_[window].noalias() += motion.position.matrix() * motion.position.matrix().transpose();
    ++counts_[window];
    velocities_ += motion.velocity.square();
  }

  /// Finds the place of the largest mean square: the best of 8 places per half-wave of the highest
  /// mode, then refined. The functions below are valid only after this call.
  void evaluate() {
    Square total = sums_.front();
    for (std::size_t w = 1; w < sums_.size(); ++w) total += sums_[w];
    antinode_ = largest(total);
    const Column shapes = shapes_at(antinode_);
    for (std::size_t w = 0; w < sums_.size(); ++w) {
      squares_.push_back(static_cast<double>(square_of(shapes, sums_[w])) / counts_[w]);
      mean_square_ += squares_.back() / static_cast<double>(sums_.size());
    }
    total.diagonal().maxCoeff(&mode_);
    turn_ = std::sqrt(static_cast<double>(velocities_[mode_] / total(mode_, mode_)));
  }

  double antinode() const { return antinode_; }                       ///< place x/L of the maximum
  double amplitude() const { return std::sqrt(2.0 * mean_square_); }  ///< √2 times the rms there
  int mode() const { return static_cast<int>(mode_) + 1; }            ///< number of largest mode
  double angular_frequency() const { return turn_; }  ///< rms velocity over rms η of that mode

  /// The standard deviation of the amplitudes in the windows, at the same place.
  double spread() const {
    double sum = 0.0, squares = 0.0;
    for (const double square : squares_) {
      sum += std::sqrt(2.0 * square);
      squares += 2.0 * square;
    }
    const auto count = static_cast<double>(squares_.size());
    return std::sqrt(std::max(squares / count - sum * sum / (count * count), 0.0));
  }

 private:
  Column shapes_at(double place) const {
    Column shapes(velocities_.size());
    for (Eigen::Index n = 0; n < shapes.size(); ++n)
      shapes[n] = Scalar(std::sin(static_cast<double>(n + 1) * pi<double> * place));
    return shapes;
  }

  static Scalar square_of(const Column& shapes, const Square& squares) {
    return shapes.matrix().dot(squares * shapes.matrix());
  }

  double largest(const Square& squares) const {
    const Eigen::Index places = 8 * velocities_.size();
    const auto at = [&](double place) { return square_of(shapes_at(place), squares); };
    double best = 0.5, way = 1.0 / static_cast<double>(places);
    Scalar most = at(best);
    const auto look = [&](double place) {
      const Scalar found = at(place);
      if (found > most) {
        most = found;
        best = place;
      }
    };
    for (Eigen::Index j = 1; j < places; ++j) look(static_cast<double>(j) * way);
    for (int turn = 0; turn < 12; ++turn) {
      way *= 0.5;
      const double middle = best;
      look(middle - way);
      look(middle + way);
    }
    return best;
  }

  long samples_, seen_ = 0;
  std::vector<Square> sums_;
  std::vector<double> counts_;
  Column velocities_;
  std::vector<double> squares_;
  Eigen::Index mode_ = 0;
  double antinode_ = 0.0, mean_square_ = 0.0, turn_ = 0.0;
};

}  // namespace holdfast
