#include "jobs/span/mode_dampings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/math/roots/root_from_pole.hpp"
#include "holdfast/span/span_roots.hpp"
#include "holdfast/stability/response/modal_damping.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr double turn = 2.0 * pi<double>;

/// Damping ratio by Krenk's asymptote at a frequency (Hz), for the absorber as only device.
double asymptote(const Case& the_case, const TautString<double>& string,
                 const std::vector<SpanDevice>& devices, double frequency) {
  TautString<double> damped = string;
  damped.damping_ratio = 0.0;
  const int n = static_cast<int>(std::lround(frequency * 2.0 * string.span / string.wave_speed()));
  return bare_damping_of(the_case, turn * frequency) +
         (n > 0 ? span_root_laws(damped, devices, n).asymptotic : 0.0);
}

std::vector<ModeRow> rows_of_plant(const Case& the_case, int count, bool controlled) {
  const PdGains<double> gains = controlled ? gains_of(the_case) : PdGains<double>{0.0, 0.0};
  const ConductorModes conductor = conductor_modes_of(the_case);
  const auto modes = modal_damping(conductor.modes, absorber_of(the_case), sampling_of(the_case),
                                   gains, hardware_of(the_case));
  const TautString<double> string = string_of(the_case);
  const std::vector<SpanDevice> absorber = {active_device_of(the_case, controlled)};
  std::vector<ModeRow> rows;
  for (const ModeDamping& mode : modes) {
    if (static_cast<int>(rows.size()) >= std::min(count, conductor.apart)) break;
    const double frequency = mode.angular_frequency / turn;
    rows.push_back({frequency, mode.bare, mode.root, mode.first_order,
                    asymptote(the_case, string, absorber, frequency)});
  }
  return rows;
}

/// Roots of the sampled loop. Each root is continued from the pole of a mode without control.
class LoopRoots {
 public:
  explicit LoopRoots(const Case& the_case)
      : gains_(gains_of(the_case)),
        period_(the_case.control.sampling_period),
        poles_(loop_poles_of(the_case)),
        response_(modal_response(poles_, sampling_of(the_case))
                      .with_sensor(hardware_of(the_case).has_velocity_sensor)) {}

  std::complex<double> from(const std::complex<double>& root) const {
    const auto nearest =
        std::min_element(poles_.begin(), poles_.end(), [&](const PlantPole& a, const PlantPole& b) {
          return std::abs(a.s - root) < std::abs(b.s - root);
        });
    const auto of_gains = [&](const std::complex<double>& s) {
      const auto g = response_.at_distance_from_one(complex_expm1(s * period_));
      return gains_.proportional * g.displacement + gains_.differential * g.velocity;
    };
    return root_from_pole(of_gains, nearest->s);
  }

 private:
  PdGains<double> gains_;
  double period_;
  std::vector<PlantPole> poles_;
  ModalResponse<double> response_;
};

std::vector<ModeRow> rows_of_span(const Case& the_case, int count, bool controlled) {
  Case on_string = the_case;
  on_string.plant.model = "string";
  const bool is_active = has_active_absorber(the_case) && controlled;
  const auto passive = span_devices_of(on_string, false);
  const auto all = span_devices_of(on_string, controlled);
  std::optional<LoopRoots> loop;
  if (is_active) loop.emplace(on_string);
  TautString<double> string = string_of(on_string);
  std::vector<ModeRow> rows;
  for (int n = 1; n <= count; ++n) {
    throw_if_interrupted();
    const double frequency = n * string.wave_speed() / (2.0 * string.span);
    string.damping_ratio = bare_damping_of(on_string, turn * frequency);
    const SpanRoot still = span_root(string, passive, n);
    const SpanRoot laws = span_root_laws(string, all, n);
    rows.push_back({frequency, string.damping_ratio, loop ? loop->from(still.root) : still.root,
                    laws.first_order, laws.asymptotic});
  }
  return rows;
}

}  // namespace

double ModeRow::damping() const { return -root.real() / std::abs(root); }

std::vector<ModeRow> mode_rows_of(const Case& the_case, int count, bool controlled) {
  if (!the_case.devices.empty() || (the_case.stands_alone && !has_absorber(the_case)))
    return rows_of_span(the_case, count, controlled);
  return rows_of_plant(the_case, count, controlled);
}

std::string growth_text(const Case& the_case, const std::vector<ModeRow>& modes) {
  const bool is_judged = !the_case.devices.empty() || has_chosen_modes(the_case);
  const UnitCircleCrossings<double> circle =
      is_judged ? judged_loop_of(the_case).circle
                : UnitCircleCrossings<double>(command_response_of(the_case));
  const int outside = circle.roots_outside(gains_of(the_case));
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
            "a faster mode or the absorber's clamp under control grows";
  return text;
}

}  // namespace holdfast::program
