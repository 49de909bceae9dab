#include "case/model/modal/modal_plant_of_case.hpp"
#include "explorer/explorer_page.hpp"
#include "io/file/output.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

void explore(const JobContext& context) {
  if (!context.output || *context.output == "-")
    throw WrongInput("--output FILE.html is needed: the explorer is a page for a browser");
  if (context.output->extension() != ".html")
    throw WrongInput("--output " + context.output->string() +
                     ": the explorer is a page for a browser; let its name end in .html");
  require_absorber(context.case_data);
  OutputFile file(context.output);
  file.write(explorer_page(context.case_data, context.case_source));
  file.commit();
}

}  // namespace

void add_explore(CLI::App& program) { add_job(program, "explore", explore); }

}  // namespace holdfast::program
