#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "report/page/html.hpp"
#include "report/switching/switching_page.hpp"

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
  if (motion.steady.accumulates) return "not followed: its changes of contact accumulate";
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
  if (sampled.samples == 0 && exact.samples == 0)
    return "No certified periodic orbit is found with either.";
  if (sampled.samples == 0)
    return "At samples no certified periodic orbit is found; with exact switching the period is " +
           periods_text(exact) + ".";
  if (exact.samples == 0)
    return "At samples the period is " + periods_text(sampled) +
           "; with exact switching no certified periodic orbit is found.";
  if (sampled.samples == exact.samples)
    return "It leaves the period as it is, " + periods_text(exact) + ".";
  return "It makes the period " + periods_text(sampled) + " where it is " + periods_text(exact) +
         " with exact switching.";
}

std::string amplitude_sentence(const StudiedMotion& sampled, const StudiedMotion& exact) {
  if (!is_followed(sampled) || !is_followed(exact))
    return "For this case the motion with switching at samples is: " + amplitude_text(sampled) +
           "; with exact switching: " + amplitude_text(exact) + ".";
  const std::string both =
      amplitude_text(sampled) + " for " + amplitude_text(exact) + ", the force exact in both";
  const double change =
      sampled.steady.largest_displacement / exact.steady.largest_displacement - 1.0;
  if (std::abs(change) < 5e-5)
    return "For this case the sampled switching does not change the steady amplitude (" + both +
           ").";
  return "For this case the sampled switching changes the steady amplitude by " +
         change_text(sampled, exact) + " (" + both + ").";
}

std::string held_sentence(const StudiedMotion& held, const StudiedMotion& exact) {
  if (!is_followed(held) || !is_followed(exact)) return "";
  const FoundPeriod& period = held.period;
  return " With the force held over each sample too, as in the paper, the amplitude is " +
         amplitude_text(held) + " (" + change_text(held, exact) + "), " +
         (period.samples > 0 ? "the period " + periods_text(period)
                             : std::string("and no certified periodic orbit is found")) +
         ".";
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

/// @param cells  HTML
std::string row_of(const std::vector<std::string>& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
  return html + "</tr>\n";
}

std::string table_of_case(const Motions& of_case) {
  std::string rows;
  for (const StudiedMotion& motion : of_case) {
    const auto& [studied, steady, period] = motion;
    rows += row_of(
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

std::string case_part(const Motions& of_case) {
  const StudiedLoop& studied = of_case.front().loop;
  return "<p>This case, " + escaped(loop_text(studied.the_case)) +
         ", from its initial state: largest |z₁|, at all times, of the second half of " +
         rounded(studied.duration, 4) + " s.</p>\n" + table_of_case(of_case);
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
    rows += row_of({escaped(loop_text(first->loop.the_case)), paper_cell(first[0]),
                    paper_cell(first[1]), paper_cell(first[2])});
  return html_table({"loop", "switching at samples, force held (the paper)",
                     "switching at samples, exact force", "exact switching, exact force"},
                    rows);
}

std::string paper_part(const Motions& of_paper) {
  if (of_paper.empty()) return "";
  return "<h3>The paper's loops</h3>\n<p>Largest |z₁| at the samples in the second half of 3 s "
         "from rest (3.003 s at 11 ms), F = 0.5 N at 10 Hz, P = −557 N/m, D = −13 N s/m; the "
         "period of the orbit that the motion comes to, with its largest multiplier; and how often "
         "each phase of the contact begins in half a cycle of the force. <strong>" +
         escaped(subharmonics_text(of_paper)) + "</strong></p>\n" + table_of_paper(of_paper);
}

std::string law_cell(const StudiedMotion& motion) {
  return "<strong>" + escaped(amplitude_text(motion)) + "</strong><br>" +
         escaped(period_or_reason(motion.period));
}

std::string laws_part(const std::vector<StudiedLaw>& laws) {
  std::string rows;
  for (const StudiedLaw& law : laws)
    rows += row_of({escaped(law.words), law_cell(law.sampled), law_cell(law.exact)});
  return "<h3>Every law of the backlash</h3>\n<p>Largest |z₁| of the steady motion of this case, "
         "and its period, the force exact in all.</p>\n" +
         html_table({"law", "switching at samples", "exact switching"}, rows);
}

std::string tables_part(bool of_paper) {
  std::string html = "<p>As tables:";
  for (const std::string name : {"case", "paper", "law-motions"}) {
    const std::string file = "data/switching-" + name + ".csv";
    if (of_paper || name != "paper") html += " <a href=\"" + file + "\">" + file + "</a>";
  }
  return html + "</p>\n";
}

constexpr const char* explanation =
    "<p>In the paper the drive enters and leaves its backlash at samples alone. A belt does not "
    "wait for the clock: with <em>exact switching</em> the contact changes when it happens, found "
    "as the first root of what decides it, and only the computer keeps to its samples. Then a "
    "reversal at which the spring pushes out of the gap and the control pushes into it makes the "
    "drive <em>stick</em>: its sides stay together, z₂ − z₁ stands still, and it transmits what "
    "that takes, between zero and the command. Switching at samples makes a flicker of it. The "
    "<em>force</em> is taken exactly or <em>held</em> over each sample as in the paper.</p>\n";

}  // namespace

std::string switching_lead(const std::vector<StudiedMotion>& of_case) {
  const StudiedMotion& exact = of_case[exact_switching];
  constexpr double at_rest = 1e-12;
  const auto rests = [](const StudiedMotion& motion) {
    return is_followed(motion) && motion.steady.largest_displacement < at_rest;
  };
  if (std::all_of(of_case.begin(), of_case.end(), rests))
    return "This cable comes to rest with either switching: there is nothing that the sampled "
           "switching could change.";
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
  return "With exact switching " + share(exact_switching) +
         " motions have the shortest period that sampling and forcing allow; at samples " +
         share(sampled_switching) + " with the exact force, " + share(sampled_and_held) +
         " with the force held. The longest of these, at " +
         loop_text(motions[longest].loop.the_case) + ", has " +
         period_or_reason(motions[longest].period) + "; with exact switching it is " +
         period_or_reason(motions[longest + exact_switching].period) + ".";
}

std::string html_of(const SwitchingPage& page) {
  std::string html =
      "<h2 id=\"switching\">How much the sampled switching matters</h2>\n<p><strong>" +
      escaped(switching_lead(page.of_case)) + "</strong></p>\n" + explanation +
      case_part(page.of_case) + paper_part(page.of_paper) + laws_part(page.laws) +
      tables_part(!page.of_paper.empty());
  for (const DrawnFigure& figure : page.figures) html += figure_html(figure);
  return html;
}

}  // namespace holdfast::program
