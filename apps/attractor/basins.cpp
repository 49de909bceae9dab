#include <limits>

#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/math/stats/share_error.hpp"
#include "holdfast/phase_space/basins.hpp"
#include "holdfast/phase_space/event_basins.hpp"
#include "holdfast/phase_space/modal_basins.hpp"
#include "io/file/output.hpp"
#include "job.hpp"
#include "jobs/orbit/motion_cells.hpp"
#include "kernels/pack_kernels.hpp"
#include "output/grid/grid_output.hpp"
#include "output/row_blocks.hpp"

namespace holdfast::program {
namespace {

/// Propagator of a MotionBatch by the SIMD kernel of an instruction set.
struct PropagatorOnPacks {
  MotionKernel kernel;

  // NOLINTNEXTLINE(readability-make-member-function-const): the kernel has a state of its own
  void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
           const AttractorSet<IdealLoop<double>>& set) {
    kernel(motions, count, samples,
           {[&set](const ForcedMotionMemory<double>& memory) { return set.attracted_by(memory); }});
  }
};

KeyAxis initial_axis(const std::string& text) {
  KeyAxis axis = parse_key_axis("--axis", text);
  if (axis.key.rfind("initial.", 0) != 0 || find_case_key(axis.key) == nullptr) {
    throw WrongInput("--axis " + text +
                     ": the key must be initial.z1, initial.v1, initial.z2 or initial.v2");
  }
  return axis;
}

/// Checks the ends of an axis, which bound all states of the grid; throws WrongInput.
void require_admissible_ends(const KeyAxis& axis, const JobContext& context) {
  for (const double end : {axis.axis.min, axis.axis.max}) {
    Case at_end = context.case_data;
    set_case_value(at_end, axis.key, end);
    const CaseFault fault = first_fault(at_end);
    if (!fault.message.empty())
      throw WrongInput("--axis " + axis.key + " = " + format_number(end) + ": " + fault.message);
  }
}

KeyGrid grid_of(const std::vector<std::string>& axes) {
  return key_grid("--axis", axes,
                  "--axis initial.z1=-0.005:0.005:101 --axis initial.z2=-0.005:0.005:101",
                  10'000'000, initial_axis);
}

double number_of(const BasinLabel& label) {
  if (label.outcome == OrbitOutcome::diverges) return 0.0;
  return label.attractor < 0 ? -1.0 : static_cast<double>(label.attractor + 1);
}

template <class Orbit>
void write_states(const JobContext& context, const KeyGrid& grid, const BasinsOf<Orbit>& map) {
  // In netCDF a number is a double.
  const std::string whole = is_netcdf_name(context.output) ? "double" : "integer";
  GridOutput output(context, {{grid_axis(grid.slow), grid_axis(grid.fast)},
                              cell_columns_of("basins", {{"whole", whole}})});
  std::vector<double> numbers, periods;
  for (const BasinLabel& label : map.labels) {
    numbers.push_back(number_of(label));
    periods.push_back(
        label.attractor < 0
            ? std::numeric_limits<double>::quiet_NaN()
            : map.attractors[static_cast<std::size_t>(label.attractor)].orbit.period());
  }
  output.append(static_cast<std::int64_t>(numbers.size()), {numbers.data(), periods.data()});
  output.commit();
}

template <class Orbit>
void write_fractions(const JobContext& context, const BasinsOf<Orbit>& map) {
  Table table(context, columns_of("basin fractions"));
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
    for (const BasinLabel& label : map.labels) states += number_of(label) == kind ? 1U : 0U;
    if (states == 0) continue;
    const double fraction = static_cast<double>(states) / all;
    table.row(static_cast<int>(kind), 0, none, none, none, states, fraction,
              share_error(states, map.labels.size()), 0);
  }
  table.commit();
}

