#include "jobs/span/fatigue_life.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "case/model/span/span_of_case.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The year of one pair of laws.
struct LawYear {
  std::vector<StressCycles> at_most, at_least;
  double largest = 0.0, frequency = 0.0;

  void add(const Vibration& vibration, double modulus, double cycles, double at) {
    const double stress = modulus * vibration.strain;
    const bool is_bound = vibration.amplitude.range == BalanceRange::below;
    at_most.push_back({stress, cycles});
    at_least.push_back({is_bound ? 0.0 : stress, cycles});
    if (!(stress > largest)) return;
    largest = stress;
    frequency = at;
  }
};

/// The years of every pair of laws, without the devices or with them.
struct Years {
  std::vector<LawYear> of_laws;

  Band damage(const SafeBorderLine& line) const {
    std::vector<double> most, least;
    for (const LawYear& year : of_laws) {
      most.push_back(miner_damage(year.at_most, line));
      least.push_back(miner_damage(year.at_least, line));
    }
    const Band upper = band_of(most);
    return {upper.value, band_of(least).lowest, upper.highest};
  }

  Band stress() const {
    std::vector<double> largest;
    for (const LawYear& year : of_laws) largest.push_back(year.largest);
    return band_of(largest);
  }

  double worst_frequency() const {
    return std::max_element(
               of_laws.begin(), of_laws.end(),
               [](const LawYear& a, const LawYear& b) { return a.largest < b.largest; })
        ->frequency;
  }

  /// The part that each wind speed has in damage(), by the laws that make up its three numbers.
  std::vector<Band> parts(const SafeBorderLine& line) const {
    const auto order =
        laws_in_order([&](const LawYear& year) { return miner_damage(year.at_most, line); });
    const std::size_t half = order.size() / 2, other = order.size() % 2 == 1 ? half : half - 1;
    const LawYear& most = of_laws[order.back()];
    const LawYear& least = of_laws[laws_in_order([&](const LawYear& year) {
                                     return miner_damage(year.at_least, line);
                                   }).front()];
    std::vector<Band> parts;
    for (std::size_t k = 0; k < most.at_most.size(); ++k) {
      const auto part = [&](const std::vector<StressCycles>& year) {
        return miner_damage({year[k]}, line);
      };
      const double middle =
          0.5 * (part(of_laws[order[half]].at_most) + part(of_laws[order[other]].at_most));
      parts.push_back({middle, part(least.at_least), part(most.at_most)});
    }
    return parts;
  }

 private:
  /// The numbers of the laws, ascending by what a law's year has.
  template <class Measure>
  std::vector<std::size_t> laws_in_order(const Measure& measure) const {
    std::vector<double> measures;
    for (const LawYear& year : of_laws) measures.push_back(measure(year));
    std::vector<std::size_t> order(of_laws.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return measures[a] < measures[b]; });
    return order;
  }
};

void require_wires(const AeolianBalance& balance) {
  if (!balance.knows_strain())
    throw WrongInput(
        "fatigue needs the outer wires of the conductor: give conductor.outer_wire_diameter, "
        "conductor.outer_wire_modulus and conductor.bending_stiffness (its least value), or "
        "conductor.name from the library");
  const double modulus = balance.outer_wire_modulus();
  constexpr double stiffest_alloy = 1e11;
  if (modulus > stiffest_alloy)
    throw WrongInput(
        "the safe border line is known only for wires of aluminium and its alloys, but "
        "conductor.outer_wire_modulus = " +
        format_number(modulus) + " Pa is of steel: the life of such strands cannot be computed");
}

/// Gives the parts that each wind speed has in the damages.
void share_out(const std::vector<Band>& bare, const std::vector<Band>& damped, FatigueLife& life) {
  for (std::size_t k = 0; k < damped.size(); ++k) {
    life.by_speed[k].damage_bare = bare[k].value;
    life.by_speed[k].damage = damped[k];
  }
}

}  // namespace

Band band_of(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const std::size_t half = numbers.size() / 2;
  const double middle =
      numbers.size() % 2 == 1 ? numbers[half] : 0.5 * (numbers[half - 1] + numbers[half]);
  return {middle, numbers.front(), numbers.back()};
}

Band years_of(const Band& damage) {
  return {1.0 / damage.value, 1.0 / damage.highest, 1.0 / damage.lowest};
}

FatigueLife fatigue_life_of(const Case& the_case, bool controlled, double lowest, double highest) {
  const AeolianBalance balance(the_case, controlled);
  require_wires(balance);
  const double modulus = balance.outer_wire_modulus();
  const auto hours = wind_hours_of(the_case, balance.speed_of(lowest), balance.speed_of(highest));
  Years bare, damped;
  FatigueLife life{};
  constexpr double seconds = 3600.0;
  for (const WindHours& row : hours) {
    const double frequency = balance.frequency_of(row.speed);
    if (!(frequency >= lowest && frequency <= highest) || !(row.hours > 0.0)) continue;
    const double cycles = seconds * row.hours * frequency;
    const auto laws = balance.rows(frequency);
    bare.of_laws.resize(laws.size());
    damped.of_laws.resize(laws.size());
    life.cycles += cycles;
    life.by_speed.push_back({row.speed, row.hours, 0.0, {}});
    for (std::size_t k = 0; k < laws.size(); ++k) {
      bare.of_laws[k].add(laws[k].bare, modulus, cycles, frequency);
      damped.of_laws[k].add(laws[k].damped, modulus, cycles, frequency);
    }
  }
  if (damped.of_laws.empty())
    throw WrongInput(
        "no wind of [site] sheds vortices within --frequency: give other speeds, or a wider "
        "--frequency");
  const SafeBorderLine line = life_line_of(the_case);
  life.damage_bare = bare.damage(line);
  life.stress_bare = bare.stress();
  const bool is_known = !balance.is_growing();
  const Band none{std::nan(""), std::nan(""), std::nan("")};
  life.damage = is_known ? damped.damage(line) : none;
  life.stress = is_known ? damped.stress() : none;
  life.worst_frequency = is_known ? damped.worst_frequency() : none.value;
  share_out(bare.parts(line),
            is_known ? damped.parts(line) : std::vector<Band>(life.by_speed.size(), none), life);
  return life;
}

}  // namespace holdfast::program
