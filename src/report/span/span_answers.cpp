#include "report/page/answers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_loop.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/fatigue_life.hpp"
#include "jobs/span/mode_dampings.hpp"
#include "jobs/span/span_words.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "report/figures/figure.hpp"
#include "report/page/html.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Endurance limit of the strain amplitude, zero to peak: 150 microstrain peak to peak.
constexpr double endurance_limit = 75e-6;

/// Lowest and highest vibration over all pairs of laws at one frequency, without or with devices.
struct BandAt {
  double frequency, speed;
  Vibration lowest, highest;  // of amplitude and of strain, each by itself
};

std::vector<BandAt> bands_of(const AeolianBalance& balance, const Axis& axis,
                             Vibration AeolianRow::*which) {
  std::vector<BandAt> bands;
  for (std::int64_t k = 0; k < axis.count; ++k) {
    const auto rows = balance.rows(axis.at(k));
    BandAt band{axis.at(k), rows.front().wind_speed, rows.front().*which, rows.front().*which};
    for (const AeolianRow& row : rows) {
      const Vibration& one = row.*which;
      if (one.amplitude.amplitude < band.lowest.amplitude.amplitude)
        band.lowest.amplitude = one.amplitude;
      if (one.amplitude.amplitude > band.highest.amplitude.amplitude)
        band.highest.amplitude = one.amplitude;
      band.lowest.strain = std::min(band.lowest.strain, one.strain);
      band.highest.strain = std::max(band.highest.strain, one.strain);
    }
    bands.push_back(band);
  }
  return bands;
}

/// Text of a relative amplitude: "0.054 d", "less than 0.01 d" or "0.85 d or more".
std::string amplitude_text(const BalancedAmplitude& amplitude, double diameter) {
  const std::string size = rounded(amplitude.amplitude / diameter, 2);
  if (amplitude.range == BalanceRange::below) return page_text("less than", {{"size", size}});
  if (amplitude.range == BalanceRange::above) return page_text("or more", {{"size", size}});
  return page_text("as much as", {{"size", size}});
}

/// Range of frequencies with strains above the limit: "within 6 to 9 Hz", "at 6 Hz"; empty if none.
std::string beyond_limit(const std::vector<BandAt>& bands, Vibration BandAt::*which) {
  std::vector<double> beyond;
  for (const BandAt& band : bands)
    if ((band.*which).strain > endurance_limit) beyond.push_back(band.frequency);
  if (beyond.empty()) return "";
  return (beyond.size() > 1 ? "within " : "at ") +
         range_text(rounded(beyond.front(), 3), rounded(beyond.back(), 3)) + " Hz";
}

std::string strain_text(const std::vector<BandAt>& bands) {
  const std::string some = beyond_limit(bands, &BandAt::highest);
  const std::string every = beyond_limit(bands, &BandAt::lowest);
  if (some.empty()) return page_text("strain allowed");
  if (every.empty()) return page_text("strain by some law", {{"some", some}});
  return page_text("strain by every law", {{"some", some}, {"every", every}});
}

/// Text on the largest vibration of a span over the frequencies of the bands.
std::string vibration_text(const AeolianBalance& balance, const std::vector<BandAt>& bands) {
  const BandAt& worst =
      *std::max_element(bands.begin(), bands.end(), [](const BandAt& one, const BandAt& other) {
        return one.highest.amplitude.amplitude < other.highest.amplitude.amplitude;
      });
  const bool is_still = worst.highest.amplitude.range == BalanceRange::below;
  const std::string text =
      page_text(is_still ? "hardly vibrates" : "vibrates most",
                {{"amplitude",
                  range_text(amplitude_text(worst.lowest.amplitude, balance.diameter()),
                             amplitude_text(worst.highest.amplitude, balance.diameter()), "from ")},
                 {"frequency", rounded(worst.frequency, 3)},
                 {"speed", rounded(worst.speed, 2)}});
  return text + (balance.knows_strain() ? strain_text(bands) : page_text("strain unknown"));
}

