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
      if (!is_store_name(file)) require_output_name(file, false);
      context.output = file;
    }
    convert_store(context, store);
  }
};

}  // namespace

/// It takes no case: the store has its own. A host gets the table where it gives no file.
void add_convert(CLI::App& program) {
  CLI::App* options = add_subcommand(program, "convert");
  const auto question = std::make_shared<ConvertQuestion>();
  options->add_option("IN", question->store, "A store that holdfast has written")
      ->type_name("STORE.zarr")
      ->required();
  options->add_option("OUT", question->file, "File to be written: .csv, .nc or .zarr")
      ->type_name("FILE")
      ->required(JobHost::current() == nullptr);
  options->add_option("--zarr-format", question->context.zarr_format, "Zarr format: 2 or 3")
      ->check(CLI::Range(2, 3))
      ->capture_default_str();
  options->add_flag("--quiet", question->context.quiet, "Show no warnings");
  options->add_flag("--yes", question->context.yes,
                    "Allow a text table of more than ten million cells");
  options->final_callback([question] { question->run(); });
}

}  // namespace holdfast::program
