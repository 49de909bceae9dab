#include <filesystem>
#include <memory>
#include <optional>

#include "case/case_file.hpp"
#include "io/file/output.hpp"
#include "job.hpp"
#include "jobs/cable/case_table.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct CaseOptions {
  std::optional<std::string> begun;
  std::optional<std::string> checked;
};

/// A case file that is there already is somebody's work.
void write_case_file(const JobContext& context, const std::string& name) {
  if (name != "-" && std::filesystem::exists(name))
    throw WrongInput("--init " + name + ": there is such a file already");
  OutputFile file(name);
  file.write(case_to_toml(context.case_data));
  file.commit();
}

void run(const Job& job, const CaseOptions& options) {
  if (options.begun && options.checked)
    throw WrongInput("--init begins a case file and --check explains one: give one of them");
  const JobContext context = job.context(PlantNeed::whole, options.checked);
  if (options.begun) return write_case_file(context, *options.begun);
  write_case_table(context);
}

}  // namespace

void add_case(CLI::App& program) {
  const Job job(program, "case", question::case_file,
                "Begins a case file, or explains every value of one and what follows from it");
  const auto options = std::make_shared<CaseOptions>();
  job->add_option("--init", options->begun,
                  "Write the case, built-in or --case with --set, as a commented case file")
      ->type_name("FILE");
  job->add_option("--check", options->checked,
                  "Explain this case file: every value, where it comes from, what it means")
      ->type_name("FILE");
  job->final_callback([job, options] { run(job, *options); });
}

}  // namespace holdfast::program
