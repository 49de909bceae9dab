#include "report/comparison/comparison.hpp"

#include <algorithm>
#include <utility>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/response/response.hpp"
#include "report/comparison/comparison_tools.hpp"
#include "text/compiled_texts.hpp"
#include "text/text.hpp"

namespace holdfast::program {

namespace {

/// Quantity, paper, reading, why; of a number how far it may be from the paper's.
const toml::array& row_named(const std::string& name) {
  static const toml::table texts = toml::parse(comparison_texts);
  return *texts[name].as_array();
}

std::string interval_text(const std::vector<Interval<double>>& intervals) {
  if (intervals.empty()) return "none";
  std::string text;
  for (const auto& interval : intervals) {
    text += (text.empty() ? "" : " and ") + rounded(interval.lower, 4) + " … " +
            rounded(interval.upper, 4);
  }
  return text + " N s/m";
}

std::vector<Interval<double>> stable_gains(double sampling_period, double delay_fraction) {
  const IdealLoop<double> loop = paper_loop(sampling_period, 0.0, delay_fraction);
  return stable_differential_gains(
      characteristic_polynomial(sampled_loop(loop.plant, loop.sampling)), -557.0);
}

double lower_edge(const std::vector<Interval<double>>& intervals) {
  return intervals.empty() ? std::nan("") : intervals.front().lower;
}

void compare_stability(Comparisons& rows) {
  const auto continuous =
      stable_differential_gains(characteristic_polynomial(kollar2022_plant()), -557.0);
  rows.number("fig3", lower_edge(continuous));
  for (const double fraction : delay_fractions)
    rows.number("fig4a", lower_edge(stable_gains(0.010, fraction)), delay_of(fraction));
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.010}));
  const double flip =
      -(evaluate(polynomial.base, -2.0) - 557.0 * evaluate(polynomial.proportional, -2.0)) /
      evaluate(polynomial.differential, -2.0);
  rows.number("fig4a flip", flip);
  for (const double fraction : delay_fractions) {
    const auto gains = stable_gains(0.050, fraction);
    rows.statement("fig4b", interval_text(gains), gains.empty(), delay_of(fraction));
  }
}

void compare_best_gain(Comparisons& rows) {
  constexpr double fast = 1e-5;
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{fast});
  const double omega = 20.0 * pi<double>;
  const SteadyResponse<double> response(loop, held_harmonic(loop), omega);
  const auto stable = stable_gains(fast, 0.0);
  const auto best = response.best_differential_gain(-557.0, stable);
  rows.statement(
      "best D",
      rounded(best.differential_gain, 4) + " against " + rounded(lower_edge(stable), 4) + " N s/m",
      std::abs(best.differential_gain) < 0.9 * std::abs(lower_edge(stable)));
}

/// Longest sampling period (s) that serves at a frequency (Hz), P being tuned to it.
double longest_period(double frequency, double delay_fraction) {
  MaxDelayOptions options;
  options.frequency = frequency;
  options.proportional_gain = tuned_proportional_gain(74.4, 0.16, frequency);
  options.delay_fraction = delay_fraction;
  return max_sampling_period(kollar2022_plant(), options).sampling_period;
}

/// Frequency, in steps of 0.1 Hz, at which the slowest computer serves.
double frequency_of_longest_period(double delay_fraction) {
  std::pair<double, double> best{0.0, 0.0};
  for (int tenths = 20; tenths <= 100; ++tenths)
    best = std::max(best, {longest_period(tenths / 10.0, delay_fraction), tenths / 10.0});
  return best.second;
}

void compare_delay(Comparisons& rows) {
  for (const double fraction : delay_fractions) {
    const double at_50 = longest_period(50.0, fraction);
    rows.number("fig5", longest_period(10.0, fraction) * 1e3, delay_of(fraction));
    rows.number("fig5 longest", frequency_of_longest_period(fraction), delay_of(fraction));
    rows.statement("fig5 fast", rounded(at_50 * 1e3, 3) + " ms at 50 Hz", at_50 < 1e-3,
                   delay_of(fraction));
  }
}

/// Largest |z₁| of ten forcing periods from 30 s on.
double steady_amplitude(const IdealLoop<double>& loop) {
  return seen_by(PhaseExtent(30.0), loop, 31.0).displacement();
}

/// Smallest backlash, in steps of 0.1 mm, in which the motion stays for good once the transient is
/// over.
double swallowing_backlash() {
  for (int tenths = 5; tenths < 100; ++tenths) {
    const IdealLoop<double> loop = paper_loop(0.001, tenths * 1e-4);
    if (seen_by(SwitchLog(30.0), loop, 40.0).switches().empty()) return loop.backlash_width;
  }
  return std::nan("");
}

