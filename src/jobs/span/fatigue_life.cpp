#include "jobs/span/fatigue_life.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Stresses and cycles of one year by one pair of laws (wind power and self-damping).
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

/// The LawYear of every pair of laws, either without or with the devices.
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

  /// The contribution of each group of entries to damage(). A group is one wind speed or one
  /// temperature. Median, lowest and highest are of the same pairs of laws as in damage().
  /// @param group_of  index of the group of each entry
  std::vector<Band> parts(const SafeBorderLine& line, const std::vector<std::size_t>& group_of,
                          std::size_t groups) const {
    const auto order =
        laws_in_order([&](const LawYear& year) { return miner_damage(year.at_most, line); });
    const std::size_t half = order.size() / 2, other = order.size() % 2 == 1 ? half : half - 1;
    const LawYear& most = of_laws[order.back()];
    const LawYear& least = of_laws[laws_in_order([&](const LawYear& year) {
                                     return miner_damage(year.at_least, line);
                                   }).front()];
    std::vector<Band> parts(groups, {0.0, 0.0, 0.0});
    for (std::size_t k = 0; k < most.at_most.size(); ++k) {
      const auto part = [&](const std::vector<StressCycles>& year) {
        return miner_damage({year[k]}, line);
      };
      Band& here = parts[group_of[k]];
      here.value +=
          0.5 * (part(of_laws[order[half]].at_most) + part(of_laws[order[other]].at_most));
      here.lowest += part(least.at_least);
      here.highest += part(most.at_most);
    }
    return parts;
  }

 private:
  /// Indices of the pairs of laws in ascending order of a measure of their years.
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
        "the CIGRE safe border line is known only for wires of aluminium and its alloys, but "
        "conductor.outer_wire_modulus = " +
        format_number(modulus) +
        " Pa is that of steel: the fatigue life of steel wires cannot be computed");
}

/// A temperature of the conductor, with the case at this temperature and the yearly hours.
struct Season {
  Case at;       // the case at it
  double hours;  // a year
  double share;  // of all hours
};

std::vector<Season> seasons_of(const Case& the_case) {
  const case_tables::Weather& weather = the_case.weather;
  const double all = std::accumulate(weather.hours.begin(), weather.hours.end(), 0.0);
  if (!(all > 0.0)) return {{the_case, 0.0, 1.0}};
  std::vector<Season> seasons;
  for (std::size_t k = 0; k < weather.hours.size(); ++k)
    seasons.push_back({case_with(the_case, "weather.temperature", weather.temperatures[k]),
                       weather.hours[k], weather.hours[k] / all});
  return seasons;
}

/// The stresses of a span in one year, with an entry for each wind speed at each temperature.
struct SpanYear {
  Years bare, damped;
  std::vector<std::size_t> speed_of, season_of;  // of each entry
  bool grows = false;

  void add(const std::vector<AeolianRow>& laws, double modulus, double cycles, double frequency) {
    bare.of_laws.resize(laws.size());
    damped.of_laws.resize(laws.size());
    for (std::size_t k = 0; k < laws.size(); ++k) {
      bare.of_laws[k].add(laws[k].bare, modulus, cycles, frequency);
      damped.of_laws[k].add(laws[k].damped, modulus, cycles, frequency);
    }
  }

  /// Sets the damage of each row, one per wind speed or per temperature, from its entries.
  template <class Row>
  void share_out(const SafeBorderLine& line, const std::vector<std::size_t>& group_of,
                 std::vector<Row>& rows) const {
    if (rows.empty()) return;
    const auto without = bare.parts(line, group_of, rows.size());
    const auto with = damped.parts(line, group_of, rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].damage_bare = without[k].value;
      rows[k].damage = grows ? unknown : with[k];
    }
  }

  static inline const Band unknown{std::nan(""), std::nan(""), std::nan("")};
};

/// Adds the entries of all wind speeds at one temperature to the year.
void add_season(const Season& season, std::size_t number, const std::vector<WindHours>& hours,
                const AeolianBalance& balance, const std::array<double, 2>& counted, SpanYear& year,
                FatigueLife& life) {
  constexpr double seconds = 3600.0;
  std::size_t speed = 0;
  for (const WindHours& row : hours) {
    const double frequency = balance.frequency_of(row.speed);
    if (!(frequency >= counted[0] && frequency <= counted[1]) || !(row.hours > 0.0)) continue;
    const double cycles = seconds * season.share * row.hours * frequency;
    year.add(balance.rows(frequency), balance.outer_wire_modulus(), cycles, frequency);
    year.speed_of.push_back(speed++);
    year.season_of.push_back(number);
    life.cycles += cycles;
    if (number == 0) life.by_speed.push_back({row.speed, row.hours, 0.0, {}});
  }
  year.grows = year.grows || balance.is_growing();
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
  SpanYear year;
  FatigueLife life{};
  const std::vector<Season> seasons = seasons_of(the_case);
  for (std::size_t k = 0; k < seasons.size(); ++k) {
    const AeolianBalance balance(seasons[k].at, controlled);
    require_wires(balance);
    const auto hours = wind_hours_of(the_case, balance.speed_of(lowest), balance.speed_of(highest));
    add_season(seasons[k], k, hours, balance, {lowest, highest}, year, life);
    if (the_case.weather.hours.empty()) continue;
    const Case& at = seasons[k].at;
    life.by_temperature.push_back(
        {at.weather.temperature, seasons[k].hours, parabolic_tension_of(at), 0.0, {}});
  }
  if (year.damped.of_laws.empty())
    throw WrongInput(
        "no wind of [site] sheds vortices within --frequency: give other site.speeds, or a wider "
        "--frequency");
  const SafeBorderLine line = life_line_of(the_case);
  life.damage_bare = year.bare.damage(line);
  life.stress_bare = year.bare.stress();
  life.damage = year.grows ? SpanYear::unknown : year.damped.damage(line);
  life.stress = year.grows ? SpanYear::unknown : year.damped.stress();
  life.worst_frequency = year.grows ? std::nan("") : year.damped.worst_frequency();
  year.share_out(line, year.speed_of, life.by_speed);
  year.share_out(line, year.season_of, life.by_temperature);
  return life;
}

}  // namespace holdfast::program