/// The answer completed by `tell`, or with the reason why the question cannot be answered.
template <class Tell>
Answer answered(Answer answer, const Tell& tell) {
  throw_if_interrupted();
  try {
    tell(answer);
  } catch (const Refusal& reason) {
    answer.answer = page_text("not told", {{"reason", reason.what()}});
  }
  return answer;
}

/// Note that the self-damping laws were measured on other conductors; else empty.
std::string laws_text(const Case& the_case) {
  const std::string note = self_damping_note(the_case);
  return note.empty() ? "" : page_text("note of laws", {{"note", note}});
}

/// Throws NoAnswer if the absorber's loop is unstable on the span, so that no vibration is steady.
void require_steady(const Case& the_case) {
  if (is_growing_span(the_case, true)) throw NoAnswer(instability_note(the_case, true));
}

Answer what_vibrates(const Case& the_case, const Axis& axis, bool damped) {
  const Values values = {{"frequencies", frequencies_text(axis)}};
  return answered(asked(damped ? "damped" : "bare", values), [&](Answer& answer) {
    const AeolianBalance balance(the_case, true);
    if (damped && !balance.has_devices()) {
      answer.answer = page_text("no device");
      return;
    }
    if (damped) require_steady(the_case);
    const auto which = damped ? &AeolianRow::damped : &AeolianRow::bare;
    answer.answer = vibration_text(balance, bands_of(balance, axis, which));
    if (!damped) answer.answer += laws_text(the_case);
  });
}

/// Text on the range of a result over the laws: "by the laws from 3 to 5", "by every law".
std::string by_laws(const std::string& lowest, const std::string& highest) {
  return lowest == highest ? "by every law" : "by the laws " + range_text(lowest, highest, "from ");
}

Answer how_long_it_lives(const Case& the_case, const Axis& axis, const Values& values) {
  return answered(asked("life", values), [&](Answer& answer) {
    require_steady(the_case);
    const FatigueLife life = fatigue_life_of(the_case, true, axis.min, axis.max);
    const Band damped = years_of(life.damage), bare = years_of(life.damage_bare);
    const auto lives = [&](const std::string& name, const Band& years) {
      return page_text(name,
                       {{"value", years_text(years.value)},
                        {"laws", by_laws(years_text(years.lowest), years_text(years.highest))}});
    };
    answer.answer = lives("life", damped);
    if (!span_devices_of(the_case).empty()) answer.answer += lives("life bare", bare);
    answer.answer += page_text("advice", {{"advice", life_advice(life, the_case.site.years)}}) +
                     laws_text(the_case);
  });
}

std::string megapascal(double stress) { return rounded(1e-6 * stress, 3); }

Answer which_frequency(const Case& the_case, const Axis& axis, const Values& values) {
  return answered(asked("worst", values), [&](Answer& answer) {
    require_steady(the_case);
    const AeolianBalance balance(the_case, true);
    const FatigueLife life = fatigue_life_of(the_case, true, axis.min, axis.max);
    const auto& most = *std::max_element(life.by_speed.begin(), life.by_speed.end(),
                                         [](const SpeedDamage& one, const SpeedDamage& other) {
                                           return one.damage.value < other.damage.value;
                                         });
    answer.answer = page_text(
        "worst frequency",
        {{"frequency", rounded(balance.frequency_of(most.speed), 3)},
         {"speed", rounded(most.speed, 2)},
         {"part", rounded(100.0 * most.damage.value / life.damage.value, 2)},
         {"stressed", rounded(life.worst_frequency, 3)},
         {"value", megapascal(life.stress.value)},
         {"laws", by_laws(megapascal(life.stress.lowest), megapascal(life.stress.highest))}});
    if (&most == &life.by_speed.front()) answer.answer += page_text("worst at the edge");
  });
}

