#include "case/model/moving_loop.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/motion/divergence.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

/// Modal loop in the paper's model. Throws NoAnswer if two poles nearly coincide.
SampledModes sampled_modes_of(const Case& the_case, bool controlled) {
  const std::vector<PlantPole> poles = conductor_with_absorber_of(the_case).poles;
  const IdealLoop<double> ideal = ideal_loop_of(the_case);
  ModalLoop loop{conductor_modes_of(the_case).modes,
                 absorber_of(the_case),
                 ideal.sampling,
                 ideal.gains,
                 ideal.excitation,
                 ideal.backlash_width,
                 ideal.hold};
  if (!controlled) loop.sampling.processing_delay = 0.0;
  return {controlled ? loop : uncontrolled(loop),
          modal_state(loop.modes, initial_state_of(the_case)), poles};
}

/// Sampling period (s) of a motion without control: at least 200 samples per period of the force;
/// if these exceed 4 million, fewer samples with phases spread evenly over the period.
double resolving_period(double frequency, double duration) {
  constexpr double samples_of_cycle = 200.0, samples_of_motion = 20000.0, most_samples = 4e6;
  const double longest = duration / samples_of_motion;
  const double fine = 1.0 / (samples_of_cycle * frequency);
  if (duration <= most_samples * fine) return duration > 0.0 ? std::min(longest, fine) : fine;
  constexpr double golden_section = 0.38196601125010515;
  return (std::floor(longest * frequency) + golden_section) / frequency;
}

/// The case without gains, quanta, filters, drive lag, delay and play.
Case without_computer(Case the_case) {
  const double period = the_case.control.sampling_period;
  the_case.control = {};
  the_case.control.sampling_period = period;
  the_case.backlash.law = "none";
  if (!has_own_plant(the_case)) the_case.own = nullptr;
  return the_case;
}

double bound_of(const SampledMasses& moving) {
  return holdfast::divergence_bound(implemented_loop(moving.loop), moving.state);
}
template <class Moving>
double bound_of(const Moving& moving) {
  return holdfast::divergence_bound(moving.loop, moving.state);
}

}  // namespace

BuiltLoop built_loop_of(const Case& the_case, const MotionChoice& choice) {
  if (!is_of_masses(motion_kind_of(the_case, choice.switching)))
    return BuiltPlant{conductor_loop_of(the_case, choice),
                      modal_state_of(the_case, initial_state_of(the_case))};
  const ImplementedLoop loop = implemented_loop_of(the_case, choice.switching);
  return BuiltMasses{choice.controlled ? loop : uncontrolled(loop), initial_state_of(the_case)};
}

MovingLoop moving_loop_of(const Case& the_case, const MotionChoice& choice) {
  const MotionKind kind = motion_kind_of(the_case, choice.switching);
  if (!is_sampled(kind))
    return std::visit([](auto built) -> MovingLoop { return built; },
                      built_loop_of(the_case, choice));
  if (!is_of_masses(kind)) return sampled_modes_of(the_case, choice.controlled);
  SampledMasses masses = sampled_masses_of(the_case);
  if (!choice.controlled) masses.loop = uncontrolled(masses.loop);
  return masses;
}

SampledMasses sampled_masses_of(const Case& the_case) {
  return {ideal_loop_of(the_case), initial_state_of(the_case)};
}

MovingLoop smooth_loop_of(const Case& the_case, Switching switching) {
  MovingLoop moving = moving_loop_of(the_case, {switching});
  if (std::holds_alternative<BuiltPlant>(moving) && !is_ideal(controller_limits_of(the_case)))
    throw WrongInput("with " + modal_words(the_case) +
                     ", orbits, basins, exponents and verdicts need an ideal computer: set the "
                     "quanta of [control] to 0, largest_force = \"none\", velocity = \"measured\"");
  // Without gains there is no force that play could interrupt.
  auto* const modes = std::get_if<SampledModes>(&moving);
  if (modes && modes->loop.gains.proportional == 0.0 && modes->loop.gains.differential == 0.0)
    modes->loop.backlash_width = 0.0;
  return moving;
}

SampledMotion<double> motion_of(const SampledMasses& moving) {
  return harmonically_forced_motion(moving.loop, moving.state);
}
EventMotion<> motion_of(const BuiltMasses& moving) {
  return event_motion(moving.loop, moving.state);
}
ModalMotion motion_of(const SampledModes& moving) {
  return {moving.loop, moving.poles, moving.state};
}
EventMotion<DriveContact<ControlledPlant>> motion_of(const BuiltPlant& moving) {
  return event_motion(moving.loop, moving.state);
}

double period_of(const MovingLoop& moving) {
  return std::visit([](const auto& one) { return clock_of(one).sampling.period; }, moving);
}

double divergence_bound(const MovingLoop& moving) {
  return std::visit([](const auto& one) { return bound_of(one); }, moving);
}

MovingLoop motion_without_control(const Case& the_case, double duration) {
  MovingLoop moving = moving_loop_of(without_computer(the_case), {Switching::sampled, false});
  const double period = resolving_period(motion_excitation_of(the_case).frequency, duration);
  std::visit(
      [&](auto& one) {
        clock_of(one).hold = ForceHold::exact;
        clock_of(one).sampling = {period};
      },
      moving);
  return moving;
}

}  // namespace holdfast::program
