#include "report/page/report.hpp"

#include "job.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

void add_report(CLI::App& program) {
  const Job job(
      program, "report", question::all,
      "A folder with every table and picture of the case, and one report.html that shows them");
  job.computes_on_packs();
  job->final_callback([job] {
    const JobContext context = job.context();
    if (!context.output || *context.output == "-") {
      throw WrongInput("--output DIRECTORY is needed: a report is a folder");
    }
    write_report(context, job.case_arguments(), do_job);
  });
}

}  // namespace holdfast::program
