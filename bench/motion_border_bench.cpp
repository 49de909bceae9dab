// The borders of exactly switched motions over backlash and sampling period (r₀, τ), f τ kept,
// against the brute force of tests/support/plain_event_motion.hpp: in each cell of a grid the
// motion from rest is simulated until it repeats, and its contacts follow one another as those of
// the named motion do, or otherwise. Where they do outside the border of the named motion itself,
// the border is followed there too, as another part of the region. Prints how many parts there are
// and in how many cells both agree.
//
//     motion_border_bench [rows] [columns] [threads] [motion]
//
// with so many rows of r₀ and columns of τ per motion, of which the fourth number picks one.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "../tests/support/plain_event_motion.hpp"
#include "../tests/support/region_places.hpp"
#include "holdfast/orbit/event/event_motion_region.hpp"
#include "timed_cells.hpp"

namespace {

using namespace holdfast;

constexpr double away = 0.002;  // from a border, in shares of the window

/// A motion of the paper's parameters, and how far about them its border is followed.
struct Named {
  double period, width;                 // τ, r₀
  double width_from, width_to, around;  // m, m, share of τ

  ParameterWindow window() const {
    return {width_from, width_to, (1.0 - around) * period, (1.0 + around) * period};
  }
  IdealLoop<double> loop(const PlanePoint& at) const {
    return {kollar2022_plant(), {at.y, 0.0}, {-557.0, -13.0}, {0.5, 10.0 * period / at.y}, at.x};
  }
  std::int64_t coincidence() const { return forcing_ratio(loop({width, period}))->denominator; }
  ImplementedLoop exact(double x, double y) const {
    ImplementedLoop other = implemented_loop(loop({x, y}));
    other.switching = Switching::exact;
    return other;
  }
  std::optional<EventOrbit> orbit(const PlanePoint& at) const {
    auto found =
        find_event_orbit(event_motion(exact(at.x, at.y), Vector<double, 4>::Zero().eval()));
    return found.outcome == OrbitOutcome::certified ? std::move(found.orbit) : std::nullopt;
  }
  MotionRegion region(const EventOrbit& orbit, const PlanePoint& at) const {
    return motion_region([this](double x, double y) { return exact(x, y); }, orbit, window(), at);
  }
};

// At 1 ms 0.5 and 2 mm have the same motion.
constexpr Named all_named[] = {{0.001, 0.002, 0.0002, 0.003, 0.3},
                               {0.003, 0.002, 0.0002, 0.003, 0.3},
                               {0.01, 0.002, 0.0002, 0.003, 0.3},
                               {0.011, 0.001, 0.0002, 0.003, 0.3},
                               {0.011, 0.002, 0.0019, 0.0021, 0.03}};

/// By which a motion is told from others.
struct Name {
  std::int64_t turns;  // coincidences in a period
  std::string word;
  bool mirrored;  // its own mirror image half a period later

  friend bool operator==(const Name& a, const Name& b) {
    return a.turns == b.turns && a.mirrored == b.mirrored && test::same_turn(a.word, b.word);
  }
};

Name name_of(const EventOrbit& orbit) {
  Name name{orbit.period_samples() / orbit.ratio.denominator, {}, detail::mirrors_itself(orbit)};
  for (const ContactSwitch& change : orbit.switches) name.word += test::letter_of(change.mode);
  return name;
}

/// Cells of a window.
struct Grid {
  std::size_t rows, columns;
  ParameterWindow window;

  std::size_t cells() const { return rows * columns; }
  PlanePoint middle(std::size_t cell) const {
    const auto share = [](std::size_t k, std::size_t of) {
      return (static_cast<double>(k) + 0.5) / static_cast<double>(of);
    };
    return window.at({share(cell / columns, rows), share(cell % columns, columns)});
  }
};

/// Whether the motion from rest is, by brute force, of this name.
bool is_plainly(const Named& named, const Name& name, const PlanePoint& at) {
  const std::int64_t coincidence = named.coincidence();
  test::PlainEventMotion motion(test::plain_loop(named.loop(at), coincidence));
  if (test::settled_period(motion, coincidence, 3'200'000, 24) != name.turns) return false;
  motion.begin_record();
  for (std::int64_t k = 0; k < name.turns; ++k) motion.step();
  return name == Name{name.turns, motion.word(), motion.mirrors_itself()};
}

/// The parts of a motion's region.
struct Parts {
  std::vector<MotionRegion> parts;

