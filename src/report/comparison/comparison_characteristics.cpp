#include <algorithm>
#include <string>
#include <vector>

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/signal/spectrum.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/coverage.hpp"
#include "holdfast/phase_space/deviation.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "report/comparison/comparison_tools.hpp"

namespace holdfast::program {
namespace {

void compare_boundedness(Comparisons& rows) {
  for (const double fraction : delay_fractions) {
    const IdealLoop<double> loop = paper_loop(0.011, 0.002, fraction);
    auto motion = motion_of(loop);
    const bool bounded =
        run_trajectory(motion, samples_within(1000.0, 0.011), {}) == TrajectoryOutcome::completed;
    const double radius =
        spectral_radius<double, 5>(sampled_loop(loop.plant, loop.sampling).engaged_map(loop.gains));
    rows.statement("fig9c",
                   (bounded ? "bounded, ρ(S) = " : "diverges, ρ(S) = ") + rounded(radius, 4),
                   bounded, delay_of(fraction));
  }
}

std::string certificate_of(const OrbitResult& found) {
  if (found.outcome != OrbitOutcome::certified) return "no certified orbit";
  const PeriodicOrbit& orbit = *found.orbit;
  return "certified period " + rounded(orbit.period(), 4) +
         " s: " + std::to_string(orbit.period_samples()) + " samples, " +
         std::to_string(orbit.forcing_periods()) + " forcing periods, largest multiplier " +
         rounded(orbit.largest_multiplier(), 3);
}

void compare_periods(Comparisons& rows) {
  for (const auto& [row, period] : {std::pair{"fig9b", 0.001}, {"fig12", 0.011}}) {
    const OrbitResult found =
        find_periodic_orbit(paper_loop(period, 0.002), Vector<double, 4>::Zero());
    rows.statement(row, certificate_of(found), found.outcome == OrbitOutcome::certified);
  }
}

std::vector<SpectralLine> steady_spectrum(double sampling_period) {
  const IdealLoop<double> loop = paper_loop(sampling_period, 0.002);
  const std::int64_t kept = whole_period_samples(samples_within(60.0, sampling_period),
                                                 loop.excitation.frequency, sampling_period);
  auto motion = motion_of(loop);
  std::vector<double> record;
  record.reserve(static_cast<std::size_t>(kept));
  run_trajectory(motion, samples_within(40.0, sampling_period), {});
  run_trajectory(motion, kept, {},
                 [&](const MotionSample<double>& sample) { record.push_back(sample.state[0]); });
  return amplitude_spectrum(record, sampling_period, SpectralWindow::rectangular);
}

/// Frequency of the highest line between two frequencies.
double highest_line(const std::vector<SpectralLine>& lines, double from, double to) {
  SpectralLine highest{0.0, 0.0};
  for (const SpectralLine& line : lines) {
    if (line.frequency >= from && line.frequency <= to && line.amplitude > highest.amplitude)
      highest = line;
  }
  return highest.frequency;
}

void compare_spectra(Comparisons& rows) {
  const auto fast = steady_spectrum(0.001);
  const auto slow = steady_spectrum(0.011);
  rows.number("fig10a", highest_line(fast, 0.5, 45.0));
  rows.number("fig10a below", highest_line(fast, 0.5, 8.0));
  rows.number("fig10a above", highest_line(fast, 25.0, 45.0));
  rows.number("fig10b", highest_line(slow, 0.5, 45.0));
}

/// Largest |deviation of z₁| in the last second of a run.
double final_deviation(double sampling_period, double duration) {
  const IdealLoop<double> loop = paper_loop(sampling_period, 0.002);
  auto first = motion_of(loop), second = motion_of(loop, 1e-5);
  double largest = 0.0;
  run_deviation(first, second, samples_within(duration, sampling_period),
                [&](const Deviation& deviation) {
                  if (deviation.time > duration - 1.0)
                    largest = std::max(largest, std::abs(deviation.displacement));
                });
  return largest;
}

void compare_deviations(Comparisons& rows) {
  const double fast = final_deviation(0.001, 10.0), slow = final_deviation(0.011, 60.0);
  rows.statement("fig11a", rounded(fast, 2) + " m after 10 s, from 1e−5 m",
                 fast > 1e-7 && fast < 1e-2);
  rows.statement("fig11b", rounded(slow, 2) + " m after 60 s, from 1e−5 m", slow < 1e-7);
}

void compare_coverage(Comparisons& rows) {
  constexpr double sampling_period = 0.011;
  Coverage coverage({-1.5e-3, 1.5e-3, -0.1, 0.1}, 100);
  auto motion = motion_of(paper_loop(sampling_period, 0.002));
  std::vector<std::size_t> visited;
  for (const double duration : {10.0, 100.0, 1000.0}) {
    run_trajectory(motion, samples_within(duration, sampling_period) - motion.index(), {},
                   coverage);
    visited.push_back(coverage.visited());
  }
  const std::string counts = std::to_string(visited[0]) + ", " + std::to_string(visited[1]) + ", " +
                             std::to_string(visited[2]) + " cells";
  const auto growth = [&](std::size_t k) {
    return static_cast<double>(visited[k]) / static_cast<double>(visited[k - 1]);
  };
  rows.statement("filling", counts, growth(1) > 1.2 && growth(2) < 1.05);
}

struct Table2Column {
  double sampling_period, duration;
  std::vector<double> exponents;
};

void compare_exponents(Comparisons& rows, const Table2Column& column, double tangent_fraction) {
  const IdealLoop<double> loop = paper_loop(column.sampling_period, 0.002);
  const IdealLoop<double> tangent = paper_loop(column.sampling_period, 0.002, tangent_fraction);
  LyapunovObserver observer(sampled_loop(tangent.plant, tangent.sampling), loop.gains);
  auto motion = motion_of(loop);
  run_trajectory(motion, samples_within(column.duration, column.sampling_period) - 1, {}, observer);
  const auto exponents = observer.spectrum().exponents();
  const bool consistent = tangent_fraction == 0.0;
  for (int i = 0; i < 5; ++i) {
    const char* why =
        i == 4 ? "S* has a row of zeros, so this exponent is exactly −∞; a finite value is the "
                 "logarithm of round-off"
        : consistent ? "the paper's tangent is the one with δ = τ, while its trajectory has δ = 0"
                     : "finite time: the value still moves by more than this over such a record";
    rows.number(
        "table2", exponents[i],
        {{"i", std::to_string(i + 1)},
         {"period", rounded(column.sampling_period * 1e3, 2)},
         {"exponent", rounded(column.exponents[static_cast<std::size_t>(i)], 4)},
         {"tangent", consistent ? "consistent tangent, δ = 0" : "tangent as printed, δ = τ"},
         {"why", why}});
  }
}

}  // namespace

void compare_characteristics(Comparisons& rows) {
  compare_boundedness(rows);
  compare_periods(rows);
  compare_spectra(rows);
  compare_deviations(rows);
  compare_coverage(rows);
  const Table2Column fast{0.001, 10.0, {-0.0010, -0.0014, -0.0476, -0.0497, -33.26}};
  const Table2Column slow{0.011, 100.0, {-0.0140, -0.0148, -0.1855, -0.4789, -29.23}};
  for (const double tangent : {1.0, 0.0}) {
    compare_exponents(rows, fast, tangent);
    compare_exponents(rows, slow, tangent);
  }
}

}  // namespace holdfast::program
