#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::detail {

/// The matrices of one loop after another. Their exponentials cost some microseconds; cells of a
/// sweep in a row often share them.
class SweepMatrices {
 public:
  struct Matrices {
    SampledLoop<double> sampled;
    HarmonicInput<double> input;
  };

  /// @tparam Loop  IdealLoop<double>; a template so that only who calls it compiles it
  template <class Loop>
  const Matrices& of(const Loop& loop) {
    const bool same_loop = known_ && numbers_of(known_->plant) == numbers_of(loop.plant) &&
                           known_->sampling.period == loop.sampling.period &&
                           known_->sampling.processing_delay == loop.sampling.processing_delay;
    const bool same_input = same_loop && known_->hold == loop.hold &&
                            (loop.hold == ForceHold::sampled ||
                             known_->excitation.frequency == loop.excitation.frequency);
    if (!same_loop) matrices_.sampled = sampled_loop(loop.plant, loop.sampling);
    if (!same_input) {
      matrices_.input = harmonic_input(loop.plant, matrices_.sampled, loop.hold,
                                       loop.excitation.angular_frequency());
    }
    known_ = loop;
    return matrices_;
  }

 private:
  /// Of no loop yet, but copied with the rest.
  static Matrices of_no_loop() {
    const Matrix<double, 4> square = Matrix<double, 4>::Zero();
    const Vector<double, 4> column = Vector<double, 4>::Zero();
    return {{{}, square, square, column, column, column}, {column, column}};
  }

  std::optional<IdealLoop<double>> known_;
  Matrices matrices_ = of_no_loop();
};

/// One number of every lane. @param number  (lane) → double
template <class Scalar, class Number>
Scalar from_lanes(const Number& number) {
  double values[Lanes<Scalar>::count];
  for (std::size_t lane = 0; lane < Lanes<Scalar>::count; ++lane) values[lane] = number(lane);
  return Lanes<Scalar>::load(values);
}

/// One matrix of every lane. @param matrix  (lane) → Matrix<double, Rows, Columns>
template <class Scalar, int Rows, int Columns, class Matrices>
Matrix<Scalar, Rows, Columns> matrix_from_lanes(const Matrices& matrix) {
  Matrix<Scalar, Rows, Columns> result;
  for (int i = 0; i < Rows; ++i) {
    for (int j = 0; j < Columns; ++j) {
      result(i, j) = from_lanes<Scalar>([&](std::size_t lane) { return matrix(lane)(i, j); });
    }
  }
  return result;
}

/// The sampled loop of every lane.
template <class Scalar>
SampledLoop<Scalar> loop_from_lanes(
    const std::array<SweepMatrices::Matrices, Lanes<Scalar>::count>& lanes) {
  const auto number = [&](auto member) {
    return from_lanes<Scalar>([&](std::size_t k) { return lanes[k].sampled.sampling.*member; });
  };
  const auto vector = [&](auto member) {
    return matrix_from_lanes<Scalar, 4, 1>([&](std::size_t k) -> const auto& {
      return lanes[k].sampled.*member;
    });
  };
  const auto square = [&](auto member) {
    return matrix_from_lanes<Scalar, 4, 4>([&](std::size_t k) -> const auto& {
      return lanes[k].sampled.*member;
    });
  };
  using Loop = SampledLoop<double>;
  return {{number(&Sampling<double>::period), number(&Sampling<double>::processing_delay)},
          square(&Loop::transition),
          square(&Loop::increment),
          vector(&Loop::previous_force),
          vector(&Loop::present_force),
          vector(&Loop::held_excitation)};
}

/// The input of the excitation of every lane.
template <class Scalar>
HarmonicInput<Scalar> input_from_lanes(
    const std::array<SweepMatrices::Matrices, Lanes<Scalar>::count>& lanes) {
  const auto vector = [&](auto member) {
    return matrix_from_lanes<Scalar, 4, 1>([&](std::size_t k) -> const auto& {
      return lanes[k].input.*member;
    });
  };
  return {vector(&HarmonicInput<double>::cosine), vector(&HarmonicInput<double>::sine)};
}

}  // namespace holdfast::detail
