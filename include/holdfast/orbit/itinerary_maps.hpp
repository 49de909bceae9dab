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
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The drive's contact at successive samples: 1 if it transmits its force, 0 in the backlash.
using Itinerary = std::vector<std::uint8_t>;

/// The affine maps of a two-mass loop over one sampling period. Its state is z̃_j = [z_j; u_{j−1}]
/// with the plant state z = [z₁, ż₁, z₂, ż₂] and the previous control force u_{j−1}:
///
///     z̃_{j+1} = S z̃_j + [a_j; 0] while the drive transmits, S* z̃_j + [a_j; 0] in the backlash.
///
/// The contribution a_j of the excitation repeats every q samples. Source: Kollár 2022, Eq. (14).
template <class Scalar>
class ItineraryMaps {
 public:
  using State = Vector<Scalar, 5>;      ///< state z̃ = [z; u_{j−1}]
  using Map = Matrix<Scalar, 5>;        ///< map of deviations of z̃
  using System = CyclicSystem<Scalar>;  ///< linear solver for a periodic motion

  /// @param loop   the loop; its backlash width is not used
  /// @param ratio  f τ = p/q, forcing frequency × sampling period, from forcing_ratio()
  ItineraryMaps(const IdealLoop<Scalar>& loop, const Rational& ratio)
      : ItineraryMaps(sampled_loop(loop.plant, loop.sampling), loop, ratio) {}

  /// The map of z̃ = [z; u_{j−1}] over a sample, 5 × 5: S if `engaged`, S* in the backlash.
  const Matrix<Scalar, 5>& map(bool engaged) const { return maps_[engaged ? 1 : 0]; }

  /// The units by which the entries of z̃ are divided for scaling, 5 × 1, from plant_scaling().
  const Vector<Scalar, 5>& units() const { return units_; }

  /// The map S (engaged) or S* (in the backlash) for the scaled state z̃_i / units()_i.
  Matrix<Scalar, 5> map_in_units(bool engaged) const {
    return units_.cwiseInverse().asDiagonal() * map(engaged) * units_.asDiagonal();
  }

  /// The largest number of samples (1 … 8) whose maps may be multiplied without losing the digits
  /// of strongly contracted directions. It is estimated from the 4 × 4 plant parts of S and S*: the
  /// ratio of the largest pivot to the smallest nonzero pivot.
  std::size_t samples_of_block() const;

  /// The number of samples q after which the excitation repeats (f τ = p/q).
  std::size_t samples_of_forcing() const { return forcing_.samples(); }

  /// The contributions a_0 … a_{q−1} of the excitation to the plant state z, each 4 × 1.
  const std::vector<Vector<Scalar, 4>>& additions() const { return forcing_.additions(); }

  /// The next state z̃_{j+1} from z̃_j = `state`; `phase` is j modulo q.
  Vector<Scalar, 5> step(const Vector<Scalar, 5>& state, bool engaged, std::size_t phase) const {
    Vector<Scalar, 5> next = map(engaged) * state;
    next.template head<4>() += forcing_.additions()[phase];
    return next;
  }

  /// Computes the states z̃_j for an itinerary. @return the state one sample after the last
  /// @param first      first state z̃₀
  /// @param itinerary  contact at each sample, the first sample at phase 0 of the excitation
  /// @param states     filled with the states z̃_j; must have one entry for each sample
  State follow(const State& first, const Itinerary& itinerary, std::vector<State>& states) const {
    states.front() = first;
    std::size_t phase = 0;
    for (std::size_t j = 0; j + 1 < itinerary.size(); ++j) {
      states[j + 1] = step(states[j], itinerary[j] != 0, phase);
      if (++phase == samples_of_forcing()) phase = 0;
    }
    return step(states.back(), itinerary.back() != 0, phase);
  }

  /// The state of rest, z̃ = 0.
  State rest() const { return State::Zero(); }
  /// The observed part [z; u_{j−1}] of a state; here the whole state.
  const State& seen(const State& state) const { return state; }

 private:
  ItineraryMaps(const SampledLoop<Scalar>& sampled, const IdealLoop<Scalar>& loop,
                const Rational& ratio)
      : maps_{sampled.backlash_map(), sampled.engaged_map(loop.gains)},
        units_(
            plant_scaling(Matrix<double, 4>(loop.plant.state_matrix().template cast<double>()),
                          Vector<double, 4>(loop.plant.excitation_input().template cast<double>()))
                .template cast<Scalar>()),
        forcing_(
            harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency()),
            loop.excitation.amplitude, ratio) {}

  std::array<Matrix<Scalar, 5>, 2> maps_;  // S*, S
  Vector<Scalar, 5> units_;
  PeriodicForcing<Scalar> forcing_;
};

template <class Scalar>
std::size_t ItineraryMaps<Scalar>::samples_of_block() const {
  constexpr double largest_spread = 1e6, most = 8.0;
  double spread = 2.0;
  for (const bool engaged : {false, true}) {
    const Matrix<Scalar, 4> plant = map_in_units(engaged).template topLeftCorner<4, 4>();
    const Eigen::FullPivLU<Matrix<Scalar, 4>> factors(plant);
    if (factors.rank() == 0) continue;
    const Scalar pivot = factors.matrixLU().diagonal().head(factors.rank()).cwiseAbs().minCoeff();
    spread = std::max(spread, static_cast<double>(factors.maxPivot() / pivot));
  }
  return static_cast<std::size_t>(
      std::clamp(std::log(largest_spread) / std::log(spread), 1.0, most));
}

/// The products of an itinerary's maps of the scaled state, one per block of samples
/// (BlockProducts). @param maps  maps of the loop
/// @param itinerary  contact at each sample of a period
template <class Scalar>
std::vector<Matrix<Scalar, 5>> maps_of_blocks(const ItineraryMaps<Scalar>& maps,
                                              const Itinerary& itinerary) {
  const std::array<Matrix<Scalar, 5>, 2> balanced{maps.map_in_units(false),
                                                  maps.map_in_units(true)};
  BlockProducts<Matrix<Scalar, 5>> products(maps.samples_of_block());
  for (const std::uint8_t contact : itinerary) products.append(balanced[contact != 0 ? 1 : 0]);
  return products.blocks();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::size_t ItineraryMaps<double>::samples_of_block() const;
extern template std::vector<Matrix<double, 5>> maps_of_blocks(const ItineraryMaps<double>&,
                                                              const Itinerary&);
#endif

}  // namespace holdfast
