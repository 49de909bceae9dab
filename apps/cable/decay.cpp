#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "case/axes/axis.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "jobs/cable/cable_decay.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

/// Options that the two jobs about a removed force share.
struct CableOptions {
  std::optional<double> duration;
  double interval = 0.001;
  int elements = 100;
  std::string absorber = "weight";
  bool equal_displacement = false;

  /// @param usual_duration  s, where none is given
  CableDecayOptions question(double force, double usual_duration) const {
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
                       format_number(time / most_rows) +
                       ", ten million rows in the --duration of " + format_number(time));
    return {force, time, interval, elements, reading};
  }
};

/// @param usual_duration  what the help says of the time where none is given
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
  job.add_number("--interval", options.interval, "Time between rows, s", 1e-9, 1e6);
}

/// The plant's decay at the instants of the cable's. It starts as far displaced as the cable, or
/// where the same force (N) holds it, F/k1.
DecayRecord plant_decay(const JobContext& context, const CableOptions& options, double force,
                        const CableDecay& cable) {
  const TwoMass<double> plant = plant_of(context.case_data);
  const double start =
      options.equal_displacement ? cable.initial_displacement : force / plant.conductor_stiffness;
  return {cable.record.times, free_decay(plant, start, cable.record.times)};
}

struct DecayOptions {
  double force = 0.2;
  CableOptions cable;
};

void write_decay(const JobContext& context, const DecayOptions& options) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  Table table(context,
              {{"time_s", "s", "since the force was removed"},
               {"elements_m", "m", "displacement of the absorber's place, continuous cable"},
               {"two_dof_m", "m", "displacement z1 of the two-mass plant"}});
  const CableDecay cable =
      cable_decay(context.case_data, options.cable.question(options.force, 10.0));
  const DecayRecord plant = plant_decay(context, options.cable, options.force, cable);
  for (std::size_t k = 0; k < plant.times.size(); ++k)
    table.row(plant.times[k], cable.record.displacements[k], plant.displacements[k]);
  table.commit();
}

struct PeaksOptions {
  std::string force = "-1:1:21";
  CableOptions cable;
};

void write_peaks(const JobContext& context, const PeaksOptions& options) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  const Axis forces = parse_axis("--force", options.force);
  const double duration = 2.0 / context.case_data.reduction.first_frequency;
  Table table(
      context,
      {{"force_N", "N", "removed, downward, beyond the absorber's weight"},
       {"elements_peak_m", "m", "first opposite peak of the continuous cable; nan: none so far"},
       {"two_dof_peak_m", "m", "first opposite peak of the two-mass plant; nan: none so far"},
       {"discrepancy", "",
        "|two_dof_peak_m - elements_peak_m| / |elements_peak_m|; nan under no "
        "force or without a peak"}});
  Progress progress(static_cast<std::uint64_t>(forces.count), "peaks", progress_wanted(context));
  for (std::int64_t k = 0; k < forces.count; ++k) {
    progress.advance();
    const double force = forces.at(k);
    if (force == 0.0) {
      table.row(0.0, 0.0, 0.0, std::nan(""));
      continue;
    }
    const CableDecay cable =
        cable_decay(context.case_data, options.cable.question(force, duration));
    const double elements_peak = decay_measures(cable.record).first_peak;
    const double plant_peak =
        decay_measures(plant_decay(context, options.cable, force, cable)).first_peak;
    table.row(force, elements_peak, plant_peak,
              std::abs(plant_peak - elements_peak) / std::abs(elements_peak));
  }
  table.commit();
}

}  // namespace

void add_decay(CLI::App& program) {
  const Job job(program, "decay", question::cable,
                "Vibration after a force is removed: continuous cable beside the plant");
  const auto options = std::make_shared<DecayOptions>();
  job.add_number("--force", options->force,
                 "Force that is removed, N, downward, beyond the absorber's weight", -1e9, 1e9);
  add_cable_options(job, options->cable, "10");
  job->final_callback([job, options] {
    require_sundials();
    write_decay(job.context(), *options);
  });
}

void add_peaks(CLI::App& program) {
  const Job job(program, "peaks", question::cable,
                "First peak after a force is removed, over the force");
  const auto options = std::make_shared<PeaksOptions>();
  options->cable.elements = 40;
  job.add_text("--force", options->force, "Forces that are removed, MIN:MAX:COUNT, N, downward");
  add_cable_options(job, options->cable, "two periods of reduction.first_frequency");
  job->final_callback([job, options] {
    require_sundials();
    write_peaks(job.context(), *options);
  });
}

}  // namespace holdfast::program
