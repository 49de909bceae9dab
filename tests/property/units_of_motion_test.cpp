// The same motion in other units: every sample of it and its exponents.

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "property/units_case.hpp"
#include "support/testing.hpp"

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

}  // namespace
}  // namespace holdfast
