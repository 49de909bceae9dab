#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"

namespace holdfast {

/// Small deviations from a ModalMotion, one per column, while the contacts remain unchanged:
///
///     δξ_{j+1} = e^{sτ} δξ_j + γ₁ δu_{j−1} + γ₀ δu_j
///     δu_j = P δz_j + D δż_j while the drive transmits, δu_j = 0 in the backlash
///
/// The symbols are those of NaturalMotion. The coordinates of a deviation are [Re ξ; Im ξ of the
/// conjugate pairs; u_{j−1}], all scaled to metres: ξ by the displacement of the conductor at the
/// absorber for ξ = 1, a command by a bound of the displacement it causes in one period.
///
/// Two matrix products advance the deviations by a block of samples. Work per sample with m
/// coordinates: 60 m multiply-adds, at most 2 m per deviation and m per deviation and reading.
class ModalDeviations {
 public:
  using Columns = Eigen::MatrixXd;  ///< one deviation per column, order() rows
  using Readings = Columns;         ///< one row per recorded reading, one column per deviation
  static constexpr int block = 64;  ///< most samples per block, and between take_readings() calls

  /// Constructs the deviations, initially the unit vectors of all coordinates.
  /// @param motions  natural motions of the loop
  /// @param gains    gains P and D, in effect while the drive transmits
  ModalDeviations(const NaturalMotions& motions, const PdGains<double>& gains)
      : count_(static_cast<Eigen::Index>(motions.size())),
        pairs_(static_cast<Eigen::Index>(motions.pairs())),
        units_(count_ + pairs_ + 1),
        decay_(count_, block + 1),
        past_(count_, block),
        answers_(Columns::Zero(order(), block)),
        commands_(block, order()),
        readings_(2 * block, order()) {
    Eigen::VectorXcd command(count_), relative_z(count_), relative_v(count_);
    double push = 0.0, largest = 0.0;
    for (Eigen::Index k = 0; k < count_; ++k) {
      const NaturalMotion& of = motions[static_cast<std::size_t>(k)];
      largest = std::max(largest, std::abs(of.z));
      push += std::abs(of.z) * (std::abs(of.present) + std::abs(of.past));
      command[k] = gains.proportional * of.z + gains.differential * of.v;
      relative_z[k] = of.z2 - of.z;
      relative_v[k] = of.v2 - of.v;
      decay_(k, 0) = 1.0;
      for (Eigen::Index j = 0; j < block; ++j) {
        decay_(k, j + 1) = of.decay * decay_(k, j);
        past_(k, j) = of.past * decay_(k, j);
        const std::complex<double> answer =
            of.present * decay_(k, j) + (j > 0 ? past_(k, j - 1) : 0.0);
        answers_(k, j) = answer.real();
        if (k < pairs_) answers_(count_ + k, j) = answer.imag();
      }
    }
    answers_(order() - 1, 0) = 1.0;
    // A motion with a node at the absorber would have an infinite unit without this bound.
    const double least = largest > 0.0 ? 1e-12 * largest : 1.0;
    for (Eigen::Index k = 0; k < count_; ++k) {
      const double shown = std::abs(motions[static_cast<std::size_t>(k)].z);
      units_[k] = 1.0 / std::max(shown, least);
    }
    units_.segment(count_, pairs_) = units_.head(pairs_);
    units_[order() - 1] = push > 0.0 ? 1.0 / push : 1.0;
    command_ = sensor(command);
    relative_z_ = sensor(relative_z);
    relative_v_ = sensor(relative_v);
    begin(Columns::Identity(order(), order()));
  }

  /// The number of coordinates: the order of the plant plus one.
  Eigen::Index order() const { return units_.size(); }
  /// The unscaled values of [Re ξ; Im ξ; u_{j−1}] that correspond to scaled coordinates of 1 m.
  const Eigen::VectorXd& units() const { return units_; }

  /// Restarts from given deviations: one per column, order() scaled coordinates (m) each.
  void begin(const Columns& deviations) {
    start_ = units_.asDiagonal() * deviations;
    taken_ = read_ = 0;
    commanded_.clear();
  }

  /// The deviations at the present sample, one per column, in scaled coordinates (m).
  Columns columns() {
    end_block();
    return units_.cwiseInverse().asDiagonal() * start_;
  }

