#include <array>
#include <string>

#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/modes.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

struct ModesOptions {
  int count = 6;
  int elements = 200;
};

/// Frequencies of the finite elements of one family, ascending, without the modes along the span,
/// which Irvine and Caughey do not have.
std::vector<double> of_family(const ElementsModes& modes, ModeFamily family) {
  std::vector<double> frequencies;
  for (const ElementsMode& mode : modes.modes)
    if (mode.family == family && mode.along_share < 0.5) frequencies.push_back(mode.frequency);
  return frequencies;
}

void run(const JobContext& context, const ModesOptions& options) {
  if (options.elements % 2 != 0 || options.elements < 4 * options.count)
    throw WrongInput("--elements = " + std::to_string(options.elements) + ": with --count = " +
                     std::to_string(options.count) + ", admissible is an even number from " +
                     std::to_string(4 * options.count) + " on");
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  report_warning(deep_cable_warning(context.case_data), context.quiet);
  const Conductor<double> conductor = conductor_of(context.case_data);
  const auto irvine = irvine_modes(conductor, options.count);
  const ElementsModes elements =
      elements_modes(conductor, options.elements, 2 * (options.elements - 1));
  if (elements.outcome != EquilibriumOutcome::converged)
    throw NoAnswer("no equilibrium of the elements was found");
  const std::array<std::vector<double>, 2> found = {of_family(elements, ModeFamily::symmetric),
                                                    of_family(elements, ModeFamily::antisymmetric)};
  Table table(context, {{"mode", "", "number in ascending frequency", "integer"},
                        {"family", "", "symmetric or antisymmetric about mid-span", "string"},
                        {"irvine_Hz", "Hz", "frequency of the bare conductor, Irvine and Caughey"},
                        {"elements_Hz", "Hz", "the same by finite elements, same family"}});
  std::array<std::size_t, 2> taken = {0, 0};
  for (std::size_t k = 0; k < irvine.size(); ++k) {
    const bool symmetric = irvine[k].family == ModeFamily::symmetric;
    const std::size_t which = symmetric ? 0 : 1;
    table.row(k + 1, symmetric ? "symmetric" : "antisymmetric", irvine[k].frequency,
              found[which].at(taken[which]++));
  }
  table.commit();
}

}  // namespace

void add_modes(CLI::App& program) {
  const Job job(program, "modes", question::cable,
                "In-plane natural frequencies of the bare conductor");
  const auto options = std::make_shared<ModesOptions>();
  job->add_option("--count", options->count, "How many, from the lowest")
      ->check(CLI::Range(1, 200))
      ->type_name("N")
      ->capture_default_str();
  job->add_option("--elements", options->elements, "Bars of the continuous cable, even")
      ->check(CLI::Range(4, 1000))
      ->type_name("N")
      ->capture_default_str();
  job->final_callback([job, options] { run(job.context(PlantNeed::none), *options); });
}

}  // namespace holdfast::program
