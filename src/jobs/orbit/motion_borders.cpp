#include "jobs/orbit/motion_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/orbit/event/event_motion_region.hpp"
#include "holdfast/orbit/motion_region.hpp"
#include "jobs/columns.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "jobs/orbit/proved_orbit.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "text/names.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr Named<BorderKind> border_names[] = {{BorderKind::fold, "fold"},
                                              {BorderKind::flip, "flip"},
                                              {BorderKind::neimark_sacker, "neimark_sacker"},
                                              {BorderKind::border_collision, "border_collision"},
                                              {BorderKind::grazing, "grazing"},
                                              {BorderKind::sliding, "sliding"},
                                              {BorderKind::switch_at_sample, "switch_at_sample"},
                                              {BorderKind::jump, "jump"},
                                              {BorderKind::window, "range_end"}};

bool moves_the_orbit(const std::string& key) {
  const bool of_the_loop = key == "control.proportional_gain" ||
                           key == "control.differential_gain" || key == "control.processing_delay";
  return of_the_loop || key.rfind("plant.", 0) == 0 || key == "backlash.width" ||
         key == "excitation.amplitude";
}

/// Whether a key changes the ratio f τ of sampling period and excitation period.
bool moves_the_coincidence(const std::string& key) {
  return key == "control.sampling_period" || key == "excitation.frequency";
}

std::vector<FollowedKey> map_keys(const Case& the_case, const std::vector<std::string>& axes) {
  require_two_keys("--map", axes,
                   "--map backlash.width=0.0005:0.002 --map control.differential_gain=-20:0");
  std::vector<FollowedKey> keys{followed_key(the_case, "--map", axes[0]),
                                followed_key(the_case, "--map", axes[1])};
  if (moves_the_coincidence(keys[0].name) && moves_the_coincidence(keys[1].name))
    throw WrongInput(
        "--map: control.sampling_period and excitation.frequency cannot both be keys, since their "
        "product stays constant on the map: give another key for one of them");
  for (const FollowedKey& key : keys)
    if (moves_the_coincidence(key.name) && !the_case.excitation.harmonics.empty())
      throw WrongInput(
          "--map " + key.name +
          ": the orbit cannot be followed, since the phases of excitation.harmonics at "
          "the samples would change: remove excitation.harmonics or give another key");
  return keys;
}

/// Function from a point of the map to its case; f τ, δ/τ and the gain P stay constant.
class CaseOfMap {
 public:
  CaseOfMap(const Case& the_case, const std::vector<FollowedKey>& keys)
      : keys_(keys), case_(the_case), cycles_(frequency() * period()), delay_(delay() / period()) {
    set_case_value(case_, "control.proportional_gain",
                   case_value(case_, "control.proportional_gain"));
  }

  Case operator()(double x, double y) const {
    Case there = case_;
    set_case_value(there, keys_[0].name, x);
    set_case_value(there, keys_[1].name, y);
    for (const FollowedKey& key : keys_) {
      if (key.name == "control.sampling_period")
        set_case_value(there, "excitation.frequency", cycles_ / there.control.sampling_period);
      if (key.name == "excitation.frequency")
        set_case_value(there, "control.sampling_period", cycles_ / there.excitation.frequency);
      if (moves_the_coincidence(key.name) && keys_[0].name != "control.processing_delay" &&
          keys_[1].name != "control.processing_delay")
        there.control.processing_delay = delay_ * there.control.sampling_period;
    }
    return there;
  }

 private:
  double frequency() const { return case_value(case_, "excitation.frequency"); }
  double period() const { return case_.control.sampling_period; }
  double delay() const { return case_.control.processing_delay; }

  const std::vector<FollowedKey>& keys_;
  Case case_;
  double cycles_, delay_;
};

std::string meeting_of(const MotionBorder& one, const MotionBorder& other) {
  if (const auto order = strong_resonance(one, other))
    return "resonance_1_" + std::to_string(*order);
  if (one.kind == BorderKind::window || other.kind == BorderKind::window) return "none";
  const std::string a = name_in(border_names, one.kind), b = name_in(border_names, other.kind);
  return a < b ? a + "+" + b : b + "+" + a;
}

/// The points of a closed border, rotated to begin at a corner and without the repeated last point.
std::vector<MotionBorderPoint> from_a_corner(const MotionRegion& region) {
  std::vector<MotionBorderPoint> points = region.border;
  if (!region.closed || points.size() < 3) return points;
  points.pop_back();
  const auto corner =
      std::adjacent_find(points.begin(), points.end(),
                         [](const auto& a, const auto& b) { return !(a.border == b.border); });
  if (corner != points.end()) std::rotate(points.begin(), corner + 1, points.end());
  return points;
}

