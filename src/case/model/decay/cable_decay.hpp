#pragma once

#include "case/case.hpp"
#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/elements.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// The continuous cable, with the damping ratio of the conductor, where the case tells it, at the
/// two frequencies of [reduction]; the spring and damper of `spring_mass` are those of [plant].
CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading);

/// Whether the program was built with SUNDIALS.
bool has_sundials();

/// Throws NoAnswer, naming the package to install, in a program built without SUNDIALS.
void require_sundials();

/// A load that is removed from the continuous cable of a case.
struct CableDecayOptions {
  double force;     ///< N, downward positive
  double duration;  ///< s
  double interval;  ///< s between the instants of the record
  int elements = 100;
  AbsorberReading reading = AbsorberReading::weight;
};

/// Usual decay: an eighth of the absorber's weight removed, six periods of the first frequency of
/// [reduction], 250 instants in each.
CableDecayOptions usual_decay(const Case& the_case);

/// The vibration of the absorber's place.
struct CableDecay {
  double initial_displacement;  ///< m
  DecayRecord record;
};

/// Throws WrongInput where the force is beyond the statics or the cable goes slack; NoAnswer where
/// CVODE gives up, in its words, or where the program was built without SUNDIALS, naming the
/// package.
CableDecay cable_decay(const Case& the_case, const CableDecayOptions& options);

/// The plant's decay at the instants of the cable's: from where the cable starts, or from where the
/// same force (N) holds the plant, F/k1.
DecayRecord plant_decay(const TwoMass<double>& plant, double force, bool equal_displacement,
                        const CableDecay& cable);

}  // namespace holdfast::program
