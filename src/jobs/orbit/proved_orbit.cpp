#include "jobs/orbit/proved_orbit.hpp"

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "jobs/job_texts.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {

OrbitProof proved_orbit_of(const Case& the_case, const PeriodicOrbit& orbit) {
  const OrbitProof proof = prove_orbit(ideal_loop_of(the_case), orbit);
  if (proof.outcome == OrbitProofOutcome::proved) return proof;
  const bool reverses = proof.nearest.surface == SwitchingSurface::reversal;
  const double error = std::abs(proof.nearest.distance / proof.decided_by);
  throw NoAnswer(text_of(job_texts()["not proved"][name_in(orbit_proof_names, proof.outcome)],
                         {{"surface", name_in(surface_names, proof.nearest.surface)},
                          {"sample", std::to_string(proof.nearest.sample)},
                          {"distance", format_number(proof.nearest.distance)},
                          {"error", format_number(error)},
                          {"unit", reverses ? "m/s" : "m"},
                          {"multiplier", format_number(orbit.largest_multiplier())},
                          {"states", format_number(proof.displacement_error)}}));
}

std::string unit_of(const ContactTest& test) {
  if (test.surface == ContactSurface::sampling_instant) return "s";
  const bool of_acceleration = test.surface == ContactSurface::free_acceleration ||
                               test.surface == ContactSurface::driven_acceleration;
  const int seconds = test.order + (of_acceleration                            ? 2
                                    : test.surface == ContactSurface::reversal ? 1
                                                                               : 0);
  if (seconds == 0) return "m";
  return seconds == 1 ? "m/s" : "m/s" + std::to_string(seconds);
}

EventOrbitProof proved_orbit_of(const IdealLoop<double>& loop,
                                const EventOrbitResult<DriveContact<>>& found) {
  const EventOrbitProof proof = prove_event_orbit(loop, *found.orbit, *found.point);
  if (proof.outcome == OrbitProofOutcome::proved) return proof;
  const ContactTest& nearest = proof.nearest;
  std::string reason = name_in(orbit_proof_names, proof.outcome);
  if (proof.outcome == OrbitProofOutcome::near_surface) reason = "near_event";
  if (proof.outcome == OrbitProofOutcome::not_closed) reason = "open_event";
  throw NoAnswer(text_of(job_texts()["not proved"][reason],
                         {{"surface", name_in(contact_surface_names, nearest.surface)},
                          {"sample", std::to_string(nearest.sample)},
                          {"instant", format_number(nearest.instant)},
                          {"distance", format_number(nearest.distance)},
                          {"error", format_number(nearest.error)},
                          {"unit", unit_of(nearest)},
                          {"multiplier", format_number(found.orbit->largest_multiplier())},
                          {"miss", format_number(proof.miss)}}));
}

std::vector<ProvedOrbitRange> proved_orbit_along(const Case& the_case, const PeriodicOrbit& orbit,
                                                 const std::string& key, const Range& range) {
  if (key.rfind("plant.", 0) == 0 || key == "control.processing_delay")
    throw WrongInput("--prove --follow " + key +
                     ": with --prove the key must be control.proportional_gain, "
                     "control.differential_gain, excitation.amplitude or backlash.width");
  const auto family = [&](double value) {
    throw_if_interrupted();
    return ideal_loop_of(case_with(the_case, key, value));
  };
  return prove_orbit_along(family, orbit, range.min, range.max);
}

}  // namespace holdfast::program
