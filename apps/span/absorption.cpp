#include <array>
#include <cmath>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "job.hpp"
#include "jobs/span/span_words.hpp"

namespace holdfast::program {
namespace {

/// Impedance Z (N s/m) of a single device at the place of the outermost device that would cause the
/// same reflection: that of the end there plus i Z_c cot ka for the string to the support.
std::complex<double> impedance_alone(const TautString<double>& string, const SpanEnd& end,
                                     const EndResponse& response, double omega) {
  const double phase = omega * end.distances.back() / string.wave_speed();
  return response.impedance + std::complex<double>(0.0, string.wave_impedance() / std::tan(phase));
}

struct AbsorptionQuestion {
  std::string frequency = "3:150:148";
  std::string end;
  bool no_control = false;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--end", end);
    job.add("--no-control", no_control);
  }

  /// End of the span as requested, or the end with devices.
  SpanEnd chosen(const std::array<SpanEnd, 2>& ends) const {
    const bool right = end == "right" || (end.empty() && ends[0].devices.empty());
    if (!ends[right ? 1 : 0].devices.empty()) return ends[right ? 1 : 0];
    throw WrongInput(end.empty()
                         ? "no device is on the span: give [[device]] or [absorber]"
                         : "--end " + end +
                               ": no device is in that half of the span; give the other end");
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const Axis axis = parse_frequencies("--frequency", frequency);
    require_measured(the_case, axis.min, axis.max);
    report_warning(absent_absorber_note(the_case), context.quiet);
    const TautString<double> string = string_of(the_case);
    const auto devices = span_devices_of(the_case, !no_control);
    const auto ends = span_ends(devices, string.span);
    const SpanEnd asked = chosen(ends);
    if (end.empty() && !ends[0].devices.empty() && !ends[1].devices.empty())
      report_warning("the left end is shown; give --end right for the devices at the right end",
                     context.quiet);
    require_text_meant(context, axis.count, "rows", "give a smaller COUNT in --frequency");
    report_warning(instability_note(the_case, !no_control), context.quiet);
    Table table(context, columns_of("absorption"));
    for (std::int64_t k = 0; k < axis.count; ++k) {
      throw_if_interrupted();
      const double omega = 2.0 * pi<double> * axis.at(k);
      const EndResponse response = end_response(string, asked, omega);
      const auto z = impedance_alone(string, asked, response, omega);
      table.row(axis.at(k), z.real(), z.imag(), std::abs(response.reflection),
                response.absorbed_fraction(), response.inverse_standing_wave_ratio());
    }
    table.commit();
  }
};

}  // namespace

void add_absorption(CLI::App& program) { add_job<AbsorptionQuestion>(program, "absorption"); }

}  // namespace holdfast::program
