#pragma once

#include <ceres/jet.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/ceres/decay_fit_options.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/two_mass.hpp"

/// Residuals of a plant against a decay record in the form that Ceres Solver needs.
namespace holdfast::fit::detail {

inline double value_of(double number) { return number; }
template <class T, int N>
double value_of(const ::ceres::Jet<T, N>& number) {
  return number.a;
}

constexpr std::size_t plant_parameters = 5;             // in the order of PlantParameter
constexpr std::size_t unknowns = plant_parameters + 1;  // and z₀

/// Plant with the parameters of `reference` times e^θ, one θ per parameter; m₂ is unchanged.
template <class Scalar>
TwoMass<Scalar> scaled_plant(const TwoMass<double>& reference,
                             const std::array<Scalar, plant_parameters>& theta) {
  using std::exp;
  return {
      reference.conductor_mass * exp(theta[0]),     reference.conductor_stiffness * exp(theta[1]),
      reference.conductor_damping * exp(theta[2]),  Scalar(reference.absorber_mass),
      reference.absorber_stiffness * exp(theta[3]), reference.absorber_damping * exp(theta[4])};
}

template <class Scalar>
TwoMass<double> values_of(const TwoMass<Scalar>& plant) {
  return {value_of(plant.conductor_mass),     value_of(plant.conductor_stiffness),
          value_of(plant.conductor_damping),  value_of(plant.absorber_mass),
          value_of(plant.absorber_stiffness), value_of(plant.absorber_damping)};
}

/// Transformed residual ± √(2 ρ(r)), by which a least-squares solver minimises Huber's loss ρ.
template <class Scalar>
Scalar huber_residual(const Scalar& residual, double scale) {
  using std::abs;
  using std::sqrt;
  if (!(abs(residual) > Scalar(scale))) return residual;
  const Scalar root = sqrt(Scalar(2.0 * scale) * abs(residual) - Scalar(scale * scale));
  return residual < Scalar(0) ? Scalar(-root) : root;
}

/// Differences between a plant's free decay and a record, as a function of six unknowns θ: ln of
/// five parameters over those of `reference`, and ln of z₀ over the record's first displacement.
struct DecayResiduals {
  const DecayRecord& record;
  DecayMeasures measures;
  DecayTarget target;
  TwoMass<double> reference;
  // Scale of the history's residuals, in |z(0)|; ∞ for plain least squares.
  double huber_scale = std::numeric_limits<double>::infinity();

  /// The amplitude |z(0)| (m) to which the residuals of the time history are relative.
  double amplitude() const { return std::abs(record.displacements.front()); }

  int count() const {
    if (!is_measured(target)) return static_cast<int>(record.times.size());
    return target == DecayTarget::first_peak_and_period ? 2 : 3;
  }

  template <class Scalar>
  bool operator()(const Scalar* m1, const Scalar* k1, const Scalar* c1, const Scalar* k2,
                  const Scalar* c2, const Scalar* start, Scalar* residuals) const {
    const auto plant = scaled_plant<Scalar>(reference, {*m1, *k1, *c1, *k2, *c2});
    if (!is_admissible(values_of(plant))) return false;
    if (is_measured(target)) return compare_measures(plant, residuals);
    using std::exp;
    const auto motion =
        free_decay(plant, Scalar(record.displacements.front() * exp(*start)), record.times);
    bool finite = true;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      residuals[k] = huber_residual(
          Scalar((motion[k] - record.displacements[k]) / Scalar(amplitude())), huber_scale);
      finite = finite && std::isfinite(value_of(residuals[k]));
    }
    return finite;
  }

 private:
  template <class Scalar>
  bool compare_measures(const TwoMass<Scalar>& plant, Scalar* residuals) const {
    const auto decay = relative_decay(plant, free_decay_events(values_of(plant)));
    if (!decay) return false;
    const double first_peak = measures.first_peak / record.displacements.front();
    residuals[0] = decay->first_peak / first_peak - 1.0;
    residuals[1] = decay->period / measures.period - 1.0;
    if (target == DecayTarget::first_peak_period_and_decrement)
      residuals[2] = decay->logarithmic_decrement / measures.logarithmic_decrement - 1.0;
    return std::isfinite(value_of(residuals[0] + residuals[1] + residuals[count() - 1]));
  }
};

}  // namespace holdfast::fit::detail
