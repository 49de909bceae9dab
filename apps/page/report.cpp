#include "report/page/report.hpp"

#include "job.hpp"

namespace holdfast::program {
namespace {

struct ReportQuestion {
  void add_to(const Job&) {}

  void run(const Job& job) const {
    const JobContext context = job.context();
    if (!context.output || *context.output == "-")
      throw WrongInput("--output DIRECTORY is needed: a report is a folder");
    write_report(context, job.case_arguments(), do_job);
  }
};

}  // namespace

void add_report(CLI::App& program) { add_job<ReportQuestion>(program, "report"); }

}  // namespace holdfast::program