void compare_histories(Comparisons& rows) {
  const IdealLoop<double> controlled = paper_loop(0.001), loop = paper_loop(0.001, 0.0005);
  IdealLoop<double> uncontrolled = controlled;
  uncontrolled.gains = {0.0, 0.0};
  const auto peaks_of = [](const IdealLoop<double>& of) { return seen_by(FirstPeaks(), of, 1.0); };
  const FirstPeaks none = peaks_of(uncontrolled);
  rows.number("fig6a control", none.above_equilibrium() / peaks_of(controlled).above_equilibrium());
  rows.number("fig6a backlash", peaks_of(loop).below_equilibrium() / none.below_equilibrium());
  rows.number("fig6b", steady_amplitude(loop) / steady_amplitude(uncontrolled));
  rows.number("swallows", swallowing_backlash() * 1e3);
}

/// Time from the kick until the peaks of three forcing periods are again within 5 % of the
/// undisturbed ones.
double settling_time(const IdealLoop<double>& loop, double kick_time) {
  const Recorder recorder(samples_within(8.0, loop.sampling.period));
  const Recorder undisturbed = seen_by(recorder, loop, 8.0);
  const Recorder kicked = seen_by(recorder, loop, 8.0, Kick{kick_time, -0.003});
  const auto per_window = static_cast<std::size_t>(std::lround(0.3 / loop.sampling.period));
  double settled = kick_time;
  for (std::size_t j = 0; j + per_window < kicked.samples().size(); ++j) {
    double with = 0.0, without = 0.0;
    for (std::size_t k = j; k < j + per_window; ++k) {
      with = std::max(with, std::abs(kicked.samples()[k].state[0]));
      without = std::max(without, std::abs(undisturbed.samples()[k].state[0]));
    }
    if (std::abs(with - without) > 0.05 * without) settled = kicked.samples()[j].time;
  }
  return settled - kick_time;
}

void compare_perturbations_and_switching(Comparisons& rows) {
  rows.number("fig7a", settling_time(paper_loop(0.001, 0.0005), 0.95));
  const double slow = settling_time(paper_loop(0.010, 0.002), 0.84);
  rows.statement("fig7b", rounded(slow, 3) + " s", slow > 2.0);
  const SwitchLog log = seen_by(SwitchLog(9.06), paper_loop(0.001, 0.0005), 9.2);
  const char* printed[] = {"9.065", "9.068", "9.069", "9.095"};
  for (std::size_t k = 0; k < 4; ++k) {
    const bool enters = k % 2 == 0;
    const auto& found = log.switches().at(k);
    rows.number("fig8b",
                found.entered == enters ? static_cast<double>(found.index) / 1000.0 : std::nan(""),
                {{"does", enters ? "enters" : "leaves"}, {"time", printed[k]}});
  }
}

}  // namespace

Values delay_of(double fraction) {
  return {{"delay", fraction == 0.0 ? "δ = 0" : "δ = τ, as Eq. 14 prints it"}};
}

void Comparisons::number(const std::string& row, double ours, const Values& values) {
  const toml::array& texts = row_named(row);
  const std::string plain = replaced(text_of(texts[1], values), "−", "-");
  const std::size_t digits = plain.find_first_of("-0123456789");
  const std::size_t unit = std::min(plain.find(' ', digits), plain.size());
  const double paper = *parse_number(plain.substr(digits, unit - digits));
  // Tolerance of one per cent on the paper's number; its decimals allow half a unit of the last.
  const double within =
      texts.size() > 4 ? texts[4].value<double>().value() : std::max(0.01 * std::abs(paper), 5e-5);
  statement(row, rounded(ours, 4) + plain.substr(unit), std::abs(ours - paper) <= within, values);
}

void Comparisons::statement(const std::string& row, const std::string& ours, bool holds,
                            const Values& values) {
  const toml::array& texts = row_named(row);
  rows.push_back({text_of(texts[0], values), text_of(texts[1], values), ours,
                  text_of(texts[2], values), holds, holds ? "" : text_of(texts[3], values)});
}

std::vector<Comparison> compare_with_paper() {
  Comparisons rows;
  compare_cable(rows);
  compare_stability(rows);
  compare_best_gain(rows);
  compare_delay(rows);
  compare_histories(rows);
  compare_perturbations_and_switching(rows);
  compare_characteristics(rows);
  return rows.rows;
}

}  // namespace holdfast::program
