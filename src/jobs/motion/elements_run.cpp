#include "jobs/motion/elements_run.hpp"

#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/needed.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

#ifdef HOLDFAST_HAS_SUNDIALS
#include "holdfast/sundials/elements_motion.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_SUNDIALS

namespace {

CableElements driven_elements_of(const Case& the_case, int elements) {
  require_keys(the_case, {"absorber.position", "plant.absorber_mass", "plant.absorber_stiffness",
                          "plant.absorber_damping"});
  const auto& plant = the_case.plant;
  const HangingAbsorber absorber{AbsorberReading::spring_mass, plant.absorber_mass,
                                 plant.absorber_stiffness,     plant.absorber_damping,
                                 the_case.absorber.clamp_mass, the_case.absorber.motion == "plane"};
  const auto& [first, second] = the_case.conductor.rayleigh_frequencies;
  return {conductor_of(the_case), the_case.absorber.position, elements, absorber,
          rayleigh_damping(damping_ratio_of(the_case), first, second)};
}

/// State at rest under a force that displaces the absorber's place by z1 (m); by the secant method.
Eigen::VectorXd bent_to(const CableElements& cable, double z1) {
  double before = 0.0, force = z1 > 0.0 ? 1e-3 : -1e-3, at_before = -z1;
  auto start = cable.held_by(z1 == 0.0 ? 0.0 : force);
  for (int turn = 0; turn < 50 && start.outcome == EquilibriumOutcome::converged; ++turn) {
    const double here = cable.displacement(start.state) - z1;
    const double rounding = 1e-12 * cable.chain().conductor().span;
    if (std::abs(here) <= 1e-9 * std::abs(z1) + rounding) return start.state;
    if (here == at_before) break;
    const double next = force - here * (force - before) / (here - at_before);
    before = force;
    at_before = here;
    force = next;
    start = cable.held_by(force);
  }
  throw NoAnswer(
      "no static equilibrium of the cable was found with the absorber's place displaced by " +
      format_number(z1) + " m: give a smaller initial.z1");
}

Eigen::VectorXd start_of(const Case& the_case, const CableElements& cable) {
  const auto& initial = the_case.initial;
  Eigen::VectorXd state = bent_to(cable, initial.z1);
  cable.strike(state.data(), initial.v1, initial.z2 - cable.at_absorber(state.data())[2],
               initial.v2);
  return state;
}

void require_of_elements(const Case& the_case) {
  if (the_case.conductor.damping == "ratio")
    throw WrongInput(
        "--plant elements needs Rayleigh damping: set conductor.damping = \"rayleigh\"");
}

/// Throws NoAnswer if the cable has gone slack or CVODE has failed.
void require_cable(const cvode::ElementsMotion& motion) {
  if (motion.outcome() == cvode::IntegrationOutcome::completed) return;
  if (motion.outcome() == cvode::IntegrationOutcome::model_ended)
    throw NoAnswer("the cable goes slack at t = " + format_rounded(motion.time()) +
                   " s and the model ends there: the loop is unstable or the force too large; "
                   "give a shorter --duration to see the growth");
  throw NoAnswer("the integrator CVODE failed at t = " + format_number(motion.time()) +
                 " s: " + one_line(motion.words()) + "; give a shorter --duration");
}

}  // namespace

void run_elements(const Case& the_case, const ElementsQuestion& question,
                  const std::function<void(const MotionSample<double>&)>& visit) {
  require_of_elements(the_case);
  const CableElements cable = driven_elements_of(the_case, question.elements);
  const IdealLoop<double> of_case = ideal_loop_of(the_case);
  const IdealLoop<double> loop = question.controlled ? of_case : uncontrolled(of_case);
  constexpr cvode::Tolerances fine{1e-10, 1e-9};  // of positions of some metres
  cvode::ElementsMotion motion(
      cable, {loop.sampling, loop.gains, loop.excitation, loop.backlash_width, loop.hold},
      start_of(the_case, cable), fine);
  for (std::int64_t left = question.samples; left > 0; --left) {
    throw_if_interrupted();
    require_cable(motion);
    visit(motion.sense());
    if (left > 1) motion.advance();
  }
}

std::string coarse_bars_warning(const Case& the_case, const ElementsQuestion& question) {
  const auto string = string_of(the_case);
  const double bar = string.span / question.elements;
  const double wave = 2.0 * string.wave_speed() * the_case.control.sampling_period;
  // With bars a quarter longer than it, the stable gains of the built-in cable are 5 % off.
  constexpr double harmless = 1.25;
  if (!question.controlled || bar <= harmless * wave) return "";
  return "the bars are " + format_rounded(bar) +
         " m long, too coarse for the waves at half the sampling rate, of " + format_rounded(wave) +
         " m: an unstable loop may look stable; give --elements " +
         format_number(std::ceil(string.span / wave));
}

#else

std::string coarse_bars_warning(const Case&, const ElementsQuestion&) { return ""; }

void run_elements(const Case&, const ElementsQuestion&,
                  const std::function<void(const MotionSample<double>&)>&) {
  require_sundials();
}

#endif

}  // namespace holdfast::program
