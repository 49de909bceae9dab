#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/stringing_of_case.hpp"
#include "holdfast/cable/modes.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// First natural frequency (Hz) of the span at a tension (N), for the mass with ice (kg/m).
double first_frequency(const Case& the_case, double horizontal_tension, double mass_per_length) {
  Conductor<double> conductor = conductor_of(the_case);
  conductor.mass_per_length = mass_per_length;
  conductor.sag = conductor.weight() * conductor.span / (8.0 * horizontal_tension);
  return irvine_modes(conductor, 1).front().frequency;
}

struct SagTensionQuestion {
  std::string temperature;
  bool initial = false;

  void add_to(const Job& job) {
    job.add("--temperature", temperature);
    job.add("--initial", initial);
  }

  std::vector<double> temperatures(const Case& the_case) const {
    const std::vector<double>& of_year = the_case.weather.temperatures;
    if (temperature.empty() && !of_year.empty()) return of_year;
    const std::string range = temperature.empty() ? "-20:80:11" : temperature;
    const Axis axis = parse_axis("--temperature", range);
    require_admissible("--temperature " + range, "weather.temperature", axis.min, axis.max);
    std::vector<double> all;
    for (std::int64_t k = 0; k < axis.count; ++k) all.push_back(axis.at(k));
    return all;
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const StrungSpan span = strung_span_of(the_case);
    Table table(context, columns_of("sag-tension"));
    const auto row = [&](const SpanWeather& weather, double ice, double wind_pressure) {
      const SpanTension found = tension_in(the_case, span, weather, initial);
      const case_tables::Conductor& c = the_case.conductor;
      const double ice_mass = ice > 0.0 ? ice_mass_of(the_case) : 0.0;
      table.row(initial ? "initial" : "final", weather.temperature, ice, wind_pressure,
                found.support, found.horizontal, found.sag, found.core_share,
                first_frequency(the_case, found.horizontal, c.mass_per_length + ice_mass));
    };
    // A span that would break under its load is refused as such.
    if (has_load(the_case)) tension_in(the_case, span, loaded_weather_of(the_case), initial);
    for (const double at : temperatures(the_case)) row(bare_weather_of(the_case, at), 0.0, 0.0);
    const case_tables::Weather& load = the_case.weather;
    if (has_load(the_case)) row(loaded_weather_of(the_case), load.ice, load.wind_pressure);
    if (!conductor_curves_of(the_case).creeps) report_warning(no_creep_note, context.quiet);
    table.commit();
  }

  static constexpr const char* no_creep_note =
      "no stress-strain curves are known for this conductor: its wires are assumed to stretch "
      "linearly and not to creep, so that initial and final tensions are equal";
};

}  // namespace

void add_sag_tension(CLI::App& program) { add_job<SagTensionQuestion>(program, "sag-tension"); }

}  // namespace holdfast::program
