#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
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
/// gap that the drive is in, are measured by eᵀV e, V − MᵀV M > 0, M being what some periods of the
/// orbit make of them: they make that smaller. The drive must be inside or outside as on the orbit,
/// and Δż of the last sample of the same sign. An orbit that stays in the gap for ever does so in
/// every gap that holds it: there the radius counts for a metre of clearance.
struct ModalAttraction {
  Eigen::VectorXd first;          ///< the state of the orbit, of ModalItineraryMaps
  BacklashMemory<double> memory;  ///< of the drive before its first sample
  bool stays_inside;              ///< the drive never leaves its gap
  double lowest,                  ///< least Δz of the orbit (m)
      highest;                    ///< largest Δz of the orbit (m)
  Eigen::MatrixXd root;           ///< R, V = RᵀR
  double radius;                  ///< of ‖R e‖ (m); > 0, ∞ where nothing switches
  double inscribed_share;         ///< 1/‖R‖_F: the ball ‖e‖ < radius · share lies in it
};

/// The neighbourhood of an orbit.
///
/// Along the period no decision changes while |h Φ e| stays below the distance from the surface, h
/// being the surface's normal and Φ the flow of deviations: that is sure for ‖R e‖ less than the
/// least distance / ‖h Φ R⁻¹‖, and what follows begins with a smaller ‖R e‖. V is that of one
/// period, or of the fewest of 2, 4, … 64 of which rounding does not hide that they contract.
/// @param loop   the loop that the orbit is of
/// @param maps   of it
/// @param orbit  attracting and certified
/// @return nothing where no V is found that M is seen to contract, to working precision
/// @tparam Loop  ModalLoop; a template so that only who calls it compiles it
template <class Loop>
std::optional<ModalAttraction> modal_attraction(const Loop& loop, const ModalItineraryMaps& maps,
                                                const PeriodicOrbit& orbit) {
  using Flow = detail::DeviationFlow<ModalDeviations>;
  const Flow flow(maps.deviations(), loop.backlash_width, orbit);
  maps.look();
  Eigen::MatrixXd power = Flow(flow).over(orbit.period_samples());
  const Eigen::Index order = flow.order() - 1;
  const auto solution = periodic_solution(
      maps, orbit.itinerary, std::vector<Eigen::MatrixXd>{power.topLeftCorner(order, order)});
  if (!solution) return std::nullopt;
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
  for (std::int64_t periods = 1; periods <= 64; periods *= 2) {
    maps.look();
    const std::optional<Eigen::MatrixXd> measure = discrete_lyapunov(power);
    if (!measure) {
      power = Eigen::MatrixXd(power * power);
      continue;
    }
    found.root = Eigen::LLT<Eigen::MatrixXd>(*measure).matrixU();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(flow.order(), flow.order());
    const Eigen::MatrixXd sphere = found.root.triangularView<Eigen::Upper>().solve(unit);
    detail::DeviationSegment segment;
    Flow(flow).follow(sphere, periods * orbit.period_samples(), segment);
    found.radius = segment.radius;
    found.inscribed_share = 1.0 / found.root.norm();
    if (found.radius > 0.0) return found;
    return std::nullopt;
  }
  return std::nullopt;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::optional<ModalAttraction> modal_attraction(const ModalLoop&,
                                                                const ModalItineraryMaps&,
                                                                const PeriodicOrbit&);
#endif

}  // namespace holdfast
