#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"
#include "holdfast/orbit/proof/segment_of_loops.hpp"

namespace holdfast {

/// A closed range of a parameter, with one proof attempt for all loops of the range.
struct ProvedOrbitRange {
  double from;       ///< least value of the parameter
  double to;         ///< largest value of the parameter
  OrbitProof proof;  ///< outcome and bounds for every loop of the range; no ball (radius 0)
};

namespace detail {

/// The proof for the union of two neighbouring ranges with the same outcome.
inline OrbitProof joined(const OrbitProof& a, const OrbitProof& b) {
  OrbitProof both = b.decided_by < a.decided_by ? b : a;
  both.multiplier_bound = std::max(a.multiplier_bound, b.multiplier_bound);
  both.displacement_error = std::max(a.displacement_error, b.displacement_error);
  both.velocity_error = std::max(a.velocity_error, b.velocity_error);
  both.widths = {std::max(a.widths.from, b.widths.from), std::min(a.widths.to, b.widths.to)};
  return both;
}

/// Whether two loops differ at most in gains P and D, force amplitude F_m and backlash width r₀.
inline bool differ_linearly(const IdealLoop<double>& a, const IdealLoop<double>& b) {
  const auto others = [](const IdealLoop<double>& loop) {
    const TwoMass<double>& plant = loop.plant;
    return std::array<double, 9>{
        plant.conductor_mass, plant.conductor_stiffness,      plant.conductor_damping,
        plant.absorber_mass,  plant.absorber_stiffness,       plant.absorber_damping,
        loop.sampling.period, loop.sampling.processing_delay, loop.excitation.frequency};
  };
  return others(a) == others(b) && a.hold == b.hold;
}

/// Proves an orbit with the given orbit's itinerary for every loop between two parameter values.
template <class Scalar, class Family>
OrbitProof proof_between(const Family& family, const PeriodicOrbit& orbit, Scalar from, Scalar to) {
  const auto solved = [&](const IdealLoop<Scalar>& loop) {
    return orbit_of_itinerary(loop, orbit.ratio, ItineraryMaps<Scalar>(loop, orbit.ratio),
                              orbit.itinerary, Backlash<Scalar>(loop.backlash_width, orbit.memory));
  };
  const IdealLoop<Scalar> first = family(from), last = family(to);
  const OrbitResult at_first = solved(first), at_last = solved(last),
                    between = solved(family(0.5 * from + 0.5 * to));
  if (!at_first.orbit || !at_last.orbit || !between.orbit) return {};
  const SegmentOfLoops loops(enclosed(first), enclosed(last), orbit.ratio);
  OrbitProver prover(loops, *between.orbit, at_first.orbit->states, at_last.orbit->states);
  return prover.prove(std::numeric_limits<double>::infinity());
}

}  // namespace detail

/// Proves, range by range, that a loop has an orbit for all values of a parameter. Where the proof
/// fails, the range is halved, down to the length `narrowest` · (to − from).
///
/// In a range the maps are linear in the parameter, and the states are interpolated linearly. The
/// error of the states is therefore quadratic in the length of the range, and ranges can be wide.
/// @param family    function: parameter ↦ IdealLoop<double>. The gains P and D, the force's
///                  amplitude and the backlash width are linear in the parameter, all else constant
/// @param orbit     orbit of a loop of the family; the proved orbits have the same itinerary
/// @param from, to  ends of the parameter's range, finite, from < to
/// @param narrowest least width of a range as a share of to − from, 10⁻⁹ … 1
/// @return ranges in ascending order, proved or not; adjacent ranges of equal outcome are joined
/// @throws InvalidParameter where an argument is out of its range or the loops differ in other data
template <class Family, class Scalar = double>
std::vector<ProvedOrbitRange> prove_orbit_along(const Family& family, const PeriodicOrbit& orbit,
                                                Scalar from, Scalar to, double narrowest = 1e-3) {
  require_finite("start of the range", from, "");
  require_finite("end of the range", to, "");
  require_positive("length of the range", to - from, "");
  require_within("narrowest range as a share of the whole", narrowest, "", 1e-9, 1.0);
  if (!detail::differ_linearly(family(from), family(to)))
    throw InvalidParameter(
        "range of the parameter", to - from, "",
        "one over which only P, D, the force's amplitude and the backlash width change");
  detail::validate_proposal(family(from), orbit);
  std::vector<ProvedOrbitRange> proved;
  std::vector<Scalar> open{to};  // upper ends of the ranges still to be proved, the next one last
  for (Scalar left = from; !open.empty();) {
    const Scalar right = open.back(), middle = 0.5 * left + 0.5 * right;
    const OrbitProof proof = detail::proof_between<Scalar>(family, orbit, left, right);
    const bool is_proved = proof.outcome == OrbitProofOutcome::proved;
    if (!is_proved && right - left > narrowest * (to - from) && left < middle && middle < right) {
      open.push_back(middle);
      continue;
    }
    const bool joins = !proved.empty() && proved.back().proof.outcome == proof.outcome;
    if (joins) {
      proved.back().to = right;
      proved.back().proof = detail::joined(proved.back().proof, proof);
    } else {
      proved.push_back({left, right, proof});
    }
    open.pop_back();
    left = right;
  }
  return proved;
}

}  // namespace holdfast
