#include "case/model/loop_of_case.hpp"
#include "explorer/explorer_page.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

void explore(const JobContext& context) {
  if (!context.output || *context.output == "-")
    throw WrongInput("--output FILE.html is needed: the explorer is a page for a browser");
  if (context.output->extension() != ".html")
    throw WrongInput("--output " + context.output->string() +
                     ": the explorer is a page for a browser; let its name end in .html");
  require_loop_keys(context.case_data);
  excitation_of(context.case_data);
  write_explorer_page(*context.output, context.case_data, context.case_source);
}

}  // namespace

void add_explore(CLI::App& program) { add_job(program, "explore", explore); }

}  // namespace holdfast::program
