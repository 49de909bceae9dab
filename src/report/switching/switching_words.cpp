#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "report/page/html.hpp"
#include "report/switching/switching_page.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Motions = std::vector<StudiedMotion>;

constexpr const char* no_number = "–";

std::string in_millimetres(double length) { return rounded(1e3 * length, 4) + " mm"; }

bool is_followed(const StudiedMotion& motion) {
  return !motion.steady.diverges && !motion.steady.accumulates;
}

std::string periods_text(const FoundPeriod& period) {
  const std::string seconds = rounded(period.seconds, 6) + " s";
  if (period.forcing_periods == 0) return seconds;
  return std::to_string(period.forcing_periods) + " forcing period" +
         (period.forcing_periods == 1 ? "" : "s") + " (" + seconds + ")";
}

std::string amplitude_text(const StudiedMotion& motion) {
  if (motion.steady.accumulates)
    return "not followed: too many changes of contact within one sampling period";
  return motion.steady.diverges ? "diverges" : in_millimetres(motion.steady.largest_displacement);
}

/// By how much the first amplitude is above the second one: "+4.4 %".
std::string change_text(const StudiedMotion& motion, const StudiedMotion& reference) {
  if (!is_followed(motion) || !is_followed(reference)) return no_number;
  const double change =
      motion.steady.largest_displacement / reference.steady.largest_displacement - 1.0;
  if (!std::isfinite(change)) return no_number;
  return (change > 0.0 ? "+" : "") + rounded(100.0 * change, 2) + " %";
}

std::string period_sentence(const FoundPeriod& sampled, const FoundPeriod& exact) {
  const char* name = "other period";
  if (sampled.samples == exact.samples)
    name = sampled.samples == 0 ? "no period" : "same period";
  else if (sampled.samples == 0)
    name = "no sampled period";
  else if (exact.samples == 0)
    name = "no exact period";
  return page_text(name, {{"sampled", periods_text(sampled)},
                          {"exact", periods_text(exact)},
                          {"longest", std::to_string(longest_studied_period)}});
}

std::string amplitude_sentence(const StudiedMotion& sampled, const StudiedMotion& exact) {
  const double change =
      sampled.steady.largest_displacement / exact.steady.largest_displacement - 1.0;
  const char* name = "other amplitude";
  if (!is_followed(sampled) || !is_followed(exact))
    name = "not followed";
  else if (std::abs(change) < 5e-5)
    name = "same amplitude";
  return page_text(name, {{"sampled", amplitude_text(sampled)},
                          {"exact", amplitude_text(exact)},
                          {"change", change_text(sampled, exact)}});
}

std::string held_sentence(const StudiedMotion& held, const StudiedMotion& exact) {
  if (!is_followed(held) || !is_followed(exact)) return "";
  const bool periodic = held.period.samples > 0;
  return page_text("held", {{"amplitude", amplitude_text(held)},
                            {"change", change_text(held, exact)},
                            {"period", periodic ? "the period " + periods_text(held.period)
                                                : "and no certified periodic orbit is found"}});
}

std::string phases_text(const SteadyMotion& steady) {
  std::string text;
  for (const ContactMode mode : {ContactMode::engaged, ContactMode::stick, ContactMode::gap}) {
    const double phases = steady.phases_per_half_cycle[static_cast<std::size_t>(mode)];
    text += (text.empty() ? "" : ", ") + rounded(phases, 2) + " " + word_for(mode);
  }
  return text;
}

/// Why there is no period, without advice.
std::string no_period_text(const FoundPeriod& period) {
  return period.verdict.substr(0, period.verdict.find(';'));
}

std::string period_or_reason(const FoundPeriod& period) {
  return period.samples > 0 ? periods_text(period) : no_period_text(period);
}

std::string multiplier_text(const FoundPeriod& period) {
  return period.samples > 0 ? rounded(period.largest_multiplier, 3) : no_number;
}

std::string table_of_case(const Motions& of_case) {
  std::string rows;
  for (const StudiedMotion& motion : of_case) {
    const auto& [studied, steady, period] = motion;
    rows += html_row(
        {studied.reading.switching == Switching::exact ? "exact" : "at samples",
         studied.reading.hold == ForceHold::exact ? "exact" : "held",
         escaped(amplitude_text(motion)), escaped(change_text(motion, of_case[exact_switching])),
         escaped(no_period_text(period)), period.samples > 0 ? periods_text(period) : no_number,
         multiplier_text(period), is_followed(motion) ? phases_text(steady) : no_number});
  }
  return html_table({"switching", "force", "largest |z₁|", "against exact switching", "verdict",
                     "period", "largest multiplier", "phases per half cycle"},
                    rows);
}

