#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"

namespace holdfast {

/// The deviations of a ModalMotion, one in each column, as long as they change no contact:
///
///     δξ_{j+1} = e^{sτ} δξ_j + γ₁ δu_{j−1} + γ₀ δu_j,   δu_j = P δz_j + D δż_j or 0 in the
///     backlash.
///
/// The coordinates are [Re ξ; Im ξ of the pairs; u_{j−1}] in metres. A natural motion is measured
/// by its share of the conductor's displacement at the absorber, a force by the displacement that
/// it causes in a sampling period. Work per sample: 16 multiply-adds per natural motion and column.
class ModalDeviations {
 public:
  using Columns = Eigen::MatrixXd;  ///< order() × the number of deviations
  using Row = Eigen::RowVectorXd;   ///< one number for each deviation

  /// Constructs the deviations as unit vectors.
  /// @param motions  natural motions of the loop
  /// @param gains    P and D while the drive transmits
  ModalDeviations(const NaturalMotions& motions, const PdGains<double>& gains)
      : count_(static_cast<Eigen::Index>(motions.size())),
        pairs_(static_cast<Eigen::Index>(motions.pairs())),
        units_(count_ + pairs_ + 1) {
    for (Part* part : {&decay_, &present_, &past_, &command_, &relative_z_, &relative_v_})
      part->resize(count_);
    double push = 0.0, largest = 0.0;
    for (Eigen::Index k = 0; k < count_; ++k) {
      const NaturalMotion& of = motions[static_cast<std::size_t>(k)];
      largest = std::max(largest, std::abs(of.z));
      push += std::abs(of.z) * (std::abs(of.present) + std::abs(of.past));
      decay_.set(k, of.decay);
      present_.set(k, of.present);
      past_.set(k, of.past);
      command_.set(k, gains.proportional * of.z + gains.differential * of.v);
      relative_z_.set(k, of.z2 - of.z);
      relative_v_.set(k, of.v2 - of.v);
    }
    // A motion with a node at the absorber would have an infinite unit without this bound.
    const double least = largest > 0.0 ? 1e-12 * largest : 1.0;
    for (Eigen::Index k = 0; k < count_; ++k) {
      const double shown = std::abs(motions[static_cast<std::size_t>(k)].z);
      units_[k] = 1.0 / std::max(shown, least);
    }
    units_.segment(count_, pairs_) = units_.head(pairs_);
    units_[count_ + pairs_] = push > 0.0 ? 1.0 / push : 1.0;
    begin(Columns::Identity(order(), order()));
  }

  /// The number of coordinates: the order of the plant plus one.
  Eigen::Index order() const { return units_.size(); }
  /// The values of [Re ξ; Im ξ; u_{j−1}] that correspond to 1 m in each coordinate.
  const Eigen::VectorXd& units() const { return units_; }

  /// Restarts from given deviations, in metres.
  void begin(const Columns& deviations) {
    const Columns raw = units_.asDiagonal() * deviations;
    re_ = raw.topRows(count_);
    im_ = Columns::Zero(count_, raw.cols());
    im_.topRows(pairs_) = raw.middleRows(count_, pairs_);
    force_ = raw.row(count_ + pairs_);
  }

  /// The deviations, in metres.
  Columns columns() const {
    Columns all(order(), force_.size());
    all << re_, im_.topRows(pairs_), force_;
    return units_.cwiseInverse().asDiagonal() * all;
  }

  /// Deviations of Δz (m), each in its column.
  Row relative_displacement() const { return read(relative_z_); }
  /// Deviations of Δż (m/s).
  Row relative_velocity() const { return read(relative_v_); }

  /// Advances over one sampling period; `engaged`: whether the drive transmits the new command.
  void advance(bool engaged) {
    for (Eigen::Index j = 0; j < force_.size(); ++j) {
      auto re = re_.col(j), im = im_.col(j);
      const double force = engaged ? command_.re.dot(re) - command_.im.dot(im) : 0.0;
      // All terms in one pass: their matrices one by one would not stay in the processor's cache.
      for (Eigen::Index k = 0; k < count_; ++k) {
        const double real = re[k], imag = im[k];
        re[k] = decay_.re[k] * real - decay_.im[k] * imag + present_.re[k] * force +
                past_.re[k] * force_[j];
        im[k] = decay_.re[k] * imag + decay_.im[k] * real + present_.im[k] * force +
                past_.im[k] * force_[j];
      }
      force_[j] = force;
    }
  }

 private:
  /// A complex number for each natural motion.
  struct Part {
    Eigen::VectorXd re, im;
    void resize(Eigen::Index count) {
      re.resize(count);
      im.resize(count);
    }
    void set(Eigen::Index k, const std::complex<double>& value) {
      re[k] = value.real();
      im[k] = value.imag();
    }
  };

  /// The sum Σ Re(w ξ) over the natural motions, for every deviation; w are the weights.
  Row read(const Part& w) const { return w.re.transpose() * re_ - w.im.transpose() * im_; }

  Eigen::Index count_, pairs_;
  Eigen::VectorXd units_;
  Part decay_, present_, past_, command_, relative_z_, relative_v_;
  Columns re_, im_;
  Row force_;
};

}  // namespace holdfast