/// Whether point k is written: ends of a piece, and points not too close to the last one written.
bool is_shown(const std::vector<MotionBorderPoint>& points, std::size_t k,
              const ParameterWindow& window, const MotionBorderPoint& last) {
  const bool begins = k == 0 || !(points[k].border == points[k - 1].border);
  const bool ends = k + 1 == points.size() || !(points[k].border == points[k + 1].border);
  const PlanePoint a = window.shares_of({last.x, last.y});
  const PlanePoint b = window.shares_of({points[k].x, points[k].y});
  return begins || ends || std::hypot(a.x - b.x, a.y - b.y) > 1e-3;
}

void write_region(const JobContext& context, const std::vector<FollowedKey>& keys,
                  const ParameterWindow& window, const MotionRegion& region) {
  Table table(context, columns_of("motion borders", {{"x", keys[0].name}, {"y", keys[1].name}}));
  const std::vector<MotionBorderPoint> points = from_a_corner(region);
  int piece = 0;
  MotionBorderPoint last{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const MotionBorder& border = points[k].border;
    const MotionBorder& before = points[(k + points.size() - 1) % points.size()].border;
    const bool begins = k == 0 || !(border == before);
    if (begins) ++piece;
    if (!is_shown(points, k, window, last)) continue;
    last = points[k];
    const bool touches = border.kind == BorderKind::border_collision ||
                         border.kind == BorderKind::grazing || border.kind == BorderKind::sliding;
    const bool collides = border.kind == BorderKind::border_collision;
    const char* const surface = !touches ? ""
                                : collides || border.surface == SwitchingSurface::reversal
                                    ? name_in(surface_names, border.surface)
                                    : "gap_end";
    table.row(piece, name_in(border_names, border.kind), surface, border.sample, points[k].x,
              points[k].y, std::exp(border.multiplier.log_modulus), border.multiplier.angle,
              begins && !(border == before) ? meeting_of(before, border) : std::string("none"));
  }
  table.commit();
  if (!region.closed)
    report_warning("the border is incomplete: it could not be followed beyond the last row",
                   context.quiet);
}

/// Traces and writes the border of a periodic motion; `moving_at(case)` gives the motion of a case.
template <class MovingAt>
void write_borders_of(const JobContext& context, const std::vector<FollowedKey>& keys,
                      std::int64_t largest_period, const MovingAt& moving_at) {
  const CaseOfMap case_at(context.case_data, keys);
  const auto family = [&](double x, double y) {
    throw_if_interrupted();
    return moving_at(case_at(x, y)).loop;
  };
  const auto orbit = certified_orbit(context, moving_at(context.case_data), largest_period);
  const ParameterWindow window{keys[0].range.min, keys[0].range.max, keys[1].range.min,
                               keys[1].range.max};
  write_region(context, keys, window,
               motion_region(family, orbit, window, {keys[0].value, keys[1].value}));
}

}  // namespace

FollowedKey followed_key(const Case& the_case, const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw WrongInput(option + " " + text + ": expected KEY=MIN:MAX");
  const std::string key = text.substr(0, equals);
  const Range range = parse_range(option, text.substr(equals + 1));
  const bool of_map = option == "--map";
  if (of_map && !(range.min < range.max))
    throw WrongInput(option + " " + text + ": MIN must be smaller than MAX");
  const double value = case_value(the_case, key);
  if (moves_the_coincidence(key) && !of_map)
    throw WrongInput(option + " " + key +
                     ": another value changes the ratio of sampling and excitation period, so that "
                     "the orbit cannot be followed along this key: give another key");
  if (!moves_the_orbit(key) && !moves_the_coincidence(key))
    throw WrongInput(
        option + " " + key +
        ": expected control.proportional_gain, control.differential_gain, "
        "control.processing_delay, a key of [plant], backlash.width or excitation.amplitude; with "
        "--map also control.sampling_period or excitation.frequency");
  require_admissible(option + " " + text, key, range.min, range.max);
  if (!(range.min <= value && value <= range.max))
    throw WrongInput(option + " " + text + ": the case's " + key + " = " + format_number(value) +
                     " must lie between MIN and MAX");
  if (key == "backlash.width" && value == 0.0)
    throw WrongInput(option +
                     " backlash.width: an orbit without backlash cannot be followed to one with "
                     "backlash; set a backlash.width greater than 0 m");
  return {key, range, value};
}

void write_motion_borders(const JobContext& context, const std::vector<std::string>& axes,
                          std::int64_t largest_period, Switching switching) {
  const Case& the_case = context.case_data;
  const std::vector<FollowedKey> keys = map_keys(the_case, axes);
  if (is_sampled(motion_kind_of(the_case, switching)))
    return write_borders_of(context, keys, largest_period, sampled_masses_of);
  write_borders_of(context, keys, largest_period, [&](const Case& there) {
    return std::get<BuiltMasses>(built_loop_of(there, {switching}));
  });
}

}  // namespace holdfast::program
