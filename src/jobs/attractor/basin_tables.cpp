#include "jobs/attractor/basin_tables.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "case/axes/axis.hpp"
#include "case/axes/grid.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/basins.hpp"
#include "holdfast/phase_space/event_basins.hpp"
#include "io/grid/grid_table.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "jobs/charts/row_blocks.hpp"
#include "kernels/pack_kernels.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr double most_states = 1e7;

/// Deals tiles of states out to threads.
struct ThreadedTiles {
  int threads;

  template <class TileJob>
  void operator()(std::size_t count, std::size_t tile, const TileJob& job) const {
    parallel_rows(static_cast<std::int64_t>(count), static_cast<std::int64_t>(tile), threads, 0,
                  [&job](int&, std::int64_t first, std::int64_t number) {
                    throw_if_interrupted();
                    job(static_cast<std::size_t>(first), static_cast<std::size_t>(number));
                  });
  }
};

class AttractorSetTest final : public AttractionTest {
 public:
  explicit AttractorSetTest(const AttractorSet<IdealLoop<double>>& attractor_set)
      : attractor_set_(attractor_set) {}
  int attracted_by(const ForcedMotionMemory<double>& memory) const override {
    return attractor_set_.attracted_by(memory);
  }

 private:
  const AttractorSet<IdealLoop<double>>& attractor_set_;
};

/// MotionBatch on the packs of an instruction set.
class TravelOnPacks : public CopiedKernel<TravelKernel> {
 public:
  using CopiedKernel::CopiedKernel;
  void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
           const AttractorSet<IdealLoop<double>>& attractor_set) {
    kernel().run(motions, count, samples, AttractorSetTest(attractor_set));
  }
};

BasinMap basins_on_packs(const IdealLoop<double>& loop,
                         const std::vector<Vector<double, 4>>& states, const OrbitLimits& limits,
                         InstructionSet set, const ThreadedTiles& tiles) {
  const auto travel = [set](const auto& motion, const auto& gains, const Rational& ratio) {
    return TravelOnPacks(pack_kernels(set).travel(motion, gains, ratio));
  };
  return find_basins_by(travel, loop, states, limits, tiles);
}

KeyAxis initial_axis(const std::string& text) {
  KeyAxis axis = parse_key_axis("--axis", text);
  if (axis.key.rfind("initial.", 0) != 0 || find_case_key(axis.key) == nullptr) {
    throw WrongInput("--axis " + text +
                     ": expected a key of the initial state, initial.z1, initial.v1, initial.z2 or "
                     "initial.v2");
  }
  return axis;
}

struct StateGrid {
  KeyAxis slow;
  KeyAxis fast;

  std::vector<Vector<double, 4>> states(const Case& the_case) const {
    std::vector<Vector<double, 4>> all;
    Case changed = the_case;
    for (std::int64_t row = 0; row < slow.axis.count; ++row) {
      set_case_value(changed, slow.key, slow.axis.at(row));
      for (std::int64_t column = 0; column < fast.axis.count; ++column) {
        set_case_value(changed, fast.key, fast.axis.at(column));
        all.push_back(initial_state_of(changed));
      }
    }
    return all;
  }
};

StateGrid grid_of(const BasinOptions& options) {
  if (options.axes.size() != 2)
    throw WrongInput(
        "--axis: basins need two axes over initial.*, for example --axis "
        "initial.z1=-0.005:0.005:101 --axis initial.z2=-0.005:0.005:101");
  StateGrid grid{initial_axis(options.axes[0]), initial_axis(options.axes[1])};
  if (grid.slow.key == grid.fast.key) throw WrongInput("--axis: both axes are " + grid.slow.key);
  const double count =
      static_cast<double>(grid.slow.axis.count) * static_cast<double>(grid.fast.axis.count);
  if (count > most_states)
    throw WrongInput("--axis: " + format_number(count) + " initial states are more than " +
                     format_number(most_states));
  return grid;
}

double number_of(const BasinLabel& label) {
  if (label.outcome == OrbitOutcome::diverges) return 0.0;
  return label.attractor < 0 ? -1.0 : static_cast<double>(label.attractor + 1);
}

template <class Orbit>
double period_of(const BasinsOf<Orbit>& map, const BasinLabel& label) {
  if (label.attractor < 0) return std::numeric_limits<double>::quiet_NaN();
  return map.attractors[static_cast<std::size_t>(label.attractor)].orbit.period();
}

