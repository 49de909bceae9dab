#include "jobs/family/family_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/uncertain.hpp"
#include "holdfast/stability/chart/proved_family.hpp"
#include "holdfast/stability/chart/proved_string_family.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/family/family.hpp"
#include "output/row_blocks.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr std::string_view temperature_key = "weather.temperature";

/// The case keys of the parameters of a StringFamily, in the order of these parameters.
constexpr std::array<const char*, StringFamily::parameters> string_keys = {
    "conductor.tension",         "conductor.mass_per_length", "conductor.damping_ratio",
    "absorber.clamp_mass",       "plant.absorber_mass",       "plant.absorber_stiffness",
    "plant.absorber_damping",    "control.sampling_period",   "control.processing_delay",
    "control.proportional_gain", "control.differential_gain"};

std::array<const char*, TwoMassFamily::parameters> two_mass_keys() {
  std::array<const char*, TwoMassFamily::parameters> keys{};
  for (const auto& [parameter, name] : parameter_keys)
    keys[static_cast<std::size_t>(parameter)] = name;
  return keys;
}

double tension_at(const Case& the_case, double temperature) {
  return parabolic_tension_of(case_with(the_case, temperature_key, temperature));
}

/// The temperature at a given tension, by bisection; tension falls as the temperature rises.
double temperature_of(const Case& the_case, double tension, double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (tension_at(the_case, middle) > tension ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The box of uncertain parameters of a family. `keys` names the parameters in the box's order.
template <std::size_t N>
class FamilyBox {
 public:
  FamilyBox(const Case& the_case, const std::array<const char*, N>& keys,
            const std::array<double, N>& own)
      : the_case_(the_case), keys_(keys), ranges_(uncertain_ranges(the_case)), box_{own, own} {
    for (const UncertainRange& range : ranges_) {
      double low = range.lowest, high = range.highest;
      if (is_temperature(range)) {
        // The change of state is solved to 13 digits, and is falling.
        constexpr double rounding = 1e-11;
        low = (1.0 - rounding) * tension_at(the_case, range.highest);
        high = (1.0 + rounding) * tension_at(the_case, range.lowest);
      }
      const std::size_t number = number_of(range);
      box_.lowest[number] = low;
      box_.highest[number] = high;
    }
  }

  const ParameterBox<N>& box() const { return box_; }

  /// The member of the family whose loop has these parameters.
  FamilyMember member_of(const std::array<double, N>& loop) const {
    FamilyMember member;
    for (const UncertainRange& range : ranges_) {
      double value = loop[number_of(range)];
      if (is_temperature(range))
        value = temperature_of(the_case_, value, range.lowest, range.highest);
      member.values.emplace_back(range.key, value);
    }
    return member;
  }

 private:
  static bool is_temperature(const UncertainRange& range) { return range.key == temperature_key; }

  std::size_t number_of(const UncertainRange& range) const {
    std::string key = is_temperature(range) ? "conductor.tension" : range.key;
    if (key == "absorber.mass") key = "plant.absorber_mass";
    for (std::size_t k = 0; k < N; ++k)
      if (key == keys_[k]) return k;
    // Two masses have no tension.
    const bool is_string = std::string_view(keys_.front()) == string_keys.front();
    std::string known(is_string ? temperature_key : "");
    for (const char* name : keys_) known += (known.empty() ? "" : ", ") + std::string(name);
    throw WrongInput("uncertain." + range.key + ": --prove allows ranges only of " + known +
                     "; --family without --prove allows any");
  }

  const Case& the_case_;
  std::array<const char*, N> keys_;
  std::vector<UncertainRange> ranges_;
  ParameterBox<N> box_;
};

/// Slice i of a box, cut along its first parameter (tension or m₁), which natural frequencies
/// depend on. If this parameter is fixed, along the parameter of largest relative range.
template <std::size_t N>
ParameterBox<N> slice_of(const ParameterBox<N>& box, int i, int slices) {
  const auto width = [&](std::size_t k) {
    const double size = std::max(std::abs(box.lowest[k]), std::abs(box.highest[k]));
    return size > 0.0 ? (box.highest[k] - box.lowest[k]) / size : 0.0;
  };
  std::size_t widest = 0;
  for (std::size_t k = 1; k < N && !(width(0) > 0.0); ++k)
    if (width(k) > width(widest)) widest = k;
  const auto end = [&](int at) {
    const double share = static_cast<double>(at) / slices;
    return at == slices ? box.highest[widest]
                        : (1.0 - share) * box.lowest[widest] + share * box.highest[widest];
  };
  ParameterBox<N> slice = box;
  slice.lowest[widest] = end(i);
  slice.highest[widest] = end(i + 1);
  return slice;
}

/// Proves a family in eight slices in parallel; the result does not depend on the thread number.
template <class Family>
FamilyProof proof_of(const JobContext& context, std::size_t parts, const Family& family,
                     const FamilyBox<Family::parameters>& box) {
  constexpr std::size_t period = Family::place_of_period, delay = period + 1;
  if (box.box().highest[delay] > box.box().lowest[period])
    throw WrongInput(
        "--family --prove: the longest control.processing_delay of the family must not exceed its "
        "shortest control.sampling_period");
  constexpr int slices = 8;
  std::array<ProvedFamily<Family::parameters>, slices> proofs;
  side_by_side(context, "stability, slices", slices, [&](std::int64_t i) {
    const int number = static_cast<int>(i);
    const FamilyLimits limits{parts / slices};
    proofs[static_cast<std::size_t>(i)] = prove_family(family, slice_of(box.box(), number, slices),
                                                       limits, [] { throw_if_interrupted(); });
  });
  FamilyProof whole{ProvedStability::stable, 0.0, 0.0, 0, {}};
  for (const auto& proof : proofs) {
    whole.stable_share += proof.stable_share / slices;
    whole.undecided_share += proof.undecided_share / slices;
    whole.parts += proof.parts;
    if (proof.unstable_loop && whole.unstable.values.empty())
      whole.unstable = box.member_of(*proof.unstable_loop);
  }
  whole.verdict = !whole.unstable.values.empty() ? ProvedStability::unstable
                  : whole.undecided_share > 0.0  ? ProvedStability::undecided
                                                 : ProvedStability::stable;
  return whole;
}

FamilyProof proof_of_string(const JobContext& context, std::size_t parts) {
  const Case& the_case = context.case_data;
  if (!std::isfinite(the_case.plant.modes))
    throw WrongInput(
        "--family --prove with plant.model = \"string\" needs a finite number of modes: add, for "
        "example, --set "
        "plant.modes=40");
  const TautString<double> string = string_of(the_case);
  const auto& plant = the_case.plant;
  const PdGains<double> gains = gains_of(the_case);
  const Sampling<double> sampling = sampling_of(the_case);
  const StringFamily family(string.span, the_case.absorber.position, string.bending_stiffness,
                            static_cast<int>(plant.modes));
  const FamilyBox<StringFamily::parameters> box(
      the_case, string_keys,
      {string.tension, string.mass_per_length, damping_ratio_of(the_case),
       the_case.absorber.clamp_mass, plant.absorber_mass, plant.absorber_stiffness,
       plant.absorber_damping, sampling.period, sampling.processing_delay, gains.proportional,
       gains.differential});
  return proof_of(context, parts, family, box);
}

}  // namespace

FamilyProof family_proof_of(const JobContext& context, std::size_t parts) {
  const Case& the_case = context.case_data;
  const bool is_ideal = has_ideal_computer(the_case) && !has_hardware(the_case) &&
                        the_case.devices.empty() && !has_own_plant(the_case);
  const bool is_prompt = the_case.control.processing_delay <= the_case.control.sampling_period;
  if (is_ideal && is_prompt && is_two_masses(the_case)) {
    const OperatingPoint own{plant_of(the_case), sampling_of(the_case), gains_of(the_case)};
    return proof_of(
        context, parts, TwoMassFamily(),
        FamilyBox<TwoMassFamily::parameters>(the_case, two_mass_keys(), TwoMassFamily::of(own)));
  }
  if (is_ideal && is_prompt && !is_cable(the_case) && !is_infinite(the_case) &&
      the_case.conductor.damping != "rayleigh")
    return proof_of_string(context, parts);
  throw WrongInput(
      "--family --prove works only for plant.model = \"two_masses\", or \"string\" with "
      "conductor.damping = \"ratio\", in both cases without [[device]] and with an ideal computer "
      "and drive (docs/support.md); without --prove, members of any loop's family are compared");
}

std::optional<Interval<double>> proved_interval(JobContext context, const std::string& gain,
                                                double other, Interval<double> interval) {
  using case_tables::Uncertain;
  const std::string key = "control." + gain;
  const std::string held = key == "control.differential_gain" ? "control.proportional_gain"
                                                              : "control.differential_gain";
  std::vector<Uncertain>& uncertain = context.case_data.uncertain;
  uncertain.erase(
      std::remove_if(uncertain.begin(), uncertain.end(),
                     [&](const Uncertain& one) { return one.key == key || one.key == held; }),
      uncertain.end());
  context.case_data = case_with(context.case_data, held, other);
  context.case_data.uncertain.push_back({key, Uncertain::Form::interval, 0.0, 0.0});
  Uncertain& range = context.case_data.uncertain.back();
  constexpr std::size_t parts = 1000;
  for (const double share : {0.002, 0.005, 0.02, 0.1}) {
    while (std::isfinite(interval.upper - interval.lower) && interval.lower < interval.upper) {
      const double left_out = share * (interval.upper - interval.lower);
      range.below = interval.lower + left_out;
      range.above = interval.upper - left_out;
      const FamilyProof proof = family_proof_of(context, parts);
      if (proof.verdict == ProvedStability::stable)
        return Interval<double>{range.below, range.above};
      if (proof.verdict == ProvedStability::undecided) break;
      // A member between those that were drawn is the new end.
      const double at = proof.unstable.value_of(key);
      (at < 0.5 * (interval.lower + interval.upper) ? interval.lower : interval.upper) = at;
    }
  }
  return std::nullopt;
}

}  // namespace holdfast::program
