// The same motion in other units: every sample of it and its exponents.

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/stability/design/max_delay.hpp"

#include "property/units_case.hpp"

namespace holdfast {
namespace {

using test::LoopCase;
using test::LoopInBothUnits;
using test::UnitsCase;

template <class Law>
SampledMotion<double, Law> motion_of(const LoopCase& drawn, const SampledLoop<double>& loop,
                                     const Law& law) {
  const double omega = drawn.excitation.angular_frequency();
  return {
      loop, drawn.gains, harmonic_input(drawn.plant, loop, drawn.hold(), omega), drawn.excitation,
      law,  drawn.state};
}

template <class Law>
test::PropertyOutcome samples_scale(const std::string& law, const UnitsCase& units,
                                    const LoopInBothUnits& loop) {
  const LoopCase rewritten = units.rewritten();
  auto first = motion_of(units.loop, loop.first, Law(units.loop.width));
  auto other = motion_of(rewritten, loop.other, Law(rewritten.width));
  for (int j = 0; j < units.loop.samples && test::is_moderate(first.state()); ++j) {
    const auto a = first.sense(), b = other.sense();
    const Vector<double, 4> back = b.state.cwiseQuotient(units.of_state());
    if (back != a.state || b.control_force != units.of_force() * a.control_force ||
        a.engaged != b.engaged || b.time != units.of_time() * a.time)
      return test::fails(
          test::differs(law + ", sample " + std::to_string(j) + ", z1", back[0], a.state[0]));
    first.advance();
    other.advance();
  }
  return test::holds();
}

/// Where the force is followed exactly its own exponential may be balanced otherwise.
test::PropertyOutcome motion_scales(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  if (!loop.same) return test::does_not_apply();
  const auto input_of = [](const LoopCase& of, const SampledLoop<double>& sampled) {
    return harmonic_input(of.plant, sampled, of.hold(), of.excitation.angular_frequency());
  };
  const auto a = input_of(units.loop, loop.first);
  const auto b = input_of(units.rewritten(), loop.other);
  const Vector<double, 4> unit = units.of_state() / units.of_force();
  const bool same_force =
      b.cosine == a.cosine.cwiseProduct(unit) && b.sine == a.sine.cwiseProduct(unit);
  if (!same_force) {
    const bool held = units.loop.exact_hold == 0;
    return held ? test::fails("the held force differs in its bits") : test::does_not_apply();
  }
  return test::all_of({samples_scale<Backlash<double>>("kollar", units, loop),
                       samples_scale<ImmediateBacklash<double>>("immediate", units, loop),
                       samples_scale<PlayBacklash<double>>("play", units, loop),
                       samples_scale<DeadZone<double>>("dead zone", units, loop)});
}

TEST(UnitsOfMotion, EverySampleScalesToTheLastBit) {
  test::expect_property(111, 2000, test::case_in_other_units, motion_scales, 0.75);
}

LyapunovSpectrum<double, 5> spectrum_of(const LoopCase& drawn, const SampledLoop<double>& loop) {
  LyapunovObserver observer(loop, drawn.gains);
  auto motion = motion_of(drawn, loop, Backlash<double>(drawn.width));
  for (int j = 0; j < drawn.samples && test::is_moderate(motion.state()); ++j) {
    observer(motion.sense());
    motion.advance();
  }
  return observer.spectrum();
}

/// n λ₁ is the logarithm of how far one tangent vector is stretched; measured in other units, that
/// changes by no more than the ratio of the units, however long the motion.
test::PropertyOutcome largest_exponent_stays(const UnitsCase& drawn) {
  UnitsCase units = drawn;
  units.loop.exact_hold = 0;
  const LoopInBothUnits loop(units);
  if (!loop.same) return test::does_not_apply();
  const auto first = spectrum_of(units.loop, loop.first);
  const auto other = spectrum_of(units.rewritten(), loop.other);
  if (first.steps() != other.steps() || first.steps() == 0)
    return test::fails("another number of steps");
  Vector<double, 5> logarithms;
  logarithms << units.of_state().array().log().matrix(), std::log(units.of_force());
  const double span = logarithms.maxCoeff() - logarithms.minCoeff();
  const double steps = static_cast<double>(first.steps());
  const double a = first.exponents()[0], b = other.exponents()[0];
  if (a == b) return test::holds();
  if (!(std::abs(b - a) * steps <= span + 1e-9 * steps))
    return test::fails(test::differs("largest exponent", b, a));
  return test::holds();
}

TEST(UnitsOfMotion, LargestLyapunovExponentStays) {
  test::expect_property(112, 1000, test::case_in_other_units, largest_exponent_stays, 0.75);
}

// A periodic motion is the same one in other units.

using test::Random;

OrbitLimits limits() {
  OrbitLimits limits;
  limits.largest_period = 2000;
  return limits;
}

/// A damped loop of which sampling and forcing coincide every 8 to 63 samples. The force is held,
/// since following it over a sample rounds otherwise in other units of time.
UnitsCase random_orbit_case(Random& random) {
  UnitsCase drawn = test::random_units_case(random, true);
  TwoMass<double>& plant = drawn.loop.plant;
  const auto critical = [](double mass, double stiffness) {
    return 2.0 * std::sqrt(mass * stiffness);
  };
  plant.conductor_damping += 0.02 * critical(plant.conductor_mass, plant.conductor_stiffness);
  plant.absorber_damping += 0.02 * critical(plant.absorber_mass, plant.absorber_stiffness);
  const auto samples = static_cast<double>(8 + random.index(56));
  drawn.loop.excitation.frequency = 1.0 / (samples * drawn.loop.period);
  drawn.loop.exact_hold = 0;
  return drawn;
}

/// A loop near that of the paper, whose motions have periodic orbits of many shapes, and its force
/// a whole number of samples long.
UnitsCase random_paper_case(Random& random) {
  UnitsCase drawn = test::random_units_case(random, true);
  test::LoopCase& loop = drawn.loop;
  loop.plant = kollar2022_plant();
  loop.plant.conductor_stiffness *= random.log_uniform(0.5, 2.0);
  loop.plant.absorber_stiffness *= random.log_uniform(0.5, 2.0);
  loop.excitation = {random.log_uniform(0.1, 1.0), 10.0};
  loop.period = 0.1 / (10.0 + static_cast<double>(random.index(60)));
  loop.delay_share = random.unit() < 0.5 ? 0.0 : random.unit();
  loop.gains = {-557.0 * random.unit(), -13.0 * random.unit()};
  loop.width = random.log_uniform(1e-5, 3e-3);
  loop.state.setZero();
  loop.exact_hold = 0;
  return drawn;
}

bool same_orbit(const PeriodicOrbit& one, const PeriodicOrbit& other, const UnitsCase& units) {
  if (one.itinerary != other.itinerary) return false;
  for (std::size_t j = 0; j < one.states.size(); ++j) {
    const Vector<double, 4> state = one.states[j].head<4>().cwiseProduct(units.of_state());
    if (state != other.states[j].head<4>()) return false;
  }
  return true;
}

/// Where the loop's matrices are the same to the last bit; rounding may send an irregular motion to
/// another orbit.
test::PropertyOutcome orbit_scales(const UnitsCase& units) {
  const test::LoopCase rewritten = units.rewritten();
  if (!test::LoopInBothUnits(units).same) return test::does_not_apply();
  const auto first = find_periodic_orbit(units.loop.loop(), units.loop.state, limits());
  const auto other = find_periodic_orbit(rewritten.loop(), rewritten.state, limits());
  const auto leaves = [](const OrbitResult& found) {
    return found.outcome == OrbitOutcome::diverges || found.outcome == OrbitOutcome::none_found;
  };
  // Beyond 1e100 in the one units is not yet beyond it in the others.
  if (leaves(first) && leaves(other)) return test::holds();
  if (first.outcome != other.outcome)
    return test::fails(test::differs("outcome", static_cast<double>(other.outcome),
                                     static_cast<double>(first.outcome)));
  if (first.samples != other.samples)
    return test::fails(test::differs("samples", static_cast<double>(other.samples),
                                     static_cast<double>(first.samples)));
  if (first.orbit.has_value() != other.orbit.has_value()) return test::fails("orbit in one alone");
  if (!first.orbit) return test::does_not_apply();
  if (!same_orbit(*first.orbit, *other.orbit, units)) return test::fails("another orbit");
  return test::holds();
}

TEST(UnitsOfOrbit, AreThoseOfItsLoop) {
  test::expect_property(131, 200, random_orbit_case, orbit_scales, 0.25);
}

TEST(UnitsOfOrbit, NearThePaperAreThoseOfItsLoop) {
  test::expect_property(113, 200, random_paper_case, orbit_scales, 0.25);
}

// The slowest computer that still serves is as slow in other units.

MaxDelayOptions options_of(const test::LoopCase& drawn, double unit_of_time) {
  MaxDelayOptions options{drawn.excitation.frequency, drawn.gains.proportional};
  options.criterion = drawn.exact_hold != 0 ? DelayCriterion::stable : DelayCriterion::attenuates;
  options.delay_fraction = drawn.delay_share;
  options.shortest_period = 1e-4 * unit_of_time;
  options.longest_period = 0.5 * unit_of_time;
  options.search_ratio = 1.01;
  return options;
}

/// The share of the amplitude that the best stabilising D takes off at a period.
double attenuation(const test::LoopCase& drawn, double period) {
  const MaxDelayOptions options = options_of(drawn, 1.0);
  const auto offer = detail::delay_offer(drawn.plant, options, period);
  if (!offer.response) return std::numeric_limits<double>::infinity();
  const double p = options.proportional_gain;
  return 1.0 - offer.response->best_differential_gain(p, offer.stable).ratio_to_uncontrolled;
}

/// The search steps by what it sees, which rounding moves; its answers are one to a part in 10⁹, or
/// where attenuation ends so slowly that rounding decides, control takes off as little at both.
test::PropertyOutcome largest_period_scales(const UnitsCase& units) {
  const test::LoopCase rewritten = units.rewritten();
  const MaxDelay first = max_sampling_period(units.loop.plant, options_of(units.loop, 1.0));
  const MaxDelay other =
      max_sampling_period(rewritten.plant, options_of(rewritten, units.of_time()));
  const double found = other.sampling_period / units.of_time();
  if (other.outcome != first.outcome)
    return test::fails(test::differs("another outcome, period", found, first.sampling_period));
  if (first.outcome != MaxDelayOutcome::found || found == first.sampling_period)
    return test::holds();
  const double apart = std::abs(found / first.sampling_period - 1.0);
  if (!(apart <= 1e-9)) {
    const double most = std::max(std::abs(attenuation(units.loop, first.sampling_period)),
                                 std::abs(attenuation(units.loop, found)));
    if (most <= 1e-9) return test::holds();
    return test::fails(test::differs("period", found, first.sampling_period));
  }
  if (other.limit != first.limit) return test::fails("another limit");
  return test::holds();
}

TEST(UnitsOfSearch, LargestSamplingPeriodScales) {
  test::expect_property(121, 100, test::case_in_other_units, largest_period_scales);
}

}  // namespace
}  // namespace holdfast