void require_attractors(const std::optional<Rational>& ratio, std::int64_t largest_period) {
  if (!ratio) {
    throw NoAnswer(
        "the sampling period and the excitation period have no common multiple, so no motion is "
        "periodic: change control.sampling_period or excitation.frequency");
  }
  if (ratio->denominator > largest_period) {
    throw NoAnswer("the period of every orbit is a multiple of " +
                   std::to_string(ratio->denominator) +
                   " samples, the common multiple of the sampling and excitation periods: give a "
                   "--max-period of at least so many samples");
  }
}

using States = std::vector<Vector<double, 4>>;

auto basins_of(const SampledMasses& moving, const JobContext& context, const States& states,
               const OrbitLimits& limits) {
  const auto propagate = [&](const auto& motion) {  // in packs
    return PropagatorOnPacks{pack_kernels(context.instructions).propagate(motion)};
  };
  return find_basins_by(propagate, moving.loop, states, limits, tiles_on(context));
}
auto basins_of(const SampledModes& moving, const JobContext& context, const States& states,
               const OrbitLimits& limits) {
  return find_basins(moving.loop, states, limits, tiles_on(context));
}
auto basins_of(const BuiltMasses& moving, const JobContext& context, const States& states,
               const OrbitLimits& limits) {
  const auto tiles = tiles_on(context);
  if (!has_event_pack(moving.loop)) return find_basins(moving.loop, states, limits, tiles);
  return find_basins_by(pack_kernels(context.instructions).run_on_lanes, moving.loop, states,
                        limits, tiles);
}
auto basins_of(const BuiltPlant& moving, const JobContext& context, const States& states,
               const OrbitLimits& limits) {
  const auto begin = [&](const auto& seen) { return modal_state_of(context.case_data, seen); };
  return find_basins(moving.loop, states, limits, tiles_on(context), begin);
}

/// Options of the job basins. A row of its table has the number of the attractor, from 1 in order
/// of first appearance; 0 where the motion diverges, −1 where no orbit is found; and the period.
struct BasinsQuestion {
  std::vector<std::string> axes;          ///< two KEY=MIN:MAX:COUNT over initial.*
  std::vector<std::string> map;           ///< two KEY=MIN:MAX:COUNT: cells in place of states
  std::int64_t largest_period = 100'000;  ///< longest period searched (samples)
  bool fractions = false;  ///< a row for each attractor instead of one for each state
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--axis", axes);
    job.add("--max-period", largest_period);
    job.add("--fractions", fractions);
    job.add("--map", map);
    job.add("--switching", switching);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    if (!map.empty()) {
      const auto more = axes.empty() ? States{} : states_of(context, grid_of(axes));
      return write_motion_cells(context, {map, largest_period, switching, more});
    }
    const KeyGrid grid = grid_of(axes);
    const States states = states_of(context, grid);
    report_warning(dense_work_warning(the_case, switching), context.quiet);
    std::visit(
        [&](const auto& moving) {
          require_attractors(forcing_ratio(clock_of(moving)), largest_period);
          const auto found = basins_of(moving, context, states, search_limits());
          fractions ? write_fractions(context, found) : write_states(context, grid, found);
        },
        smooth_loop_of(the_case, switching));
  }

 private:
  static States states_of(const JobContext& context, const KeyGrid& grid) {
    for (const KeyAxis& axis : {grid.slow, grid.fast}) require_admissible_ends(axis, context);
    States all;
    Case changed = context.case_data;
    for (std::int64_t row = 0; row < grid.slow.axis.count; ++row) {
      set_case_value(changed, grid.slow.key, grid.slow.axis.at(row));
      for (std::int64_t column = 0; column < grid.fast.axis.count; ++column) {
        set_case_value(changed, grid.fast.key, grid.fast.axis.at(column));
        all.push_back(initial_state_of(changed));
      }
    }
    return all;
  }

  OrbitLimits search_limits() const { return {largest_period, 0, throw_if_interrupted}; }
};

}  // namespace

void add_basins(CLI::App& program) { add_job<BasinsQuestion>(program, "basins"); }

}  // namespace holdfast::program
