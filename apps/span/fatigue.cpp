#include "case/axes/axis.hpp"
#include "case/model/span/span_of_case.hpp"
#include "job.hpp"
#include "jobs/span/fatigue_life.hpp"
#include "jobs/span/span_words.hpp"

namespace holdfast::program {
namespace {

struct FatigueQuestion {
  std::optional<std::string> frequency;
  bool no_control = false;
  bool by_speed = false, by_temperature = false;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--no-control", no_control);
    job.add("--by-speed", by_speed);
    job.add("--by-temperature", by_temperature);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    if (by_temperature && the_case.weather.hours.empty())
      throw WrongInput(
          "--by-temperature needs the yearly hours of each temperature: give "
          "weather.temperatures and weather.hours, and [stringing]");
    const Range range = counted(the_case);
    require_measured(the_case, range.min, range.max);
    report_warning(absent_absorber_note(the_case), context.quiet);
    const FatigueLife life = fatigue_life_of(the_case, !no_control, range.min, range.max);
    report_warning(self_damping_note(the_case), context.quiet);
    report_warning(life_line_note(the_case), context.quiet);
    report_warning(life_advice(life, the_case.site.years), context.quiet);
    report_warning(instability_note(the_case, !no_control), context.quiet);
    by_speed         ? write_speeds(context, life)
    : by_temperature ? write_temperatures(context, life)
                     : write_life(context, life);
  }

 private:
  Range counted(const Case& the_case) const {
    if (frequency) {
      const Range range = parse_range("--frequency", *frequency);
      require_frequencies("--frequency", *frequency, range.min, range.max);
      return range;
    }
    const Axis usual = aeolian_frequencies(the_case);
    return {usual.min, usual.max};
  }

  static void write_life(const JobContext& context, const FatigueLife& life) {
    Table table(context, columns_of("fatigue"));
    const auto row = [&](const char* quantity, const Band& band, const char* unit) {
      table.row(std::string(quantity), band.value, band.lowest, band.highest, std::string(unit));
    };
    const double years = context.case_data.site.years;
    const auto served = [&](const Band& damage) {
      return Band{years * damage.value, years * damage.lowest, years * damage.highest};
    };
    row("cycles_per_year", {life.cycles, life.cycles, life.cycles}, "");
    row("largest_stress_bare", life.stress_bare, "Pa");
    row("largest_stress", life.stress, "Pa");
    row("damage_per_year_bare", life.damage_bare, "");
    row("damage_per_year", life.damage, "");
    row("damage_in_service_bare", served(life.damage_bare), "");
    row("damage_in_service", served(life.damage), "");
    row("life_bare", years_of(life.damage_bare), "year");
    row("life", years_of(life.damage), "year");
    table.commit();
  }

  static void write_speeds(const JobContext& context, const FatigueLife& life) {
    Table table(context, columns_of("fatigue by speed"));
    for (const SpeedDamage& row : life.by_speed)
      table.row(row.speed, row.hours, row.damage_bare, row.damage.lowest, row.damage.highest,
                row.damage.value);
    table.commit();
  }

  static void write_temperatures(const JobContext& context, const FatigueLife& life) {
    Table table(context, columns_of("fatigue by temperature"));
    for (const TemperatureDamage& row : life.by_temperature)
      table.row(row.temperature, row.hours, row.tension,
                row.tension / context.case_data.conductor.rated_strength, row.damage_bare,
                row.damage.lowest, row.damage.highest, row.damage.value);
    table.commit();
  }
};

}  // namespace

void add_fatigue(CLI::App& program) { add_job<FatigueQuestion>(program, "fatigue"); }

}  // namespace holdfast::program
