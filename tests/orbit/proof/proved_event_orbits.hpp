#pragma once

#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/proof/event_orbit_proof.hpp"
#include "orbit/proof/proved_orbits.hpp"

namespace holdfast::test {

/// An orbit that switches between the samples, and where it begins.
struct ProposedEventOrbit {
  IdealLoop<double> loop;
  EventOrbit orbit;
  StroboscopicState<DriveContact<>> first;

  EventOrbitProof proof(double largest_miss = 1e-10) const {
    return prove_event_orbit(loop, orbit, first, largest_miss);
  }
  ImplementedLoop switching() const { return switching_exactly(loop); }
  static ImplementedLoop switching_exactly(const IdealLoop<double>& loop) {
    ImplementedLoop exact = implemented_loop(loop);
    exact.switching = Switching::exact;
    return exact;
  }
  /// Its motion, from a point on.
  RepeatingMotion<DriveContact<>> motion() const {
    return {event_motion(switching(), first.state), orbit.ratio.denominator};
  }
  detail::RecordedContacts recorded(const StroboscopicState<DriveContact<>>& from) const {
    return detail::recorded_contacts(motion(), from,
                                     static_cast<std::size_t>(orbit.period_samples()));
  }
};

/// Where the motion from rest comes to.
inline ProposedEventOrbit event_orbit_to_prove(const IdealLoop<double>& loop) {
  const auto found = find_event_orbit(
      event_motion(ProposedEventOrbit::switching_exactly(loop), Vector<double, 4>::Zero().eval()));
  EXPECT_EQ(found.outcome, OrbitOutcome::certified) << loop.sampling.period;
  return {loop, found.orbit.value(), found.point.value()};
}

/// Those of the paper's loops.
inline std::vector<ProposedEventOrbit> event_orbits_to_prove() {
  std::vector<ProposedEventOrbit> all;
  for (const auto& [period, width] :
       {std::pair{0.001, 0.0005}, std::pair{0.001, 0.002}, std::pair{0.01, 0.002},
        std::pair{0.011, 0.002}, std::pair{0.011, 0.001}, std::pair{0.003, 0.002},
        std::pair{0.01, 0.001}})
    all.push_back(event_orbit_to_prove(proved_loop(period, width)));
  all.push_back(event_orbit_to_prove(proved_loop(0.01, 0.002, 0.005)));
  all.push_back(event_orbit_to_prove(proved_loop(0.001, 0.0005, 0.001)));
  IdealLoop<double> smooth = proved_loop(0.001, 0.0005);
  smooth.hold = ForceHold::exact;
  all.push_back(event_orbit_to_prove(smooth));
  return all;
}

/// The same period and contacts with another P or D, by Newton's method from a neighbour.
inline std::optional<ProposedEventOrbit> continued(const ProposedEventOrbit& near,
                                                   const PdGains<double>& gains) {
  ProposedEventOrbit other = near;
  other.loop.gains = gains;
  const auto motion = other.motion();
  const auto units = detail::return_units(
      motion.motion(), StateScaleOf<TwoMass<double>>(motion.motion().readings()), {});
  ReturnMap<DriveContact<>> map(motion, near.orbit.period_samples(), units, true);
  const auto point = map.fixed_point(near.first);
  if (!point) return std::nullopt;
  other.first = *point;
  other.orbit.multipliers = map.multipliers(*point);
  const detail::RecordedContacts path = other.recorded(*point);
  for (std::size_t j = 0; j < path.samples.size(); ++j)
    other.orbit.states[j] = path.samples[j].state.head<4>();
  return other;
}

}  // namespace holdfast::test
