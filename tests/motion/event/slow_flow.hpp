#pragma once

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// Δz̈ by Newton's law of each mass while a force s is transmitted, and the size of its terms.
struct RelativeAcceleration {
  double value, size;
};

inline RelativeAcceleration acceleration_between(const TwoMass<double>& plant,
                                                 const Vector<double, 4>& z, double transmitted,
                                                 double force) {
  const double between = plant.absorber_stiffness * (z[2] - z[0]) +
                         plant.absorber_damping * (z[3] - z[1]) + transmitted;
  const double outside = -plant.conductor_stiffness * z[0] - plant.conductor_damping * z[1] + force;
  const double conductor = (outside + between) / plant.conductor_mass;
  const double size = (std::abs(outside) + std::abs(between)) / plant.conductor_mass +
                      std::abs(between) / plant.absorber_mass;
  return {-between / plant.absorber_mass - conductor, size};
}

/// The three modes by Newton's law, moved by matrix exponentials of the test's own.
class SlowFlow {
 public:
  SlowFlow(const TwoMass<double>& plant, const std::vector<Harmonic>& lines)
      : plant_(plant), lines_(lines) {}

  /// z after a length, from an instant on, under a command in force.
  Vector<double, 4> moved(int mode, const Vector<double, 4>& z, double command, double time,
                          double length) {
    const Step& step = step_for(mode, length);
    Vector<double, 4> next = step.held.transition * z;
    if (mode == 0) next += step.held.input * command;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      const double angle = lines_[l].angle(time);
      next += lines_[l].amplitude *
              (step.lines[l].cosine * std::cos(angle) + step.lines[l].sine * std::sin(angle));
    }
    return next;
  }

  double force_at(double time) const {
    double sum = 0.0;
    for (const Harmonic& line : lines_) sum += line.at(time);
    return sum;
  }

 private:
  struct Step {
    HeldStep<double, 4, 1> held;
    std::vector<HarmonicInput<double>> lines;
  };

  Matrix<double, 4> state_matrix(int mode) const {
    if (mode != 2) return plant_.state_matrix();
    const double mass = plant_.conductor_mass + plant_.absorber_mass;
    Matrix<double, 4> together = Matrix<double, 4>::Zero();
    together(0, 1) = together(2, 3) = 1.0;
    together(1, 0) = together(3, 0) = -plant_.conductor_stiffness / mass;
    together(1, 1) = together(3, 1) = -plant_.conductor_damping / mass;
    return together;
  }

  Vector<double, 4> force_input(int mode) const {
    if (mode != 2) return plant_.excitation_input();
    const double mass = plant_.conductor_mass + plant_.absorber_mass;
    return {0.0, 1.0 / mass, 0.0, 1.0 / mass};
  }

  const Step& step_for(int mode, double length) {
    const auto key = std::make_pair(mode, length);
    const auto known = steps_.find(key);
    if (known != steps_.end()) return known->second;
    const Matrix<double, 4> a = state_matrix(mode);
    Step step{zero_order_hold<double, 4, 1>(a, plant_.control_input(), length), {}};
    for (const Harmonic& line : lines_)
      step.lines.push_back(
          exact_harmonic<double>(a, force_input(mode), length, line.angular_frequency()));
    if (steps_.size() > 1000) steps_.clear();
    return steps_.emplace(key, step).first->second;
  }

  TwoMass<double> plant_;
  std::vector<Harmonic> lines_;
  std::map<std::pair<int, double>, Step> steps_;
};

}  // namespace holdfast::test