template <class Orbit>
void write_states(const JobContext& context, const StateGrid& grid, const BasinsOf<Orbit>& map) {
  GridTable table(
      context, grid_axis(grid.slow), grid_axis(grid.fast),
      {{{"attractor", "", "its number from 1 on; 0: the motion diverges; -1: no orbit was found",
         "integer"}},
       {{"period_s", "s", "of the attractor; nan where there is none"}}});
  const auto columns = static_cast<std::size_t>(grid.fast.axis.count);
  std::vector<double> numbers(columns), periods(columns);
  for (std::size_t first = 0; first < map.labels.size(); first += columns) {
    for (std::size_t k = 0; k < columns; ++k) {
      numbers[k] = number_of(map.labels[first + k]);
      periods[k] = period_of(map, map.labels[first + k]);
    }
    table.append_row({numbers.data(), periods.data()});
  }
  table.commit();
}

template <class Orbit>
void write_fractions(const JobContext& context, const BasinsOf<Orbit>& map) {
  Table table(
      context,
      {{"attractor", "", "its number; 0: diverges; -1: no orbit was found", "integer"},
       {"period_samples", "", "samples of its period; 0 without one", "integer"},
       {"period_s", "s", "period; nan without one"},
       {"amplitude_m", "m", "largest displacement of the conductor at a sample"},
       {"largest_multiplier", "", "largest modulus of a multiplier"},
       {"states", "", "initial states that come to it", "integer"},
       {"fraction", "", "of all initial states"},
       {"standard_error", "", "of the fraction, the states being taken as a sample"},
       {"mirror_image_of", "", "number of the attractor that it mirrors; 0: none", "integer"}});
  const auto all = static_cast<double>(map.labels.size());
  int number = 0;
  for (const auto& attractor : map.attractors) {
    const Orbit& orbit = attractor.orbit;
    table.row(++number, orbit.period_samples(), orbit.period(), orbit.amplitude(),
              orbit.largest_multiplier(), attractor.states, attractor.fraction,
              attractor.standard_error, attractor.mirror_image ? *attractor.mirror_image + 1 : 0);
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double kind : {0.0, -1.0}) {
    std::size_t states = 0;
    for (const BasinLabel& label : map.labels) states += number_of(label) == kind ? 1 : 0;
    if (states == 0) continue;
    const double fraction = static_cast<double>(states) / all;
    table.row(static_cast<int>(kind), 0, none, none, none, states, fraction,
              std::sqrt(fraction * (1.0 - fraction) / all), 0);
  }
  table.commit();
}

void require_attractors(const std::optional<Rational>& ratio, std::int64_t largest_period) {
  if (!ratio) {
    throw NoAnswer(
        "sampling and excitation never coincide, so no motion is periodic and attractors cannot be "
        "told apart by their orbits");
  }
  if (ratio->denominator > largest_period) {
    throw NoAnswer("sampling and excitation coincide only every " +
                   std::to_string(ratio->denominator) +
                   " samples; give --max-period at least as many");
  }
}

template <class Orbit>
void write_map(const JobContext& context, const BasinOptions& options, const StateGrid& grid,
               const BasinsOf<Orbit>& map) {
  options.fractions ? write_fractions(context, map) : write_states(context, grid, map);
}

}  // namespace

void write_basins(const JobContext& context, const BasinOptions& options) {
  const StateGrid grid = grid_of(options);
  const auto states = grid.states(context.case_data);
  const OrbitLimits limits{options.largest_period, 0, throw_if_interrupted};
  const ThreadedTiles tiles{context.threads};
  if (is_of_the_paper(context.case_data, options.switching)) {
    const IdealLoop<double> loop = ideal_loop_of(context.case_data);
    require_attractors(forcing_ratio(loop), options.largest_period);
    write_map(context, options, grid,
              basins_on_packs(loop, states, limits, context.instructions, tiles));
  } else {
    const ImplementedLoop loop = implemented_loop_of(context.case_data, options.switching);
    require_attractors(forcing_ratio(loop.digital), options.largest_period);
    write_map(context, options, grid, find_basins(loop, states, limits, tiles));
  }
}

}  // namespace holdfast::program
