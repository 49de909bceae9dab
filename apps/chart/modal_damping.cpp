#include "holdfast/stability/response/modal_damping.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Which roots of an unstable loop grow: those of the conductor's modes, or the absorber's with its
/// computer; empty where none does.
std::string growth_text(const Case& the_case, const std::vector<ModeDamping>& modes) {
  const int outside = circle_of(the_case).roots_outside(gains_of(the_case));
  int growing = 0;
  std::string names;
  for (std::size_t n = 0; n < modes.size(); ++n) {
    if (!(modes[n].damping() < 0.0)) continue;
    if (++growing <= 3) names += (names.empty() ? "mode " : ", ") + std::to_string(n + 1);
  }
  if (outside <= 0) return "";
  std::string text = "the loop is unstable: ";
  if (growing > 0)
    text += names + (growing > 3 ? " and others grow" : growing > 1 ? " grow" : " grows");
  // A pair each.
  if (outside > 2 * growing || growing == 0)
    text += std::string(growing > 0 ? ", and " : "") +
            "a root grows that is no mode of the conductor: the absorber's place with its "
            "computer, which feels the waves that it sends out and its clamp";
  return text;
}

struct ModalDampingQuestion {
  std::int64_t count = 20;
  bool no_control = false;

  void add_to(const Job& job) {
    job.add("--count", count);
    job.add("--no-control", no_control);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    if (is_two_masses(the_case) || is_infinite(the_case))
      throw WrongInput(
          std::string("modal-damping is of the conductor's modes, and the case's plant ") +
          (is_infinite(the_case) ? "has none" : "is two masses") + ": add --set plant.model=cable");
    const PdGains<double> gains = no_control ? PdGains<double>{0.0, 0.0} : gains_of(the_case);
    Table table(context, columns_of("modal-damping"));
    const ConductorModes conductor = conductor_modes_of(the_case);
    const auto modes = modal_damping(conductor.modes, absorber_of(the_case), sampling_of(the_case),
                                     gains, hardware_of(the_case));
    std::int64_t number = 0, lost = 0, not_light = 0;
    for (const ModeDamping& mode : modes) {
      lost += std::isnan(mode.damping()) ? 1 : 0;
      if (++number > count || number > conductor.apart) continue;
      table.row(number, mode.angular_frequency / (2.0 * pi<double>), mode.bare, mode.damping(),
                mode.first_order);
      const double added = mode.damping() - mode.bare, promised = mode.first_order - mode.bare;
      // Of what hardly moves round-off decides.
      const bool counts = std::abs(promised) > 0.01 * mode.bare + 1e-9;
      not_light += counts && !(std::abs(added - promised) < 0.5 * std::abs(promised)) ? 1 : 0;
    }
    if (not_light > 0)
      report_warning("damping_ratio_first_order is the law of a light device; to " +
                         std::to_string(not_light) +
                         " of the modes shown the absorber is not light: it is more than twice off",
                     context.quiet);
    if (lost > 0)
      report_warning(std::to_string(lost) +
                         " mode(s) could not be followed as the absorber and "
                         "the gains grow: their damping is nan",
                     context.quiet);
    if (!no_control) report_warning(growth_text(the_case, modes), context.quiet);
    table.commit();
  }
};

}  // namespace

void add_modal_damping(CLI::App& program) {
  add_job<ModalDampingQuestion>(program, "modal-damping");
}

}  // namespace holdfast::program
