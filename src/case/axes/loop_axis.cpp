#include "case/axes/loop_axis.hpp"

#include <algorithm>
#include <array>

#include "case/axes/axis.hpp"
#include "case/axes/key_axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/sampled_loop_of_case.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct ParameterKey {
  const char* key;
  LoopParameter parameter;
};

constexpr std::array<ParameterKey, 10> parameter_keys = {{
    {"control.proportional_gain", LoopParameter::proportional_gain},
    {"control.differential_gain", LoopParameter::differential_gain},
    {"control.sampling_period", LoopParameter::sampling_period},
    {"control.processing_delay", LoopParameter::processing_delay},
    {"plant.conductor_mass", LoopParameter::conductor_mass},
    {"plant.conductor_stiffness", LoopParameter::conductor_stiffness},
    {"plant.conductor_damping", LoopParameter::conductor_damping},
    {"plant.absorber_mass", LoopParameter::absorber_mass},
    {"plant.absorber_stiffness", LoopParameter::absorber_stiffness},
    {"plant.absorber_damping", LoopParameter::absorber_damping},
}};

LoopParameter parameter_of(const std::string& key) {
  const auto found = std::find_if(parameter_keys.begin(), parameter_keys.end(),
                                  [&key](const ParameterKey& known) { return key == known.key; });
  if (found != parameter_keys.end()) return found->parameter;
  std::string known;
  for (const ParameterKey& other : parameter_keys) {
    known += std::string(known.empty() ? "" : ", ") + other.key;
  }
  throw WrongInput("--axis: stability does not depend on " + key + "; it does on " + known);
}

/// An axis whose two ends the key admits.
KeyAxis admissible_axis(const std::string& text) {
  KeyAxis axis = parse_key_axis("--axis", text);
  parameter_of(axis.key);
  const CaseKey& key = *find_case_key(axis.key);
  for (const double end : {axis.axis.min, axis.axis.max}) {
    if (!key.range.contains(end)) {
      throw WrongInput("--axis " + text + ": " + axis.key + " must be " + key.admissible());
    }
  }
  return axis;
}

}  // namespace

CaseChart loop_chart_of(const Case& the_case, const std::vector<std::string>& axes) {
  if (axes.size() != 2) {
    throw WrongInput("--axis: a chart needs two axes, not " + std::to_string(axes.size()));
  }
  const KeyAxis slow = admissible_axis(axes[0]), fast = admissible_axis(axes[1]);
  if (slow.key == fast.key) throw WrongInput("--axis: both axes are " + slow.key);
  const LoopChart chart{operating_point_of(the_case),
                        {parameter_of(slow.key), slow.axis},
                        {parameter_of(fast.key), fast.axis}};
  validate(chart);
  return {chart, grid_axis(slow), grid_axis(fast)};
}

}  // namespace holdfast::program
