#pragma once

#include <cmath>
#include <utility>

#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/cable/irvine_statics.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// Statics of the place of the absorber, counted as Kollár 2022, Fig. 2 does: force and
/// displacement from the equilibrium with the absorber's weight, downward positive.
///
/// @tparam PointLoad  `IrvinePointLoad<double>` (Eq. 1) or `CatenaryPointLoad<double>` (exact)
template <class PointLoad>
class StaticsFromRest {
 public:
  /// @param model         of the place, its displacement counted from the bare cable
  /// @param resting_load  weight of the absorber (N), ≥ 0
  StaticsFromRest(PointLoad model, double resting_load)
      : model_(std::move(model)),
        resting_load_(resting_load),
        resting_displacement_(model_.displacement(resting_load)) {}

  /// The statics of the place as counted from the bare cable.
  const PointLoad& model() const { return model_; }

  /// Drop (m) of the place from the bare cable to the equilibrium.
  double resting_displacement() const { return resting_displacement_; }

  /// H + h (N) under a further force (N).
  double tension(double force) const { return model_.tension(resting_load_ + force); }

  /// w (m) under a further force (N), force > lowest_force().
  double displacement(double force) const {
    return model_.displacement(resting_load_ + force) - resting_displacement_;
  }

  /// dF/dw (N/m), the tangent at a further force (N).
  double stiffness(double force) const { return model_.stiffness(resting_load_ + force); }

  /// F (N) that displaces the place by w (m): Newton's method on the rising curve w(F), kept in a
  /// bracket. @throws InvalidParameter when that force would not be above lowest_force()
  double force(double displacement_sought) const;

  /// The further force (N) at and below which the models lose their meaning: it lifts the place
  /// by half of the cable's own weight.
  double lowest_force() const { return model_.lowest_load() - resting_load_; }

 private:
  PointLoad model_;
  double resting_load_, resting_displacement_;
};

template <class PointLoad>
double StaticsFromRest<PointLoad>::force(double displacement_sought) const {
  require_finite("displacement", displacement_sought, "m");
  const double floor = lowest_force() * (1.0 - 1e-9);
  if (displacement_sought <= displacement(floor))
    throw InvalidParameter("displacement", displacement_sought, "m",
                           "one that an upward load below half of the cable's weight reaches");
  double below = floor, above = std::abs(floor);
  while (displacement(above) < displacement_sought) above *= 2.0;
  double guess = std::fmin(std::fmax(stiffness(0.0) * displacement_sought, below), above);
  for (int step = 0; step < 200; ++step) {
    const double miss = displacement(guess) - displacement_sought;
    (miss > 0.0 ? above : below) = guess;
    const double change = miss * stiffness(guess);
    if (std::abs(change) <= 1e-15 * std::abs(floor)) break;
    const double next = guess - change;
    guess = next > below && next < above ? next : 0.5 * (below + above);
  }
  return guess;
}

/// Eq. (1) at the absorber's place.
/// @throws InvalidParameter for an inadmissible conductor, place or mass (kg)
inline StaticsFromRest<IrvinePointLoad<double>> irvine_statics(const Conductor<double>& conductor,
                                                               double position,
                                                               double absorber_mass) {
  validate(conductor);
  require_inside_span(position, conductor.span);
  require_non_negative("absorber mass m2", absorber_mass, "kg");
  return {{conductor, position}, absorber_mass * conductor.gravity};
}

/// The exact statics at the absorber's place.
/// @throws InvalidParameter for an inadmissible conductor, place or mass (kg)
template <class Scalar>
StaticsFromRest<CatenaryPointLoad<Scalar>> exact_statics(const Conductor<Scalar>& conductor,
                                                         double position, double absorber_mass) {
  validate(conductor);
  require_inside_span(position, conductor.span);
  require_non_negative("absorber mass m2", absorber_mass, "kg");
  return {{conductor, position}, absorber_mass * conductor.gravity};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class StaticsFromRest<CatenaryPointLoad<double>>;
extern template StaticsFromRest<CatenaryPointLoad<double>> exact_statics(const Conductor<double>&,
                                                                         double, double);
#endif

}  // namespace holdfast
