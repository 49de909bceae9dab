#pragma once

#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/case.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"
#include "holdfast/orbit/proof/event_orbit_proof.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"
#include "holdfast/orbit/proof/orbit_range.hpp"
#include "holdfast/orbit/switching_borders.hpp"
#include "text/names.hpp"

namespace holdfast::program {

/// Switching surfaces, in tables and messages.
inline constexpr Named<SwitchingSurface> surface_names[] = {
    {SwitchingSurface::reversal, "reversal"},
    {SwitchingSurface::gap_lower, "gap_lower"},
    {SwitchingSurface::gap_upper, "gap_upper"}};

/// Switching surfaces of a drive that switches between the samples.
inline constexpr Named<ContactSurface> contact_surface_names[] = {
    {ContactSurface::reversal, "reversal"},
    {ContactSurface::gap_lower, "gap_lower"},
    {ContactSurface::gap_upper, "gap_upper"},
    {ContactSurface::free_acceleration, "free_acceleration"},
    {ContactSurface::driven_acceleration, "driven_acceleration"},
    {ContactSurface::sampling_instant, "sampling_instant"}};

/// Outcomes of proofs, in tables.
inline constexpr Named<OrbitProofOutcome> orbit_proof_names[] = {
    {OrbitProofOutcome::proved, "proved"},
    {OrbitProofOutcome::not_contracting, "not_contracting"},
    {OrbitProofOutcome::other_contacts, "other_contacts"},
    {OrbitProofOutcome::not_closed, "not_closed"},
    {OrbitProofOutcome::near_surface, "near_surface"},
    {OrbitProofOutcome::no_ball, "no_ball"}};

/// The proof of a case's orbit. Throws NoAnswer, saying what could not be decided and by how much.
OrbitProof proved_orbit_of(const Case& the_case, const PeriodicOrbit& orbit);

/// The proof of an orbit of a drive that switches between the samples.
EventOrbitProof proved_orbit_of(const IdealLoop<double>& loop,
                                const EventOrbitResult<DriveContact<>>& found);

/// The unit of what a test is about: of Δz, Δż or an acceleration, or of a derivative by time.
std::string unit_of(const ContactTest& test);

/// The ranges of a key of the case in which the orbit is proved, and what is between. Throws
/// Interrupted, and WrongInput for a key in which the loop is not linear.
std::vector<ProvedOrbitRange> proved_orbit_along(const Case& the_case, const PeriodicOrbit& orbit,
                                                 const std::string& key, const Range& range);

}  // namespace holdfast::program
