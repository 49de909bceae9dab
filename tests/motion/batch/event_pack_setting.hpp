#pragma once

#include "holdfast/motion/batch/event_pack.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "support/kollar_case.hpp"
#include "support/random_loop.hpp"
#include "support/switch_notes.hpp"

namespace holdfast::test {

/// A motion with exact switching: its loop and its begin.
struct ExactMotion {
  ImplementedLoop loop;
  Vector<double, 4> state;
};

/// The loop of Kollár 2022, §4.2, from rest.
inline ExactMotion kollar_exact(double period, double width, double delay = 0.0,
                                ForceHold hold = ForceHold::exact) {
  KollarCase which = kollar_case(period, width);
  which.processing_delay = delay;
  IdealLoop<double> ideal = which.ideal_loop();
  ideal.hold = hold;
  ImplementedLoop loop = implemented_loop(ideal);
  loop.backlash.law = ContactLaw::play;
  loop.switching = Switching::exact;
  return {loop, Vector<double, 4>::Zero()};
}

/// One that differs from any other in every parameter: play or stops, no, one or more harmonics,
/// held or exact, with and without delay and backlash.
inline ExactMotion random_exact(Random& random) {
  ImplementedLoop loop{random_plant(random), {}, {}, Switching::exact};
  DigitalLoop& digital = loop.digital;
  digital.sampling = random_sampling(loop.plant, random);
  digital.gains = random_gains(loop.plant, digital.sampling.period, random);
  digital.gains.proportional *= 0.01;
  digital.gains.differential *= 0.01;
  digital.hold = random.unit() < 0.5 ? ForceHold::sampled : ForceHold::exact;
  const double amplitude = random.log_uniform(1e-2, 10.0);
  for (std::size_t line = random.index(3); line-- > 0;)
    digital.force.harmonics.push_back(
        {amplitude * random.unit(), random.log_uniform(0.5, 50.0), random.uniform(-3.0, 3.0)});
  const double size = amplitude / loop.plant.conductor_stiffness;
  const ContactLaw laws[] = {ContactLaw::play, ContactLaw::kollar, ContactLaw::dead_zone,
                             ContactLaw::none};
  loop.backlash = {laws[random.index(4)],
                   random.unit() < 0.1 ? 0.0 : size * random.log_uniform(1e-2, 1.0),
                   loop.plant.absorber_stiffness * random.log_uniform(0.1, 10.0),
                   loop.plant.absorber_damping * random.unit()};
  Vector<double, 4> state = Vector<double, 4>::Zero();
  if (random.unit() < 0.7) state = size * random.matrix<Vector<double, 4>>();
  return {loop, state};
}

/// What a motion went through: its changes of contact, and its state at every sample.
struct SeenMotion {
  std::vector<MotionSwitch> switches;
  std::vector<Vector<double, 4>> states;
  bool accumulates = false;
};

/// By EventMotion.
inline SeenMotion seen_alone(const ExactMotion& exact, std::int64_t samples) {
  SeenMotion seen;
  auto motion = event_motion(exact.loop, exact.state);
  SwitchNotes notes(motion);
  for (std::int64_t j = 0; j < samples; ++j) {
    seen.states.push_back(motion.state());
    notes.move(1);
  }
  seen.switches = notes.switches;
  seen.accumulates = motion.counts().accumulates;
  return seen;
}

struct LaneWatch {
  std::vector<SeenMotion>& seen;
  std::int64_t sample;
  void switched(std::size_t lane, int from, int to, int, double after) {
    if (lane < seen.size()) seen[lane].switches.push_back({sample, after, from, to});
  }
};

/// By EventPack, as many as fit into one; the lanes beyond them sleep.
template <class Scalar>
std::vector<SeenMotion> seen_in_pack(const std::vector<ExactMotion>& motions,
                                     std::int64_t samples) {
  using Pack = EventPack<Scalar>;
  std::vector<EventTable> tables;
  for (const ExactMotion& motion : motions) tables.emplace_back(motion.loop);
  std::array<EventStart, Pack::lanes> starts;
  for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
    const std::size_t k = std::min(lane, motions.size() - 1);
    starts[lane] = {&motions[k].loop, &tables[k], motions[k].state};
  }
  Pack pack(starts);
  for (std::size_t lane = motions.size(); lane < Pack::lanes; ++lane) pack.sleep(lane);
  std::vector<SeenMotion> seen(motions.size());
  for (std::int64_t j = 0; j < samples; ++j) {
    std::vector<int> before;
    for (std::size_t lane = 0; lane < motions.size(); ++lane) {
      seen[lane].states.push_back(pack.state(lane));
      before.push_back(pack.contact(lane).mode());
    }
    pack.sense();
    for (std::size_t lane = 0; lane < motions.size(); ++lane)
      if (pack.contact(lane).mode() != before[lane])
        seen[lane].switches.push_back({j, 0.0, before[lane], pack.contact(lane).mode()});
    pack.advance(LaneWatch{seen, j});
  }
  for (std::size_t lane = 0; lane < motions.size(); ++lane)
    seen[lane].accumulates = pack.accumulates(lane);
  return seen;
}

/// All of them, pack by pack; the last one may be filled in part.
template <class Scalar>
std::vector<SeenMotion> seen_in_packs(const std::vector<ExactMotion>& motions,
                                      std::int64_t samples) {
  constexpr std::size_t lanes = EventPack<Scalar>::lanes;
  std::vector<SeenMotion> all;
  for (std::size_t first = 0; first < motions.size(); first += lanes) {
    const auto begin = motions.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(lanes, motions.size() - first);
    for (auto& seen :
         seen_in_pack<Scalar>({begin, begin + static_cast<std::ptrdiff_t>(count)}, samples))
      all.push_back(std::move(seen));
  }
  return all;
}

/// How far two ways of one motion are apart.
struct MotionGap {
  bool same_contacts;  ///< the same changes of contact, one after the other
  double instants;     ///< s
  double states;       ///< share of the largest
};

inline MotionGap gap_between(const SeenMotion& one, const SeenMotion& other) {
  MotionGap gap{one.switches.size() == other.switches.size(), 0.0, 0.0};
  for (std::size_t k = 0; gap.same_contacts && k < one.switches.size(); ++k) {
    const MotionSwitch &a = one.switches[k], &b = other.switches[k];
    gap.same_contacts = a.sample == b.sample && a.from == b.from && a.to == b.to;
    gap.instants = std::max(gap.instants, std::abs(a.after - b.after));
  }
  Vector<double, 4> largest = Vector<double, 4>::Constant(1e-300);
  for (const auto& state : one.states) largest = largest.cwiseMax(state.cwiseAbs());
  for (std::size_t j = 0; j < one.states.size(); ++j)
    gap.states = std::max(
        gap.states, (one.states[j] - other.states[j]).cwiseAbs().cwiseQuotient(largest).maxCoeff());
  return gap;
}

/// The motions of the paper's loop at all kinds of sampling, side by side.
inline std::vector<ExactMotion> regular_motions() {
  std::vector<ExactMotion> motions;
  for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled})
    for (const double period : {0.001, 0.005, 0.011})
      for (const double width : {0.0, 0.0005, 0.002})
        for (const double delay : {0.0, 0.4, period < 0.01 ? 1.0 : 0.2})  // chaotic at 11 ms
          motions.push_back(kollar_exact(period, width, delay * period, hold));
  return motions;
}

}  // namespace holdfast::test
