#include <array>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/modes.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Whether a mode is transverse, as Irvine and Caughey assume. Longitudinal modes begin at about
/// sqrt(EA/mu)/(2 L); a slower mode moves along the span only because of the sag.
bool is_across(const ElementsMode& mode, const Conductor<double>& conductor) {
  const double slowest_along =
      std::sqrt(conductor.youngs_modulus * conductor.area / conductor.mass_per_length) /
      (2.0 * conductor.span);
  return mode.along_share < 0.5 || mode.frequency < 0.5 * slowest_along;
}

/// Frequencies (Hz) by Irvine and Caughey, returned in ascending order for each family of modes.
class IrvineFrequencies {
 public:
  /// Computes the first modes, about equally many of each family.
  IrvineFrequencies(const Conductor<double>& conductor, int of_each)
      : modes_(irvine_modes(conductor, 2 * of_each + 2)) {}

  double next(ModeFamily family) {
    std::size_t& at = taken_[family == ModeFamily::symmetric ? 0 : 1];
    while (modes_[at].family != family) ++at;
    return modes_[at++].frequency;
  }

 private:
  std::vector<CableMode> modes_;
  std::array<std::size_t, 2> taken_ = {0, 0};
};

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
                       " it must be an even number, at least " + std::to_string(4 * count));
    report_warning(borrowed_cable_warning(context.case_data), context.quiet);
    const Conductor<double> conductor = conductor_of(context.case_data);
    const ElementsModes found = elements_modes(conductor, elements, count);
    if (found.outcome != EquilibriumOutcome::converged)
      throw NoAnswer("no static equilibrium of the cable in " + std::to_string(elements) +
                     " elements was found: try another --elements, or check [conductor]");
    IrvineFrequencies irvine(conductor, count);
    Table table(context, columns_of("modes"));
    for (int k = 0; k < count; ++k) {
      const ElementsMode& mode = found.modes[static_cast<std::size_t>(k)];
      table.row(k + 1, mode.family == ModeFamily::symmetric ? "symmetric" : "antisymmetric",
                is_across(mode, conductor) ? irvine.next(mode.family) : std::nan(""),
                mode.frequency, mode.along_share);
    }
    table.commit();
  }
};

}  // namespace

void add_modes(CLI::App& program) { add_job<ModesQuestion>(program, "modes"); }

}  // namespace holdfast::program