  /// Records a reading: the deviations of Δz = z₂ − z (m). At most once per sample.
  void read_displacement() { readings_.row(read_++) = reading(relative_z_); }
  /// Records a reading: the deviations of Δż = ż₂ − ż (m/s). At most once per sample.
  void read_velocity() { readings_.row(read_++) = reading(relative_v_); }
  /// The readings recorded since the last call of this function, one per row, oldest first.
  Readings take_readings() {
    const Readings all = readings_.topRows(read_) * start_;
    read_ = 0;
    if (taken_ == block) end_block();
    return all;
  }

  /// Advances over one sampling period.
  /// @param engaged  whether the drive transmits the command u_j of the present sample
  /// @param most     largest number of samples in a block, 1 … 64; deviations that shrink strongly
  ///                 within a block lose accuracy: then choose a smaller number
  void advance(bool engaged, int most = block) {
    if (engaged) {
      commands_.row(static_cast<Eigen::Index>(commanded_.size())) = reading(command_);
      commanded_.push_back(taken_);
    }
    if (++taken_ >= most && read_ == 0) end_block();
  }

 private:
  /// The weights of a reading Σ Re(w ξ): row k of `of_start` for ξ at the start of the block, k
  /// samples earlier; `of_command[k]` for a command k + 1 samples earlier.
  struct Sensor {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> of_start;
    Eigen::VectorXd of_command;
  };

  Sensor sensor(const Eigen::VectorXcd& weights) const {
    Sensor of{Columns::Zero(block, order()), Eigen::VectorXd(block)};
    for (Eigen::Index j = 0; j < block; ++j) {
      const Eigen::VectorXcd here = weights.cwiseProduct(decay_.col(j));
      of.of_start.row(j) << here.real().transpose(), -here.head(pairs_).imag().transpose(),
          j > 0 ? weights.cwiseProduct(past_.col(j - 1)).sum().real() : 0.0;
      of.of_command[j] = weights.real().dot(answers_.col(j).head(count_)) -
                         weights.head(pairs_).imag().dot(answers_.col(j).segment(count_, pairs_));
    }
    return of;
  }

  Eigen::RowVectorXd reading(const Sensor& of) const {
    Eigen::RowVectorXd row = of.of_start.row(taken_);
    for (std::size_t i = 0; i < commanded_.size(); ++i)
      row +=
          of.of_command[taken_ - 1 - commanded_[i]] * commands_.row(static_cast<Eigen::Index>(i));
    return row;
  }

  void end_block() {
    if (taken_ == 0) return;
    const auto commands = static_cast<Eigen::Index>(commanded_.size());
    const Columns forces = commands_.topRows(commands) * start_;
    Columns answers(order(), commands);
    for (Eigen::Index i = 0; i < commands; ++i)
      answers.col(i) = answers_.col(taken_ - 1 - commanded_[static_cast<std::size_t>(i)]);
    const Eigen::ArrayXd turn = decay_.col(taken_).real(), lift = decay_.col(taken_).imag(),
                         real = past_.col(taken_ - 1).real(), imag = past_.col(taken_ - 1).imag();
    Eigen::ArrayXd before(pairs_);
    for (Eigen::Index j = 0; j < start_.cols(); ++j) {
      auto re = start_.col(j).head(count_).array();
      auto im = start_.col(j).segment(count_, pairs_).array();
      double& force = start_(order() - 1, j);
      before = re.head(pairs_);
      re = turn * re + real * force;
      re.head(pairs_) -= lift.head(pairs_) * im;
      im = turn.head(pairs_) * im + lift.head(pairs_) * before + imag.head(pairs_) * force;
      force = 0.0;
    }
    start_.noalias() += answers * forces;
    taken_ = 0;
    commanded_.clear();
  }

  Eigen::Index count_, pairs_;
  Eigen::VectorXd units_;
  Eigen::MatrixXcd decay_, past_;  // e^{jsτ} and γ₁ e^{jsτ}
  Columns answers_;  // change of the coordinates 1, 2, … samples after a unit command
  Sensor command_, relative_z_, relative_v_;
  Columns start_;               // raw deviations at the start of the block
  int taken_, read_;            // samples and readings since
  std::vector<int> commanded_;  // samples with a command
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> commands_, readings_;
};

}  // namespace holdfast
