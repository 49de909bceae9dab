#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/mode_motion.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Whether EventPack supports the motions of a loop with two masses: Switching::exact, an ideal
/// computer and clock, and an excitation of harmonics only.
inline bool has_event_pack(const ImplementedLoop& loop) {
  const DigitalLoop& digital = loop.digital;
  return loop.switching == Switching::exact && is_ideal(digital.limits) &&
         digital.jitter.half_width == 0.0 && digital.force.record == nullptr;
}

/// The growth rate of the powers of A (1/s): the largest ‖Aᵏ‖^{1/k}, k = 10 … most_terms, in the
/// row-sum norm of the balanced matrix. This rate is usually smaller than balanced_norm(), and
/// terms_for(rate h) Taylor terms of e^{A h} have the error bound stated at terms_for().
/// @tparam States  N, the order of the plant
template <int States>
double rate_of_powers(const Matrix<double, States>& a) {
  constexpr int first = 10;
  const Matrix<double, States> balanced = BalancedMatrix<double, States>(a).balanced;
  const auto norm = [](const auto& matrix) { return matrix.cwiseAbs().rowwise().sum().maxCoeff(); };
  const double size = norm(balanced);
  if (!(size > 0.0)) return 0.0;
  const Matrix<double, States> unit = balanced / size;
  Matrix<double, States> power = unit;
  double rate = 0.0;
  for (int k = 2; k <= most_terms; ++k) {
    power = (power * unit).eval();
    if (k >= first) rate = std::max(rate, std::pow(norm(power), 1.0 / k));
  }
  return rate * size;
}

/// The dynamics of the two masses in each contact mode, shared by several motions. The loops of the
/// motions may differ in their gains, and in their backlash unless it is a dead zone (serves()).
class EventTable {
 public:
  using Motion = ModeMotion<TwoMass<double>>;  ///< motion of the two masses in one mode
  using Drop = Motion::Bound::Drop;            ///< coefficients of drop_below_chord()

  /// Constructs the table of a loop. @throws InvalidParameter as the constructor of EventMotion
  explicit EventTable(const ImplementedLoop& loop)
      : loop_(loop), force_(loop.digital.force, loop.digital.hold, loop.digital.sampling.period) {
    const DriveContact<> contact(loop.plant, loop.backlash, loop.switching,
                                 Vector<double, 4>::Zero());
    for (int mode = 0; mode < DriveContact<>::modes; ++mode) {
      motions_.emplace_back(contact.dynamics(mode), loop.digital, force_);
      rates_[at(mode)] = std::max(rate_of_powers(motions_.back().dynamics().state),
                                  force_.highest_angular_frequency());
    }
    for (std::size_t mode = 0; mode < motions_.size(); ++mode)
      for (std::size_t other = 0; other < motions_.size(); ++other)
        alike_[mode][other] = alike(motions_[mode].dynamics(), motions_[other].dynamics());
  }

  /// Whether the table is also valid for the motions of the loop `other`.
  bool serves(const ImplementedLoop& other) const {
    const auto& [mine, its] = std::pair(loop_.digital.sampling, other.digital.sampling);
    return numbers_of_plant(loop_.plant) == numbers_of_plant(other.plant) &&
           mine.period == its.period && mine.processing_delay == its.processing_delay &&
           loop_.switching == other.switching && loop_.digital.hold == other.digital.hold &&
           same_force(loop_.digital.force.harmonics, other.digital.force.harmonics) &&
           same_stops(loop_.backlash, other.backlash);
  }

  /// The motion of the two masses in a mode of the contact, given by its number.
  const Motion& motion(int mode) const { return motions_[at(mode)]; }
  /// Whether two modes, given by their numbers, have the same equations of motion apart from the
  /// effect of the command. −1 means no mode; it is the same as −1 only.
  bool move_alike(int mode, int other) const {
    return mode == other || (mode >= 0 && other >= 0 && alike_[at(mode)][at(other)]);
  }
  /// The rate (1/s) of a mode: one Taylor series covers a time ≤ 1/rate.
  double rate(int mode) const { return rates_[at(mode)]; }
  /// The excitation; no sample is selected yet: call begin_sample() of a copy first.
  const ForceOverSamples& force() const { return force_; }

  /// The coefficients of NoEventBoundOf::drop_below_chord() for the guards of the contact's present
  /// mode. Part 0 of the period is before t_j + δ, part 1 after it. The mode must have a guard.
  Drop drop(const DriveContact<>& contact, std::size_t part) {
    const int mode = contact.mode();
    std::optional<std::array<Drop, 2>>& known = drops_[at(mode)];
    if (!known) {
      const auto& sampling = loop_.digital.sampling;
      const auto& bound =
          motions_[at(mode)].bound(contact, mode, contact.guards().guard[0], force_);
      known = {bound.drop_over(sampling.processing_delay),
               bound.drop_over(sampling.period - sampling.processing_delay)};
    }
    return (*known)[part];
  }

 private:
  static std::size_t at(int mode) { return static_cast<std::size_t>(mode); }

  static std::array<double, 6> numbers_of_plant(const TwoMass<double>& plant) {
    return {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
            plant.absorber_mass,  plant.absorber_stiffness,  plant.absorber_damping};
  }

  static bool alike(const AffineDynamics& mode, const AffineDynamics& other) {
    return mode.state == other.state && mode.force == other.force && mode.drift == other.drift;
  }

  static bool same_force(const std::vector<Harmonic>& mine, const std::vector<Harmonic>& its) {
    return std::equal(
        mine.begin(), mine.end(), its.begin(), its.end(), [](const Harmonic& a, const Harmonic& b) {
          return a.amplitude == b.amplitude && a.frequency == b.frequency && a.phase == b.phase;
        });
  }

  static bool same_stops(const BacklashParameters& mine, const BacklashParameters& its) {
    const bool stops = mine.law == ContactLaw::dead_zone;
    if (stops != (its.law == ContactLaw::dead_zone)) return false;
    return !stops || (mine.width == its.width && mine.contact_stiffness == its.contact_stiffness &&
                      mine.contact_damping == its.contact_damping);
  }

  ImplementedLoop loop_;
  ForceOverSamples force_;
  std::vector<Motion> motions_;
  std::array<double, 3> rates_{};
  std::array<std::array<bool, 3>, 3> alike_{};
  std::array<std::optional<std::array<Drop, 2>>, 3> drops_;
};

}  // namespace holdfast
