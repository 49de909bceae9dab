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

/// Names of the switching surfaces, in tables and messages.
inline constexpr Named<SwitchingSurface> surface_names[] = {
    {SwitchingSurface::reversal, "reversal"},
    {SwitchingSurface::gap_lower, "gap_lower"},
    {SwitchingSurface::gap_upper, "gap_upper"}};

/// Names of the switching surfaces of a drive that switches between samples.
inline constexpr Named<ContactSurface> contact_surface_names[] = {
    {ContactSurface::reversal, "reversal"},
    {ContactSurface::gap_lower, "gap_lower"},
    {ContactSurface::gap_upper, "gap_upper"},
    {ContactSurface::free_acceleration, "free_acceleration"},
    {ContactSurface::driven_acceleration, "driven_acceleration"},
    {ContactSurface::sampling_instant, "sampling_instant"}};

/// Names of the outcomes of orbit proofs, in tables.
inline constexpr Named<OrbitProofOutcome> orbit_proof_names[] = {
    {OrbitProofOutcome::proved, "proved"},
    {OrbitProofOutcome::not_contracting, "not_contracting"},
    {OrbitProofOutcome::other_contacts, "other_contacts"},
    {OrbitProofOutcome::not_closed, "not_closed"},
    {OrbitProofOutcome::near_surface, "near_surface"},
    {OrbitProofOutcome::no_ball, "no_ball"}};

/// Proof of a case's orbit by interval arithmetic. Throws NoAnswer with the undecided condition.
OrbitProof proved_orbit_of(const Case& the_case, const PeriodicOrbit& orbit);

/// Proof of an orbit whose drive switches between samples. Throws NoAnswer if it fails.
EventOrbitProof proved_orbit_of(const IdealLoop<double>& loop,
                                const EventOrbitResult<DriveContact<>>& found);

/// Unit of the quantity of a contact test: Δz, Δż, an acceleration, or a higher time derivative.
std::string unit_of(const ContactTest& test);

/// Ranges of a key in which the orbit is proved, and the unproved ranges between them. Throws
/// Interrupted, and WrongInput for a key on which the loop does not depend linearly.
std::vector<ProvedOrbitRange> proved_orbit_along(const Case& the_case, const PeriodicOrbit& orbit,
                                                 const std::string& key, const Range& range);

}  // namespace holdfast::program
