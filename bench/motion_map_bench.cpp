// The periodic motions of a map of backlash and sampling period (r₀, τ), each found and certified
// from rest, against the brute force of tests/support/plain_motion.hpp, switched exactly that of
// plain_event_motion.hpp: prints in how many cells the two have the same period and the same
// amplitude, and where they do not how near the certified motion is to a switching surface.
//
//     motion_map_bench [rows] [columns] [threads] [exact]      rows of r₀, columns of τ

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "../tests/support/plain_event_motion.hpp"
#include "../tests/support/plain_motion.hpp"
#include "holdfast/phase_space/motion_map.hpp"
#include "timed_cells.hpp"

namespace {

using namespace holdfast;

constexpr std::int64_t largest_period = 100'000;
constexpr double steps_of_period = 1e-4;  // s: f τ = k/1000

struct Grid {
  std::size_t rows, columns;

  /// 0.5 … 2 mm.
  double width(std::size_t cell) const {
    return 0.0005 + 0.0015 * static_cast<double>(cell / columns) / static_cast<double>(rows - 1);
  }
  /// 1 … 12 ms, multiples of 0.1 ms.
  double period(std::size_t cell) const {
    const double share =
        columns > 1 ? static_cast<double>(cell % columns) / static_cast<double>(columns - 1) : 0.0;
    return std::round((0.001 + 0.011 * share) / steps_of_period) / 10'000.0;
  }
  IdealLoop<double> loop(std::size_t cell) const {
    return {kollar2022_plant(), {period(cell), 0.0}, {-557.0, -13.0}, {0.5, 10.0}, width(cell)};
  }
};

/// A loop that switches exactly.
ImplementedLoop switched_exactly(const IdealLoop<double>& loop) {
  ImplementedLoop exact = implemented_loop(loop);
  exact.switching = Switching::exact;
  return exact;
}

/// What was found of a motion by either way.
struct Seen {
  std::int64_t period = 0;  // coincidences; 0: none
  double amplitude = 0.0;   // m
};

template <class Motion>
Seen plainly_seen(const IdealLoop<double>& loop) {
  const std::int64_t coincidence = forcing_ratio(loop)->denominator;
  Motion motion(test::plain_loop(loop, coincidence));
  Seen seen{test::settled_period(motion, coincidence, 32 * largest_period), 0.0};
  motion.begin_record();
  for (std::int64_t k = 0; k < seen.period; ++k) motion.step();
  seen.amplitude = motion.largest_sample();
  return seen;
}

/// The map of one cell, from rest.
template <class Loop>
MapCell mapped_cell(const Loop& loop) {
  const auto one = [](std::size_t all, std::size_t, const auto& job) { job(std::size_t{0}, all); };
  MotionMapOptions options;
  options.limits.largest_period = largest_period;
  options.most_rounds = 0;
  return motion_map([&](std::size_t) { return std::optional(loop); }, {1, 1},
                    Vector<double, 4>(Vector<double, 4>::Zero()), one, options)
      .front();
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int k, unsigned long otherwise) {
    return count > k ? std::strtoul(arguments[k], nullptr, 10) : otherwise;
  };
  const Grid grid{number(1, 40), number(2, 23)};
  const auto threads =
      static_cast<unsigned>(number(3, std::max(1U, std::thread::hardware_concurrency())));
  const std::size_t cells = grid.rows * grid.columns;
  const bool exact = count > 4 && std::string(arguments[4]) == "exact";
  std::vector<MapCell> found(cells);
  const double map_seconds = timed_cells(cells, threads, [&](std::size_t cell) {
    const IdealLoop<double> loop = grid.loop(cell);
    found[cell] = exact ? mapped_cell(switched_exactly(loop)) : mapped_cell(loop);
  });
  std::vector<Seen> plain(cells);
  const double plain_seconds = timed_cells(cells, threads, [&](std::size_t cell) {
    const IdealLoop<double> loop = grid.loop(cell);
    plain[cell] =
        exact ? plainly_seen<test::PlainEventMotion>(loop) : plainly_seen<test::PlainMotion>(loop);
  });
  std::size_t agree = 0, certified = 0, repeats = 0, near = 0, unsettled = 0, other = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const MappedMotion* const motion = found[cell].from_start();
    const std::int64_t coincidence = forcing_ratio(grid.loop(cell))->denominator;
    const std::int64_t certain = motion != nullptr ? motion->period_samples / coincidence : 0;
    const Seen& seen = plain[cell];
    certified += certain > 0 ? 1 : 0;
    repeats += seen.period > 0 ? 1 : 0;
    const double apart =
        motion != nullptr ? std::abs(motion->amplitude - seen.amplitude) / motion->amplitude : 0.0;
    if (certain == seen.period && apart < 1e-6) {
      ++agree;
      continue;
    }
    const double share = motion != nullptr ? motion->border_share : 0.0;
    (share < 1e-6 ? near : certain == 0 || seen.period == 0 ? unsettled : other) += 1;
    std::printf(
        "differ: tau %.4f r0 %.9g certified %lld plain %lld amplitudes %.3g apart, border share "
        "%.3g\n",
        grid.period(cell), grid.width(cell), static_cast<long long>(certain),
        static_cast<long long>(seen.period), apart, share);
  }
  std::printf(
      "%zu cells: %zu agree (%.4f %%); of the others %zu within 1e-6 of a surface, %zu found by "
      "one "
      "alone, %zu otherwise\ncertified %zu, seen to repeat %zu\nmap %.1f s, plain %.1f s on %u "
      "threads\n",
      cells, agree, 100.0 * static_cast<double>(agree) / static_cast<double>(cells), near,
      unsettled, other, certified, repeats, map_seconds, plain_seconds, threads);
  return other == 0 ? 0 : 1;
}