/// Text on the smallest and the largest fraction of wave power that the devices of one end absorb.
std::string taken_text(const Case& the_case, const SpanEnd& end, const std::string& name,
                       const Axis& axis) {
  if (end.devices.empty()) return page_text("end without device", {{"end", name}});
  std::vector<std::pair<double, double>> shares;  // taken at a frequency (Hz)
  for (std::int64_t k = 0; k < axis.count; ++k)
    shares.emplace_back(
        end_response(string_of(the_case), end, 2.0 * pi<double> * axis.at(k)).absorbed_fraction(),
        axis.at(k));
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  const bool one = rounded(100.0 * least->first, 2) == rounded(100.0 * most->first, 2);
  return page_text(one ? "taken at all" : "taken by an end",
                   {{"end", name},
                    {"least", rounded(100.0 * least->first, 2)},
                    {"least frequency", rounded(least->second, 3)},
                    {"most", rounded(100.0 * most->first, 3)},
                    {"most frequency", rounded(most->second, 3)}});
}

Answer what_devices_take(const Case& the_case, const Axis& axis) {
  const auto devices = span_devices_of(the_case);
  const auto ends = span_ends(devices, string_of(the_case).span);
  const Values values = {{"frequencies", frequencies_text(axis)},
                         {"end", ends[0].devices.empty() ? "right" : "left"}};
  return answered(asked("taken", values), [&](Answer& answer) {
    if (ends[0].devices.empty() && ends[1].devices.empty())
      answer.answer = page_text("no device");
    else
      answer.answer = taken_text(the_case, ends[0], "left", axis) + " " +
                      taken_text(the_case, ends[1], "right", axis);
  });
}

Answer how_modes_are_damped(const Case& the_case) {
  constexpr int count = 20;
  const Values values = {{"count", std::to_string(count)}};
  return answered(asked("modes", values), [&](Answer& answer) {
    Case on_string = the_case;
    on_string.plant.model = "string";
    const auto modes = mode_rows_of(on_string, count, true);
    const auto ascending = [](const ModeRow& one, const ModeRow& other) {
      return one.damping() < other.damping();
    };
    const auto [least, most] = std::minmax_element(modes.begin(), modes.end(), ascending);
    const auto number = [&](auto mode) { return std::to_string(mode - modes.begin() + 1); };
    const std::string lowest = rounded(100.0 * least->damping(), 2);
    const std::string highest = rounded(100.0 * most->damping(), 2);
    answer.answer = page_text(lowest == highest ? "modes damped alike" : "modes damped",
                              {{"count", std::to_string(modes.size())},
                               {"least", lowest},
                               {"least mode", number(least)},
                               {"least frequency", rounded(least->frequency, 3)},
                               {"most", highest},
                               {"most mode", number(most)},
                               {"most frequency", rounded(most->frequency, 3)},
                               {"bare", rounded(100.0 * least->bare, 2)}});
  });
}

Answer is_loop_stable(const Case& the_case) {
  return answered(asked("loop"), [&](Answer& answer) {
    const bool active = has_active_absorber(the_case);
    const std::string note = active ? instability_note(the_case, true) : "";
    answer.answer = !note.empty() ? page_text("loop", {{"note", note}})
                                  : page_text(active ? "stable loop" : "no loop");
  });
}

}  // namespace

void span_answers(const JobContext& context, const std::function<void(const Answer&)>& take) {
  const Case& the_case = context.case_data;
  const Axis axis = aeolian_frequencies(the_case);
  const std::string frequencies = frequencies_text(axis);
  const Values range = {{"range", frequencies.substr(0, frequencies.rfind(':'))}};
  take(what_vibrates(the_case, axis, false));
  take(what_vibrates(the_case, axis, true));
  take(how_long_it_lives(the_case, axis, range));
  take(which_frequency(the_case, axis, range));
  take(what_devices_take(the_case, axis));
  take(how_modes_are_damped(the_case));
  take(is_loop_stable(the_case));
}

}  // namespace holdfast::program