  bool enclose(const PlanePoint& at) const {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const MotionRegion& part) { return test::encloses(part, at.x, at.y); });
  }
  double distance(const ParameterWindow& window, const PlanePoint& at) const {
    double least = std::numeric_limits<double>::infinity();
    for (const MotionRegion& part : parts)
      least = std::min(least, test::distance_to_border(part, window, at));
    return least;
  }
};

struct Tally {
  std::size_t cells = 0, inside = 0, agree = 0, away = 0, agree_away = 0;

  void add(const Tally& other) {
    cells += other.cells;
    inside += other.inside;
    agree += other.agree;
    away += other.away;
    agree_away += other.agree_away;
  }
  void print() const {
    const auto share = [](std::size_t part, std::size_t of) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(of);
    };
    std::printf(
        "%zu cells, %zu inside, %zu agree (%.4f %%); away from borders %zu, of them %zu agree "
        "(%.4f %%)\n",
        cells, inside, agree, share(agree, cells), away, agree_away, share(agree_away, away));
    std::fflush(stdout);
  }
};

/// One named motion.
Tally compared(const Named& named, const Grid& grid, unsigned threads) {
  const PlanePoint own{named.width, named.period};
  const std::optional<EventOrbit> orbit = named.orbit(own);
  if (!orbit) return {};
  const Name name = name_of(*orbit);
  std::vector<char> is(grid.cells());
  const double plain_seconds = timed_cells(grid.cells(), threads, [&](std::size_t cell) {
    is[cell] = is_plainly(named, name, grid.middle(cell)) ? 1 : 0;
  });
  Parts region;
  std::size_t open = 0;
  const auto add_part = [&](const EventOrbit& seed, const PlanePoint& at) {
    region.parts.push_back(named.region(seed, at));
    open += region.parts.back().closed ? 0 : 1;
  };
  const double border_seconds = timed_cells(1, 1, [&](std::size_t) {
    add_part(*orbit, own);
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
      const PlanePoint at = grid.middle(cell);
      if (is[cell] == 0 || region.enclose(at) || region.distance(grid.window, at) < away) continue;
      const std::optional<EventOrbit> seed = named.orbit(at);
      if (seed && name_of(*seed) == name) add_part(*seed, at);
    }
  });
  Tally tally{grid.cells()};
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    const PlanePoint at = grid.middle(cell);
    const bool inside = region.enclose(at), agrees = inside == (is[cell] != 0);
    const double distance = region.distance(grid.window, at);
    tally.inside += inside ? 1 : 0;
    tally.agree += agrees ? 1 : 0;
    tally.away += distance > away ? 1 : 0;
    tally.agree_away += distance > away && agrees ? 1 : 0;
    if (distance > away && !agrees)
      std::printf("differ: tau %.9g r0 %.9g, %s its border by %.3g, the motion from rest is %s\n",
                  at.y, at.x, inside ? "inside" : "outside", distance,
                  is[cell] != 0 ? "this one" : "another one");
  }
  std::printf(
      "tau %.3f r0 %.4f, %zu switches: %zu parts, %zu not closed (%.1f s; plain %.1f s)\n  ",
      named.period, named.width, name.word.size(), region.parts.size(), open, border_seconds,
      plain_seconds);
  tally.print();
  return tally;
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int k, unsigned long otherwise) {
    return count > k ? std::strtoul(arguments[k], nullptr, 10) : otherwise;
  };
  const auto threads =
      static_cast<unsigned>(number(3, std::max(1U, std::thread::hardware_concurrency())));
  const auto alone = number(4, 0);
  Tally all;
  for (std::size_t k = 0; k < std::size(all_named); ++k) {
    if (alone != 0 && alone != k + 1) continue;
    const Named& named = all_named[k];
    all.add(compared(named, {number(1, 40), number(2, 40), named.window()}, threads));
  }
  std::printf("all\n  ");
  all.print();
  return all.agree_away == all.away ? 0 : 1;
}
