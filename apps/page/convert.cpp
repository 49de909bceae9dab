#include "host/job_host.hpp"
#include "io/file/output.hpp"
#include "job.hpp"
#include "store/stored_grid.hpp"

namespace holdfast::program {
namespace {

struct ConvertQuestion {
  std::string store, file;
  JobContext context;

  void run() {
    if (!file.empty()) {
      const std::filesystem::path name(file);
      if (name.extension() != ".csv" && !is_netcdf_name(name))
        throw WrongInput("convert: cannot write " + file +
                         ": give a name that ends in .csv or .nc");
      context.output = file;
    }
    convert_store(context, store);
  }
};

}  // namespace

/// Adds the job `convert`, which takes no case. A JobHost may omit the file and gets the table.
void add_convert(CLI::App& program) {
  CLI::App* options = add_subcommand(program, "convert");
  const auto question = std::make_shared<ConvertQuestion>();
  options->add_option("IN", question->store, "A store that holdfast has written")
      ->type_name("STORE.zarr")
      ->required();
  options->add_option("OUT", question->file, "File to be written: .csv or .nc")
      ->type_name("FILE")
      ->required(JobHost::current() == nullptr);
  options->add_flag("--quiet", question->context.quiet, "Show no warnings");
  options->add_flag("--yes", question->context.yes,
                    "Allow a text table of more than ten million cells");
  options->final_callback([question] { question->run(); });
}

}  // namespace holdfast::program
