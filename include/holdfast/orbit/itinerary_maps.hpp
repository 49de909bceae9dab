#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/state_scaling.hpp"

namespace holdfast {

/// Contacts of successive samples: 1 where the drive transmits, 0 in its backlash.
using Itinerary = std::vector<std::uint8_t>;

/// The affine maps that move z̃ = [z; u_{j−1}] over one sampling period,
///
///     z̃_{j+1} = S z̃_j + [a_j; 0] while the drive transmits, S* z̃_j + [a_j; 0] in the backlash,
///
/// where the excitation's a_j repeat every q samples. Source: Kollár 2022, Eq. (14).
template <class Scalar>
class ItineraryMaps {
 public:
  /// @param loop   its backlash width is not looked at
  /// @param ratio  f τ = p/q, of forcing_ratio()
  ItineraryMaps(const IdealLoop<Scalar>& loop, const Rational& ratio);

  /// S or S*, 5 × 5.
  const Matrix<Scalar, 5>& map(bool engaged) const { return engaged ? engaged_ : backlash_; }

  /// plant_scaling() of the loop.
  const Vector<Scalar, 5>& units() const { return units_; }

  /// A map of z̃ as one of z̃ in the units.
  Matrix<Scalar, 5> in_units(const Matrix<Scalar, 5>& map) const {
    return units_.cwiseInverse().asDiagonal() * map * units_.asDiagonal();
  }

  /// How unequally a sample may stretch directions outside its null space: the largest ratio
  /// of pivots of the plant's part of either map.
  Scalar spread() const { return std::max(spread_of(engaged_), spread_of(backlash_)); }

  /// a_j of phase j (4 × 1), 0 ≤ phase < samples_of_forcing().
  const Vector<Scalar, 4>& addition(std::size_t phase) const { return forcing_.additions()[phase]; }

  /// q.
  std::size_t samples_of_forcing() const { return forcing_.samples(); }

  /// z̃_{j+1} from z̃_j.
  Vector<Scalar, 5> step(const Vector<Scalar, 5>& state, bool engaged, std::size_t phase) const {
    Vector<Scalar, 5> next = map(engaged) * state;
    next.template head<4>() += addition(phase);
    return next;
  }

 private:
  ItineraryMaps(const SampledLoop<Scalar>& sampled, const IdealLoop<Scalar>& loop,
                const Rational& ratio);

  Scalar spread_of(const Matrix<Scalar, 5>& map) const;

  Matrix<Scalar, 5> engaged_;
  Matrix<Scalar, 5> backlash_;
  Vector<Scalar, 5> units_;
  PeriodicForcing<Scalar> forcing_;
};

template <class Scalar>
ItineraryMaps<Scalar>::ItineraryMaps(const IdealLoop<Scalar>& loop, const Rational& ratio)
    : ItineraryMaps(sampled_loop(loop.plant, loop.sampling), loop, ratio) {}

template <class Scalar>
ItineraryMaps<Scalar>::ItineraryMaps(const SampledLoop<Scalar>& sampled,
                                     const IdealLoop<Scalar>& loop, const Rational& ratio)
    : engaged_(sampled.engaged_map(loop.gains)),
      backlash_(sampled.backlash_map()),
      units_(plant_scaling(loop.plant.state_matrix(), loop.plant.excitation_input())),
      forcing_(harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency()),
               loop.excitation.amplitude, ratio) {}

template <class Scalar>
Scalar ItineraryMaps<Scalar>::spread_of(const Matrix<Scalar, 5>& map) const {
  using std::abs;
  const Matrix<Scalar, 4> plant = in_units(map).template topLeftCorner<4, 4>();
  const Eigen::FullPivLU<Matrix<Scalar, 4>> factors(plant);
  Scalar smallest = factors.maxPivot();
  for (int i = 0; i < factors.rank(); ++i)
    smallest = std::min(smallest, Scalar(abs(factors.matrixLU()(i, i))));
  return smallest > Scalar(0) ? Scalar(factors.maxPivot() / smallest) : Scalar(1);
}

/// How many samples may be multiplied without losing the digits of what they contract most.
template <class Scalar>
std::size_t samples_of_block(const ItineraryMaps<Scalar>& maps) {
  constexpr double largest_spread = 1e6, most = 8.0;
  const double spread = static_cast<double>(maps.spread());
  const double samples = std::log(largest_spread) / std::log(std::max(spread, 2.0));
  return static_cast<std::size_t>(std::clamp(samples, 1.0, most));
}

/// Some samples of an itinerary as one affine map each, in the units of the maps and few
/// enough for their product to lose no digits.
///
/// @param maps       of the loop
/// @param itinerary  of all samples, the first one at phase 0 of the forcing
template <class Scalar>
std::vector<AffineMap<Scalar>> affine_blocks(const ItineraryMaps<Scalar>& maps,
                                             const Itinerary& itinerary) {
  const std::size_t most_samples = samples_of_block(maps);
  const Vector<Scalar, 4> units = maps.units().template head<4>();
  const std::array<Matrix<Scalar, 5>, 2> balanced = {maps.in_units(maps.map(false)),
                                                     maps.in_units(maps.map(true))};
  const Scalar largest_growth(1e3);
  std::vector<AffineMap<Scalar>> blocks;
  blocks.reserve(itinerary.size() / most_samples + 1);
  std::size_t length = most_samples, phase = 0;
  for (const std::uint8_t contact : itinerary) {
    const bool engaged = contact != 0;
    const bool full =
        length == most_samples || !(blocks.back().map.cwiseAbs().maxCoeff() < largest_growth);
    if (full) {
      blocks.push_back({Matrix<Scalar, 5>::Identity(), Vector<Scalar, 5>::Zero()});
      length = 0;
    }
    AffineMap<Scalar>& block = blocks.back();
    block.map = balanced[engaged ? 1 : 0] * block.map;
    block.addition = balanced[engaged ? 1 : 0] * block.addition;
    block.addition.template head<4>() += maps.addition(phase).cwiseQuotient(units);
    ++length;
    if (++phase == maps.samples_of_forcing()) phase = 0;
  }
  return blocks;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template ItineraryMaps<double>::ItineraryMaps(const IdealLoop<double>&, const Rational&);
extern template double ItineraryMaps<double>::spread_of(const Matrix<double, 5>&) const;
extern template std::vector<AffineMap<double>> affine_blocks(const ItineraryMaps<double>&,
                                                             const Itinerary&);
#endif

}  // namespace holdfast