/// A motion of the paper: amplitude at the samples, how far it goes between them, period.
std::string paper_cell(const StudiedMotion& motion) {
  if (!is_followed(motion)) return escaped(amplitude_text(motion));
  const SteadyMotion& steady = motion.steady;
  std::string html = "<strong>" + in_millimetres(steady.largest_of_samples) + "</strong>";
  if (steady.largest_displacement > 1.005 * steady.largest_of_samples)
    html += ", between them up to " + in_millimetres(steady.largest_displacement);
  html += "<br>period: " + escaped(period_or_reason(motion.period));
  if (motion.period.samples > 0) html += ", multiplier " + multiplier_text(motion.period);
  return html + "<br>" + phases_text(steady);
}

std::string table_of_paper(const Motions& of_paper) {
  std::string rows;
  for (auto first = of_paper.begin(); first != of_paper.end(); first += readings.size())
    rows += html_row({escaped(loop_text(first->loop.the_case)), paper_cell(first[0]),
                      paper_cell(first[1]), paper_cell(first[2])});
  return html_table({"loop", "switching at samples, force held (the paper)",
                     "switching at samples, exact force", "exact switching, exact force"},
                    rows);
}

std::string paper_part(const Motions& of_paper) {
  if (of_paper.empty()) return "";
  return page_text("of paper", {{"subharmonics", escaped(subharmonics_text(of_paper))},
                                {"table", table_of_paper(of_paper)}});
}

std::string law_cell(const StudiedMotion& motion) {
  return "<strong>" + escaped(amplitude_text(motion)) + "</strong><br>" +
         escaped(period_or_reason(motion.period));
}

std::string table_of_laws(const Motions& laws) {
  std::string rows;
  for (auto sampled = laws.begin(); sampled != laws.end(); sampled += 2) {
    const std::string& law = sampled->loop.the_case.backlash.law;
    const std::string words = law == "none" ? "no backlash" : replaced(law, "_", " ");
    rows += html_row({escaped(words), law_cell(sampled[0]), law_cell(sampled[1])});
  }
  return html_table({"law", "switching at samples", "exact switching"}, rows);
}

std::string links_to_tables(bool of_paper) {
  std::string html;
  for (const std::string name : {"case", "paper", "law-motions"})
    if (of_paper || name != "paper") html += page_text("link to switching", {{"name", name}});
  return html;
}

}  // namespace

std::string switching_lead(const std::vector<StudiedMotion>& of_case) {
  const StudiedMotion& exact = of_case[exact_switching];
  constexpr double at_rest = 1e-12;
  const auto rests = [](const StudiedMotion& motion) {
    return is_followed(motion) && motion.steady.largest_displacement < at_rest;
  };
  if (std::all_of(of_case.begin(), of_case.end(), rests)) return page_text("rest");
  const StudiedMotion& sampled = of_case[sampled_switching];
  return amplitude_sentence(sampled, exact) + " " + period_sentence(sampled.period, exact.period) +
         held_sentence(of_case[sampled_and_held], exact);
}

std::string subharmonics_text(const std::vector<StudiedMotion>& motions) {
  const std::size_t loops = motions.size() / readings.size();
  std::array<std::size_t, readings.size()> shortest{};
  std::size_t longest = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const FoundPeriod& period = motions[k].period;
    if (period.samples > 0 && period.samples == shortest_period(motions[k].loop))
      ++shortest[k % readings.size()];
    if (k % readings.size() == sampled_and_held &&
        period.forcing_periods > motions[longest].period.forcing_periods)
      longest = k;
  }
  const auto share = [&](std::size_t reading) {
    return std::to_string(shortest[reading]) + " of the " + std::to_string(loops);
  };
  const StudiedMotion* of_longest = &motions[longest];
  return page_text("subharmonics",
                   {{"exact", share(exact_switching)},
                    {"sampled", share(sampled_switching)},
                    {"held", share(sampled_and_held)},
                    {"loop", loop_text(of_longest->loop.the_case)},
                    {"longest", period_or_reason(of_longest->period)},
                    {"longest exact", period_or_reason(of_longest[exact_switching].period)}});
}

std::string html_of(const SwitchingPage& page) {
  const StudiedLoop& studied = page.of_case.front().loop;
  return page_text("switching", {{"lead", escaped(switching_lead(page.of_case))},
                                 {"loop", escaped(loop_text(studied.the_case))},
                                 {"duration", rounded(studied.duration, 4)},
                                 {"of case", table_of_case(page.of_case)},
                                 {"of paper", paper_part(page.of_paper)},
                                 {"laws", table_of_laws(page.laws)},
                                 {"tables", links_to_tables(!page.of_paper.empty())},
                                 {"figures", figures_html(page.figures)}});
}

}  // namespace holdfast::program
