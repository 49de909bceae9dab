// Numbers are told in units; physics is not. Changed by powers of two, units of mass and length
// leave every bit of a result, and units of time do where the matrix exponential is balanced alike;
// where it is not, its rounding is all that changes.

#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/response/response.hpp"
#include "property/units_case.hpp"
#include "support/dense_routes.hpp"

namespace holdfast {
namespace {

using test::LoopInBothUnits;
using test::Random;
using test::UnitsCase;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

UnitsCase case_in_other_mass_and_length(Random& random) {
  return test::random_units_case(random, false);
}
UnitsCase held_case_in_other_mass_and_length(Random& random) {
  UnitsCase drawn = case_in_other_mass_and_length(random);
  drawn.loop.exact_hold = 0;
  return drawn;
}

/// Largest sum of a row of |A| τ, balanced.
double turns_of(const test::LoopCase& drawn) {
  const BalancedMatrix<double, 4> a(drawn.plant.state_matrix());
  return drawn.period * a.balanced.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Whether the force over a sample is the same in both units. Held it keeps its bits with those of
/// the matrices; followed exactly it has an exponential of its own, balanced with a unit of force.
bool force_scales(const UnitsCase& units, const LoopInBothUnits& loop, double rounding) {
  const test::LoopCase rewritten = units.rewritten();
  const double omega = units.loop.excitation.angular_frequency();
  const HarmonicInput<double> first =
      harmonic_input(units.loop.plant, loop.first, units.loop.hold(), omega);
  const HarmonicInput<double> other = harmonic_input(rewritten.plant, loop.other, rewritten.hold(),
                                                     rewritten.excitation.angular_frequency());
  const Vector<double, 4> factors = balancing<double, 4>(units.loop.plant.state_matrix());
  const Vector<double, 4> unit = units.of_state() / units.of_force();
  const auto size = [&](const Vector<double, 4>& v) {
    return v.cwiseQuotient(factors).cwiseAbs().maxCoeff();
  };
  const double whole = size(first.cosine) + size(first.sine) + size(loop.first.held_excitation);
  return size(other.cosine.cwiseQuotient(unit) - first.cosine) <= rounding * whole &&
         size(other.sine.cwiseQuotient(unit) - first.sine) <= rounding * whole;
}

test::PropertyOutcome matrices_scale(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  const double omega_turns = units.loop.excitation.angular_frequency() * units.loop.period;
  const double rounding = 64.0 * epsilon * (1.0 + turns_of(units.loop) + omega_turns);
  if (!force_scales(units, loop, units.loop.exact_hold == 0 && loop.same ? 0.0 : rounding))
    return test::fails("the force over a sample");
  if (loop.same) return test::holds();
  if (units.time == 0) return test::fails("the matrices differ in their bits");
  const Vector<double, 4> factors = balancing<double, 4>(units.loop.plant.state_matrix());
  const auto balanced = [&](const Matrix<double, 4>& m) -> Matrix<double, 4> {
    return factors.cwiseInverse().asDiagonal() * m * factors.asDiagonal();
  };
  const Matrix<double, 4> transition = balanced(loop.first.transition);
  const double size = std::max(1.0, transition.cwiseAbs().maxCoeff());
  const double apart =
      balanced(loop.back.transition - loop.first.transition).cwiseAbs().maxCoeff() / size;
  if (!(apart <= rounding)) return test::fails(test::differs("A_d apart by", apart, rounding));
  return test::holds();
}

TEST(UnitsOfLoop, MatricesScale) {
  test::expect_property(101, 2000, test::case_in_other_units, matrices_scale);
}

TEST(UnitsOfLoop, MatricesKeepTheirBitsInOtherUnitsOfMassAndLength) {
  test::expect_property(102, 2000, case_in_other_mass_and_length, matrices_scale);
}

test::PropertyOutcome same_intervals(const std::string& what,
                                     const std::vector<Interval<double>>& first,
                                     const std::vector<Interval<double>>& other, double unit) {
  if (first.size() != other.size())
    return test::fails(test::differs("intervals of " + what, static_cast<double>(other.size()),
                                     static_cast<double>(first.size())));
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (other[k].lower != unit * first[k].lower)
      return test::fails(test::differs("lower " + what, other[k].lower / unit, first[k].lower));
    if (other[k].upper != unit * first[k].upper)
      return test::fails(test::differs("upper " + what, other[k].upper / unit, first[k].upper));
  }
  return test::holds();
}

test::PropertyOutcome intervals_scale(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  if (!loop.same) return test::does_not_apply();
  const auto first = characteristic_polynomial(loop.first);
  const auto other = characteristic_polynomial(loop.other);
  const PdGains<double> gains = units.loop.gains, same_gains = units.rewritten().gains;
  const auto of_d =
      same_intervals("D", stable_differential_gains(first, gains.proportional),
                     stable_differential_gains(other, same_gains.proportional), units.of_damping());
  if (of_d.kind != test::PropertyOutcome::Kind::holds) return of_d;
  return same_intervals("P", stable_proportional_gains(first, gains.differential),
                        stable_proportional_gains(other, same_gains.differential),
                        units.of_stiffness());
}

TEST(UnitsOfLoop, StableIntervalsScaleToTheLastBit) {
  test::expect_property(103, 2000, test::case_in_other_units, intervals_scale, 0.75);
}

test::PropertyOutcome boundary_scales(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  if (!loop.same) return test::does_not_apply();
  const double reach = 1e-6 + 2.0 * std::abs(units.loop.gains.proportional);
  const auto first = stability_boundary(characteristic_polynomial(loop.first), {-reach, reach});
  const double wide = reach * units.of_stiffness();
  const auto other = stability_boundary(characteristic_polynomial(loop.other), {-wide, wide});
  if (first.size() != other.size())
    return test::fails(test::differs("points", static_cast<double>(other.size()),
                                     static_cast<double>(first.size())));
  for (std::size_t k = 0; k < first.size(); ++k) {
    const auto &a = first[k], &b = other[k];
    const std::string where = "point " + std::to_string(k);
    if (a.curve != b.curve || a.angle != b.angle)
      return test::fails(test::differs(where + ", angle", b.angle, a.angle));
    if (b.gains.proportional != units.of_stiffness() * a.gains.proportional)
      return test::fails(test::differs(where + ", P", b.gains.proportional / units.of_stiffness(),
                                       a.gains.proportional));
    if (b.gains.differential != units.of_damping() * a.gains.differential)
      return test::fails(test::differs(where + ", D", b.gains.differential / units.of_damping(),
                                       a.gains.differential));
  }
  return test::holds();
}

TEST(UnitsOfLoop, BoundaryPointsScaleToTheLastBit) {
  test::expect_property(104, 300, test::case_in_other_units, boundary_scales, 0.75);
}

/// Largest condition number of an eigenvalue of a balanced matrix: what it moves by, per unit that
/// the matrix does.
double eigenvalue_condition(const Matrix<double, 5>& balanced) {
  const Eigen::MatrixXcd right = test::eigenvectors_of(balanced);
  double largest = 0.0;
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXcd left =
        test::solution_of(right.transpose(), Eigen::VectorXcd::Unit(5, i));
    largest = std::max(largest, left.norm() * right.col(i).norm());
  }
  return largest;
}

test::PropertyOutcome radius_scales(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  if (!loop.same) return test::does_not_apply();
  const Matrix<double, 5> first = loop.first.engaged_map(units.loop.gains);
  const Matrix<double, 5> other = loop.other.engaged_map(units.rewritten().gains);
  const double expected = spectral_radius(first), found = spectral_radius(other);
  if (found == expected) return test::holds();
  const BalancedMatrix<double, 5> a(first), b(other);
  if (a.balanced == b.balanced) return test::fails(test::differs("radius", found, expected));
  const double condition = eigenvalue_condition(a.balanced) + eigenvalue_condition(b.balanced);
  if (!(condition < 1e6)) return test::does_not_apply();
  const double rounding = 32.0 * epsilon * condition * (a.balanced.norm() + b.balanced.norm());
  if (!(std::abs(found - expected) <= rounding))
    return test::fails(test::differs("radius", found, expected));
  return test::holds();
}

TEST(UnitsOfLoop, SpectralRadiusStays) {
  test::expect_property(105, 2000, test::case_in_other_units, radius_scales, 0.75);
}

double steady_amplitude(const test::LoopCase& drawn, const SampledLoop<double>& loop) {
  const double omega = drawn.excitation.angular_frequency();
  const SteadyResponse<double> response(
      loop, harmonic_input(drawn.plant, loop, drawn.hold(), omega), omega);
  return drawn.excitation.amplitude * response.amplitude_per_force(drawn.gains);
}

test::PropertyOutcome amplitude_scales(const UnitsCase& units) {
  const LoopInBothUnits loop(units);
  const double found = steady_amplitude(units.rewritten(), loop.other) / units.of_length();
  const double expected = steady_amplitude(units.loop, loop.first);
  if (found == expected) return test::holds();
  return test::fails(test::differs("amplitude", found, expected));
}

TEST(UnitsOfLoop, SteadyAmplitudeKeepsItsBitsInOtherUnitsOfMassAndLength) {
  test::expect_property(106, 2000, held_case_in_other_mass_and_length, amplitude_scales);
}

}  // namespace
}  // namespace holdfast
