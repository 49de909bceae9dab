#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/discrete_lyapunov.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/orbit/modal/modal_itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

/// A neighbourhood of the first sample of an orbit of a conductor by its modes: every motion in it,
/// at the same phase of the forcing, follows the orbit's itinerary for ever and tends to the orbit.
///
/// Deviations e, of every natural motion and of the force in metres (ModalDeviations) and of the
/// gap that the drive is in, are measured by eᵀV e, V − MᵀV M = I, M being what a period of the
/// orbit makes of them: every period makes that smaller. The drive must be inside or outside as on
/// the orbit, and Δż of the last sample of the same sign. An orbit that stays in the gap for ever
/// does so in every gap that holds it: there the radius counts for a metre of clearance.
struct ModalAttraction {
  Eigen::VectorXd first;          ///< the state of the orbit, of ModalItineraryMaps
  BacklashMemory<double> memory;  ///< of the drive before its first sample
  bool stays_inside;              ///< the drive never leaves its gap
  double lowest,                  ///< least Δz of the orbit (m)
      highest;                    ///< largest Δz of the orbit (m)
  Eigen::MatrixXd root;           ///< R, V = RᵀR
  double radius;                  ///< of ‖R e‖ (m); > 0, ∞ where nothing switches
  /// A ball ‖e‖ < r that lies in it, r = `radius` less than this share.
  double inscribed_share;
};

/// The neighbourhood of an orbit.
///
/// Along the period no decision changes while |h Φ e| stays below the distance from the surface, h
/// being the surface's normal and Φ the flow of deviations: that is sure for ‖R e‖ less than the
/// least distance / ‖h Φ R⁻¹‖, and each following period begins with a smaller ‖R e‖.
/// @param loop   the loop that the orbit is of
/// @param maps   of it
/// @param orbit  attracting and certified
/// @return nothing where no V is found that M is seen to contract, to working precision
/// @tparam Loop  ModalLoop; a template so that only who calls it compiles it
template <class Loop>
std::optional<ModalAttraction> modal_attraction(const Loop& loop, const ModalItineraryMaps& maps,
                                                const PeriodicOrbit& orbit) {
  using Flow = detail::DeviationFlow<ModalDeviations>;
  const auto solution =
      periodic_solution(maps, orbit.itinerary, maps_of_blocks(maps, orbit.itinerary));
  if (!solution) return std::nullopt;
  const Flow flow(maps.deviations(), loop.backlash_width, orbit);
  const Eigen::MatrixXd period = Flow(flow).over(orbit.period_samples());
  const std::optional<Eigen::MatrixXd> measure = discrete_lyapunov(period);
  if (!measure) return std::nullopt;
  ModalAttraction found;
  found.first = solution->first;
  found.memory = orbit.memory;
  found.stays_inside = orbit.memory.inside && orbit.engaged_fraction() == 0.0;
  found.lowest = std::numeric_limits<double>::infinity();
  found.highest = -found.lowest;
  for (const auto& state : orbit.states) {
    found.lowest = std::min(found.lowest, relative_displacement(state));
    found.highest = std::max(found.highest, relative_displacement(state));
  }
  found.root = Eigen::LLT<Eigen::MatrixXd>(*measure).matrixU();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(flow.order(), flow.order());
  detail::DeviationSegment segment;
  Flow(flow).follow(found.root.triangularView<Eigen::Upper>().solve(unit), orbit.period_samples(),
                    segment);
  found.radius = segment.radius;
  if (!(found.radius > 0.0)) return std::nullopt;
  found.inscribed_share =
      1.0 / std::sqrt(std::min(measure->trace(), measure->cwiseAbs().rowwise().sum().maxCoeff()));
  return found;
}

}  // namespace holdfast
