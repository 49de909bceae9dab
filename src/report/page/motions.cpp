#include "report/page/answers.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "process/interrupt.hpp"
#include "report/figures/figure.hpp"
#include "report/page/html.hpp"
#include "text/compiled_texts.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr const char* no_value = "–";

std::string counted(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The certified orbit; null if there is none. @tparam Found  a classification in any model
template <class Found>
auto certified(const Found& found) {
  return found.search.outcome == OrbitOutcome::certified ? &*found.search.orbit : nullptr;
}

/// Text of the period: seconds, samples, forcing periods. @param sampling_period  τ (s)
template <class Found>
std::string period_text(const Found& found, double sampling_period) {
  const std::int64_t samples = found.classification.period;
  if (samples == 0) return no_value;
  std::string text = rounded(static_cast<double>(samples) * sampling_period, 6) + " s; " +
                     counted(samples, "sample");
  const auto* const orbit = certified(found);
  if (orbit != nullptr && orbit->forcing_periods() > 0)
    text += "; " + counted(orbit->forcing_periods(), "forcing period");
  return text;
}

std::string border_text(const Borders& borders) {
  const auto distance = [](const Border& border, const char* unit) {
    return border.sample < 0 ? std::string("none") : rounded(1e3 * border.distance, 2) + unit;
  };
  return distance(borders.displacement, " mm") + "; " + distance(borders.velocity, " mm/s");
}

/// Text of the distance to the nearest change of contact, with exact switching.
std::string border_text(const SwitchingMargins& margins) {
  return rounded(1e3 * margins.border_distance, 2) + " mm";
}

std::string capture_text(const CaptureRadii& radii) {
  if (!(radii.largest > 0.0)) return "none found";
  if (std::isinf(radii.smallest)) return "everywhere";
  const std::string from = rounded(1e3 * radii.smallest, 2);
  const std::string to = rounded(1e3 * radii.largest, 2);
  return (from == to ? from : from + " … " + to) + " mm";
}

/// @param sampling_period  sampling period τ (s)
/// @param settings         options of the command in the row, which shows the motion in detail
/// @tparam Found           a classification in any model
template <class Found>
MotionRow row_of(const std::string& place, const std::string& text, const Found& found,
                 double sampling_period, const std::string& settings) {
  const Classification& classification = found.classification;
  const auto* const orbit = certified(found);
  MotionRow row{place, text, attractor_type_text(classification),
                period_text(found, sampling_period)};
  row.rests_on = classification.rests_on;
  row.arguments = words_of((orbit != nullptr ? "orbit --certificate " : "verdict ") + settings);
  row.diverges = classification.kind == AttractorType::diverges;
  if (orbit == nullptr) return row;
  row.stays_in_play = orbit->engaged_fraction() == 0.0;
  row.multiplier = rounded(orbit->largest_multiplier(), 3);
  if constexpr (std::is_same_v<decltype(orbit), const PeriodicOrbit* const>)
    row.border = border_text(orbit->borders);
  else
    row.border = border_text(orbit->margins);
  return row;
}

/// Row of a case's motion of two masses that switches at samples, with its radius of attraction.
MotionRow row_of_masses(const std::string& place, const std::string& text, const Case& the_case,
                        const std::string& settings) {
  const IdealLoop<double> loop = ideal_loop_of(the_case);
  const auto found = classify_motion(loop, initial_state_of(the_case));
  MotionRow row = row_of(place, text, found, loop.sampling.period, settings);
  if (const PeriodicOrbit* const orbit = certified(found))
    row.capture = capture_text(capture_radii_of(loop, *orbit));
  return row;
}

}  // namespace

std::string loop_text(const Case& the_case) {
  return "τ = " + rounded(1e3 * the_case.control.sampling_period, 4) +
         " ms, r₀ = " + rounded(1e3 * the_case.backlash.width, 4) + " mm";
}

std::vector<MotionRow> paper_motions(const Case& the_case) {
  std::vector<MotionRow> rows;
  const toml::table texts = toml::parse(page_texts);
  for (const toml::node& node : *texts["paper motions"].as_array()) {
    const toml::array& entry = *node.as_array();
    const std::string period = text_of(entry[1]), width = text_of(entry[2]);
    std::string settings =
        " --set control.sampling_period=" + period + " --set backlash.width=" + width;
    Case changed = case_with(the_case, "control.sampling_period", *parse_number(period));
    set_case_value(changed, "backlash.width", *parse_number(width));
    const bool rests = entry.size() == 3;
    if (!rests) {
      const std::string displacement = text_of(entry[3]);
      set_case_value(changed, "initial.z1", *parse_number(displacement));
      settings += " --set initial.z1=" + displacement;
    }
    const std::string text = loop_text(changed) + ", from " + (rests ? "rest" : text_of(entry[4]));
    rows.push_back(row_of_masses(text_of(entry[0]), text, changed, settings));
  }
  return rows;
}

MotionRow motion_of_the_case(const Case& the_case) {
  const std::string text = loop_text(the_case) + ", from its initial state";
  const MovingLoop loop = smooth_loop_of(the_case, Switching::sampled);
  if (std::holds_alternative<SampledMasses>(loop))
    return row_of_masses("this case", text, the_case, "");
  const OrbitLimits limits{OrbitLimits{}.largest_period, 0, throw_if_interrupted};
  const auto row = [&](const auto& moving) {
    return row_of("this case", text, classify_motion(moving.loop, moving.state, limits),
                  the_case.control.sampling_period, "");
  };
  return std::visit(row, loop);
}

}  // namespace holdfast::program
