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

/// The keys of the parameters of a string's loop, in their order.
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

/// The temperature of a tension between two, which falls as it rises.
double temperature_of(const Case& the_case, double tension, double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (tension_at(the_case, middle) > tension ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The box of a family's parameters, whose keys are in their order.
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

  /// "control.sampling_period=0.001;…" of the uncertain keys.
  std::string text_of(const std::array<double, N>& loop) const {
    FamilyMember member;
    for (const UncertainRange& range : ranges_) {
      double value = loop[number_of(range)];
      if (is_temperature(range))
        value = temperature_of(the_case_, value, range.lowest, range.highest);
      member.values.emplace_back(range.key, value);
    }
    return member.text();
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
    throw WrongInput("uncertain." + range.key + ": --prove takes ranges of " + known +
                     "; --family alone takes any");
  }

  const Case& the_case_;
  std::array<const char*, N> keys_;
  std::vector<UncertainRange> ranges_;
  ParameterBox<N> box_;
};

/// Slice i of a box along its first parameter, the tension or m₁, on which natural frequencies
/// depend; where that is one number, along the one whose range is widest for its size.
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

/// The slices of a box, side by side: the same on any number of threads.
template <class Family>
FamilyProof proof_of(const JobContext& context, const Family& family,
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
    const FamilyLimits limits{FamilyLimits{}.parts / slices};
    proofs[static_cast<std::size_t>(i)] = prove_family(family, slice_of(box.box(), number, slices),
                                                       limits, [] { throw_if_interrupted(); });
  });
  FamilyProof whole{ProvedStability::stable, 0.0, 0.0, 0, ""};
  for (const auto& proof : proofs) {
    whole.stable_share += proof.stable_share / slices;
    whole.undecided_share += proof.undecided_share / slices;
    whole.parts += proof.parts;
    if (proof.unstable_loop && whole.worst_member.empty())
      whole.worst_member = box.text_of(*proof.unstable_loop);
  }
  whole.verdict = !whole.worst_member.empty()   ? ProvedStability::unstable
                  : whole.undecided_share > 0.0 ? ProvedStability::undecided
                                                : ProvedStability::stable;
  return whole;
}

FamilyProof proof_of_string(const JobContext& context) {
  const Case& the_case = context.case_data;
  if (!std::isfinite(the_case.plant.modes))
    throw WrongInput(
        "--family --prove on a string is of the modes that plant.modes tells: give --set "
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
  return proof_of(context, family, box);
}

}  // namespace

FamilyProof family_proof_of(const JobContext& context) {
  const Case& the_case = context.case_data;
  const bool is_ideal = has_ideal_computer(the_case) && !has_hardware(the_case) &&
                        the_case.devices.empty() && !has_own_plant(the_case);
  const bool is_prompt = the_case.control.processing_delay <= the_case.control.sampling_period;
  if (is_ideal && is_prompt && is_two_masses(the_case)) {
    const OperatingPoint own{plant_of(the_case), sampling_of(the_case), gains_of(the_case)};
    return proof_of(
        context, TwoMassFamily(),
        FamilyBox<TwoMassFamily::parameters>(the_case, two_mass_keys(), TwoMassFamily::of(own)));
  }
  if (is_ideal && is_prompt && !is_cable(the_case) && !is_infinite(the_case) &&
      the_case.conductor.damping != "rayleigh")
    return proof_of_string(context);
  throw WrongInput(
      "--family --prove is of two masses, or of plant.model = \"string\" with one damping ratio, "
      "under an ideal computer without filter, lag and devices, the delay at most a sample; "
      "--family "
      "alone compares members of any loop");
}

}  // namespace holdfast::program
