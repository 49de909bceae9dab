#include "case/model/span/span_of_case.hpp"
#include "job.hpp"
#include "jobs/span/mode_dampings.hpp"

namespace holdfast::program {
namespace {

struct ModalDampingQuestion {
  std::int64_t count = 20;
  bool no_control = false;

  void add_to(const Job& job) {
    job.add("--count", count);
    job.add("--no-control", no_control);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const bool has_devices = !the_case.devices.empty() || !has_absorber(the_case);
    if (has_devices) report_warning(absent_absorber_note(the_case), context.quiet);
    Table table(context, columns_of("modal-damping"));
    // All that grow are named, not those alone that are shown.
    constexpr int most = 1000;
    const int asked = has_devices ? static_cast<int>(count) : most;
    const auto modes = mode_rows_of(the_case, asked, !no_control);
    std::int64_t number = 0;
    for (const ModeRow& mode : modes) {
      if (++number > count) break;
      table.row(number, mode.frequency, mode.bare, mode.damping(), mode.first_order,
                mode.asymptotic);
    }
    warn(modes, context.quiet);
    const bool is_active = !no_control && (!has_devices || has_active_absorber(the_case));
    if (is_active) report_warning(growth_text(the_case, modes), context.quiet);
    table.commit();
  }

 private:
  void warn(const std::vector<ModeRow>& modes, bool quiet) const {
    std::int64_t number = 0, lost = 0, not_light = 0;
    for (const ModeRow& mode : modes) {
      lost += std::isnan(mode.damping()) ? 1 : 0;
      if (++number > count) continue;
      const double added = mode.damping() - mode.bare, promised = mode.first_order - mode.bare;
      // A root that hardly moves is left to round-off.
      const bool counts = std::abs(promised) > 0.01 * mode.bare + 1e-9;
      not_light += counts && !(std::abs(added - promised) < 0.5 * std::abs(promised)) ? 1 : 0;
    }
    if (number < count && number > 0)
      report_warning("only " + std::to_string(number) + " modes are computed, not " +
                         std::to_string(count) + ": set plant.modes = " + std::to_string(count) +
                         " to compute as many",
                     quiet);
    if (not_light > 0)
      report_warning(
          "damping_ratio_first_order holds only for light devices, whose forces are small: for " +
              std::to_string(not_light) +
              " of the modes shown it errs by 50 % or more of the added damping",
          quiet);
    if (lost > 0)
      report_warning(std::to_string(lost) +
                         " mode(s) have damping nan: their roots could not be followed while the "
                         "devices and gains were increased from 0 to the values of the case",
                     quiet);
  }
};

}  // namespace

void add_modal_damping(CLI::App& program) {
  add_job<ModalDampingQuestion>(program, "modal-damping");
}

}  // namespace holdfast::program
