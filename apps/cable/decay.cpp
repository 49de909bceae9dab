#include "case/axes/axis.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Common options of the jobs decay and peaks.
struct CableOptions {
  std::optional<double> duration;
  double interval = 0.001;
  int elements = 100;
  std::string absorber = "weight";
  bool equal_displacement = false;

  void add_to(const Job& job) {
    job.add("--absorber", absorber);
    job.add("--equal-displacement", equal_displacement);
    job.add("--elements", elements);
    job.add("--duration", duration);
    job.add("--interval", interval);
  }

  /// The decay options. @param usual_duration  duration (s) if --duration is not given
  CableDecayOptions question(double force, double usual_duration) const {
    const auto reading = absorber == "rigid"    ? AbsorberReading::rigid_mass
                         : absorber == "spring" ? AbsorberReading::spring_mass
                                                : AbsorberReading::weight;
    constexpr double most_rows = 1e7;
    const double time = duration.value_or(usual_duration);
    if (interval > time)
      throw WrongInput("--interval = " + format_number(interval) + ": must be at most " +
                       format_number(time) + " s, the --duration");
    if (time > most_rows * interval)
      throw WrongInput("--interval = " + format_number(interval) + ": must be at least " +
                       format_number(time / most_rows) + " s: --duration " + format_number(time) +
                       " s allows at most ten million rows");
    return {force, time, interval, elements, reading};
  }
};

struct DecayQuestion {
  double force = 0.2;
  CableOptions cable;

  void add_to(const Job& job) {
    job.add("--force", force);
    cable.add_to(job);
  }

  void run(const Job& job) const {
    require_sundials();
    const JobContext context = job.context();
    report_warning(borrowed_cable_warning(context.case_data), context.quiet);
    Table table(context, columns_of("decay"));
    const CableDecay of_cable = cable_decay(context.case_data, cable.question(force, 10.0));
    const DecayRecord plant =
        plant_decay(plant_of(context.case_data), force, cable.equal_displacement, of_cable);
    for (std::size_t k = 0; k < plant.times.size(); ++k)
      table.row(plant.times[k], of_cable.record.displacements[k], plant.displacements[k]);
    table.commit();
  }
};

struct PeaksQuestion {
  std::string force = "-1:1:21";
  CableOptions cable;

  void add_to(const Job& job) {
    cable.elements = 40;
    job.add("--force", force);
    cable.add_to(job);
  }

  void run(const Job& job) const {
    require_sundials();
    const JobContext context = job.context();
    report_warning(borrowed_cable_warning(context.case_data), context.quiet);
    const Axis forces = parse_axis("--force", force);
    const double duration = 2.0 / context.case_data.reduction.first_frequency;
    Table table(context, columns_of("peaks"));
    Progress progress(static_cast<std::uint64_t>(forces.count), "peaks", progress_wanted(context));
    bool has_peak = false;
    for (std::int64_t k = 0; k < forces.count; ++k) {
      progress.advance();
      const double removed = forces.at(k);
      if (removed == 0.0) {
        table.row(0.0, 0.0, 0.0, std::nan(""));
        has_peak = has_peak || forces.count == 1;
        continue;
      }
      const CableDecay of_cable = cable_decay(context.case_data, cable.question(removed, duration));
      const double elements_peak = decay_measures(of_cable.record).first_peak;
      const DecayRecord of_plant =
          plant_decay(plant_of(context.case_data), removed, cable.equal_displacement, of_cable);
      const double plant_peak = decay_measures(of_plant).first_peak;
      has_peak = has_peak || std::isfinite(elements_peak) || std::isfinite(plant_peak);
      table.row(removed, elements_peak, plant_peak,
                std::abs(plant_peak - elements_peak) / std::abs(elements_peak));
    }
    if (!has_peak)
      throw NoAnswer("the vibration has no first peak within " +
                     format_number(cable.duration.value_or(duration)) +
                     " s after any force of --force is removed: give a longer --duration");
    table.commit();
  }
};

}  // namespace

void add_decay(CLI::App& program) { add_job<DecayQuestion>(program, "decay"); }
void add_peaks(CLI::App& program) { add_job<PeaksQuestion>(program, "peaks"); }

}  // namespace holdfast::program
