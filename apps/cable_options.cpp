#include "cable_options.hpp"

#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

CableDecayOptions CableOptions::question(double force, double usual_duration) const {
  const auto reading = absorber == "rigid"    ? AbsorberReading::rigid_mass
                       : absorber == "spring" ? AbsorberReading::spring_mass
                                              : AbsorberReading::weight;
  constexpr double most_rows = 1e7;
  const double time = duration.value_or(usual_duration);
  if (interval > time)
    throw WrongInput("--interval = " + format_number(interval) + ": admissible is at most " +
                     format_number(time) + ", the --duration");
  if (time > most_rows * interval)
    throw WrongInput("--interval = " + format_number(interval) + ": admissible is at least " +
                     format_number(time / most_rows) + ", ten million rows in the --duration of " +
                     format_number(time));
  return {force, time, interval, elements, reading};
}

void add_cable_options(const Job& job, CableOptions& options, const std::string& usual_duration) {
  job->add_option("--absorber", options.absorber,
                  "How the absorber loads the cable: weight (without inertia), rigid mass, or "
                  "spring (mass on its spring and damper)")
      ->check(CLI::IsMember({"weight", "rigid", "spring"}))
      ->type_name("")
      ->capture_default_str();
  job->add_flag("--equal-displacement", options.equal_displacement,
                "The plant starts as far displaced as the cable, not under the same force");
  job->add_option("--elements", options.elements, "Bars of the continuous cable")
      ->check(CLI::Range(4, 20000))
      ->type_name("N")
      ->capture_default_str();
  job->add_option("--duration", options.duration,
                  "Time after the removal, s; default: " + usual_duration)
      ->check(number_from(1e-6, 1e6))
      ->type_name("");
  job->add_option("--interval", options.interval, "Time between rows, s")
      ->check(number_from(1e-9, 1e6))
      ->type_name("")
      ->capture_default_str();
}

double plant_start(const JobContext& context, const CableOptions& options, double force,
                   double cable_displacement) {
  if (options.equal_displacement) return cable_displacement;
  return force / plant_of(context.case_data).conductor_stiffness;
}

DecayRecord plant_decay(const JobContext& context, double start, const DecayRecord& cable) {
  return {cable.times, free_decay(plant_of(context.case_data), start, cable.times)};
}

}  // namespace holdfast::program
