#pragma once

#include "case/case.hpp"
#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/elements.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// The continuous cable in finite elements, with the conductor's damping ratio at both frequencies
/// of [reduction], and for `spring_mass` with the absorber's spring and damper of [plant].
CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading);

/// Whether the program was built with SUNDIALS.
bool has_sundials();

/// Throws NoAnswer, naming the package to install, in a program built without SUNDIALS.
void require_sundials();

/// Options of the decay after a load is removed from the continuous cable of a case.
struct CableDecayOptions {
  double force;     ///< removed load (N), downward positive
  double duration;  ///< duration of the record (s)
  double interval;  ///< time between instants of the record (s)
  int elements = 100;
  AbsorberReading reading = AbsorberReading::weight;
};

/// Default options: an eighth of the absorber's weight, six periods of the first frequency of
/// [reduction] with 250 instants each.
CableDecayOptions usual_decay(const Case& the_case);

/// Free vibration of the absorber's place after the load is removed.
struct CableDecay {
  double initial_displacement;  ///< displacement under the load (m)
  DecayRecord record;
};

/// Simulates the decay of the continuous cable. Throws WrongInput if the force exceeds the statics
/// or the cable goes slack; NoAnswer without an equilibrium, if CVODE fails (with its message), if
/// the duration has over 10⁵ periods, or in a program without SUNDIALS (naming the package).
CableDecay cable_decay(const Case& the_case, const CableDecayOptions& options);

/// The plant's decay at the instants of the cable's decay. It starts at the cable's initial
/// displacement, or at F/k1 under the same force F (N).
DecayRecord plant_decay(const TwoMass<double>& plant, double force, bool equal_displacement,
                        const CableDecay& cable);

}  // namespace holdfast::program
