#include "report/page/report.hpp"

#include "job.hpp"

namespace holdfast::program {
namespace {

/// Refuses devices in a report on the control loop, which includes only the absorber.
void require_no_devices(const Case& the_case) {
  if (the_case.devices.empty()) return;
  throw WrongInput(
      "report --for control includes only the absorber, but the case has [[device]]: remove the "
      "devices, or give --for span");
}

struct ReportQuestion {
  std::string reader = "control";

  void add_to(const Job& job) { job.add("--for", reader); }

  void run(const Job& job) const {
    const bool of_span = reader == "span";
    const JobContext context = job.context(std::nullopt, !of_span);
    if (!context.output || *context.output == "-")
      throw WrongInput("--output DIRECTORY is needed: a report is a folder");
    if (of_span) return write_span_report(context, job.case_arguments(), do_job);
    require_no_devices(context.case_data);
    write_report(context, job.case_arguments(), do_job);
  }
};

}  // namespace

void add_report(CLI::App& program) { add_job<ReportQuestion>(program, "report"); }

}  // namespace holdfast::program
