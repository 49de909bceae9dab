#include <array>

#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/modes.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Frequencies of the finite elements of one family, ascending, without the modes along the span,
/// which Irvine and Caughey do not have.
std::vector<double> of_family(const ElementsModes& modes, ModeFamily family) {
  std::vector<double> frequencies;
  for (const ElementsMode& mode : modes.modes)
    if (mode.family == family && mode.along_share < 0.5) frequencies.push_back(mode.frequency);
  return frequencies;
}

struct ModesQuestion {
  int count = 6;
  int elements = 200;

  void add_to(const Job& job) {
    job.add("--count", count);
    job.add("--elements", elements);
  }

  void run(const JobContext& context) const {
    if (elements % 2 != 0 || elements < 4 * count)
      throw WrongInput("--elements = " + std::to_string(elements) +
                       ": with --count = " + std::to_string(count) +
                       ", admissible is an even number from " + std::to_string(4 * count) + " on");
    report_warning(borrowed_cable_warning(context.case_data), context.quiet);
    const Conductor<double> conductor = conductor_of(context.case_data);
    const auto irvine = irvine_modes(conductor, count);
    const ElementsModes modes = elements_modes(conductor, elements, 2 * (elements - 1));
    if (modes.outcome != EquilibriumOutcome::converged)
      throw NoAnswer("no equilibrium of the elements was found");
    const std::array<std::vector<double>, 2> found = {of_family(modes, ModeFamily::symmetric),
                                                      of_family(modes, ModeFamily::antisymmetric)};
    Table table(context, columns_of("modes"));
    std::array<std::size_t, 2> taken = {0, 0};
    for (std::size_t k = 0; k < irvine.size(); ++k) {
      const bool symmetric = irvine[k].family == ModeFamily::symmetric;
      const std::size_t which = symmetric ? 0 : 1;
      table.row(k + 1, symmetric ? "symmetric" : "antisymmetric", irvine[k].frequency,
                found[which].at(taken[which]++));
    }
    table.commit();
  }
};

}  // namespace

void add_modes(CLI::App& program) { add_job<ModesQuestion>(program, "modes"); }

}  // namespace holdfast::program
