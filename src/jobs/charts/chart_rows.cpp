#include "jobs/charts/chart_rows.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "io/file/output.hpp"
#include "jobs/columns.hpp"
#include "kernels/pack_kernels.hpp"
#include "output/row_blocks.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "store/fill_store.hpp"
#include "store/stored_grid.hpp"

namespace holdfast::program {
namespace {

/// Number of values in a row of a chart. Throws WrongInput above 10⁶ values: rows are kept whole in
/// memory, and a signal is noticed only between two blocks of rows.
std::size_t row_length(std::int64_t columns) {
  constexpr std::int64_t most = 1000000;
  if (columns > most)
    throw WrongInput("a row of the chart would have " + std::to_string(columns) +
                     " values: give at most " + std::to_string(most) +
                     " along the second axis; the first axis may have any number of values");
  return static_cast<std::size_t>(columns);
}

/// Number of rows in a tile, which one thread computes at a time. It depends on the chart alone, so
/// that the results do not depend on the number of threads.
std::int64_t rows_of_tile(std::int64_t columns) { return columns <= 65536 ? 32 : 8; }

/// Number of rows held in memory at a time: up to 16 tiles, so that no thread waits long for the
/// last tile, but usually not more than some tens of megabytes.
std::int64_t rows_of_block(std::int64_t columns) {
  const std::int64_t tiles = (std::int64_t{1} << 21) / (columns * rows_of_tile(columns));
  return rows_of_tile(columns) * std::clamp(tiles, std::int64_t{1}, std::int64_t{16});
}

/// A block of rows of a chart with its own memory.
class ChartBlock {
 public:
  ChartBlock(const ChartRows& chart, std::int64_t rows)
      : columns_(row_length(chart.columns)),
        flags_(columns_ * static_cast<std::size_t>(rows)),
        numbers_(chart.number_columns, std::vector<double>(flags_.size())) {}

  ChartMemory memory() {
    ChartMemory memory{columns_, flags_.data(), {}};
    for (std::vector<double>& numbers : numbers_) memory.first_numbers.push_back(numbers.data());
    return memory;
  }

  /// The first `rows` rows as one list per column; the stability flags come first, as numbers.
  std::vector<std::vector<double>> values(std::int64_t rows) const {
    const auto end = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(rows) * columns_);
    std::vector<std::vector<double>> all(1);
    std::transform(flags_.begin(), flags_.begin() + end, std::back_inserter(all.front()),
                   [](std::uint8_t flag) { return flag != 0 ? 1.0 : 0.0; });
    for (const std::vector<double>& numbers : numbers_)
      all.emplace_back(numbers.begin(), numbers.begin() + end);
    return all;
  }

 private:
  std::size_t columns_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<double>> numbers_;
};

/// Computes all rows block by block and appends them to the output.
void append_rows(const JobContext& context, const ChartRows& chart, GridOutput& output) {
  Progress progress(static_cast<std::uint64_t>(chart.rows), context.job, progress_wanted(context));
  const std::int64_t block_rows = rows_of_block(chart.columns);
  ChartBlock block(chart, block_rows);
  const ChartMemory memory = block.memory();
  for (std::int64_t begin = 0; begin < chart.rows; begin += block_rows) {
    throw_if_interrupted();
    const std::int64_t count = std::min(block_rows, chart.rows - begin);
    parallel_rows(count, rows_of_tile(chart.columns), context.threads, chart.fill,
                  [&](const auto& fill, std::int64_t first, std::int64_t tile) {
                    if (!interrupted()) fill(begin + first, tile, first, memory);
                  });
    throw_if_interrupted();
    const auto values = block.values(count);
    std::vector<const double*> columns;
    columns.reserve(values.size());
    for (const std::vector<double>& column : values) columns.push_back(column.data());
    output.append(count * chart.columns, columns);
    progress.advance(static_cast<std::uint64_t>(count));
  }
}

/// Number of cells in a chunk: whole tiles of rows, and enough chunks for many cores.
std::size_t cells_of_chunk(const ChartRows& chart) {
  constexpr std::int64_t chunks_wanted = 64, most = values_in_chunk;
  const std::int64_t of_tile = rows_of_tile(chart.columns) * chart.columns;
  const std::int64_t share = std::min(chart.rows * chart.columns / chunks_wanted, most);
  return static_cast<std::size_t>(of_tile * std::max(share / of_tile, std::int64_t{1}));
}

/// Computes `count` rows from row `first` on, in the same tiles as append_rows(): results depend on
/// where tiles begin. `first` must be the first row of a tile.
ChartBlock computed_rows(const ChartRows& chart, std::int64_t first, std::int64_t count) {
  ChartBlock block(chart, count);
  const ChartMemory memory = block.memory();
  const std::int64_t tile = rows_of_tile(chart.columns);
  for (std::int64_t row = 0; row < count; row += tile) {
    throw_if_interrupted();
    auto fill = chart.fill;
    fill(first + row, std::min(tile, count - row), row, memory);
  }
  throw_if_interrupted();
  return block;
}

void fill_chart(const JobContext& context, const StoreDescription& store, const ChartRows& chart) {
  const auto compute = [&](std::int64_t chunk) {
    const std::int64_t rows = store.grid.cells_of(chunk) / chart.columns;
    const std::int64_t first = store.grid.first_cell(chunk) / chart.columns;
    return ChunkResult{computed_rows(chart, first, rows).values(rows)};
  };
  fill_store(context, store, {context.job + ", cells", compute, nullptr, true});
}

}  // namespace

void fill_chart(const ChartRows& chart, const ChartMemory& memory, int threads) {
  row_length(chart.columns);
  Progress progress(static_cast<std::uint64_t>(chart.rows), "stability", false);
  parallel_rows(chart.rows, rows_of_tile(chart.columns), threads, chart.fill,
                [&](const auto& fill, std::int64_t first, std::int64_t tile) {
                  if (!interrupted()) fill(first, tile, first, memory);
                  progress.advance(static_cast<std::uint64_t>(tile));
                });
  throw_if_interrupted();
}

void write_chart(const JobContext& context, const GridLayout& layout, const ChartRows& chart) {
  if (is_store_name(context.output))
    return fill_chart(context, store_description(context, layout, cells_of_chunk(chart)), chart);
  GridOutput output(context, layout);
  append_rows(context, chart, output);
  output.commit();
}

std::vector<GridAxis> gain_axes(const GainGrid& grid) {
  const std::vector<Column> columns = columns_of("gain axes");
  return {{columns[0], grid.proportional}, {columns[1], grid.differential}};
}

ChartRows sampled_chart(const LoopChart& chart, bool radius, InstructionSet instructions) {
  row_length(chart.fast.values.count);  // before kernels make room for it
  const auto fill = [=, kernel = pack_kernels(instructions).chart(chart, radius)](
                        std::int64_t first, std::int64_t count, std::int64_t offset,
                        const ChartMemory& memory) {
    kernel(first, count, memory.flags(offset), radius ? memory.numbers(0, offset) : nullptr);
  };
  return {chart.slow.values.count, chart.fast.values.count, radius ? 1U : 0U, fill};
}

ChartRows stability_chart_of(const Case& the_case, const GainGrid& grid, bool radius,
                             InstructionSet instructions) {
  if (has_closed_forms(the_case))
    return sampled_chart({operating_point_of(the_case),
                          {LoopParameter::proportional_gain, grid.proportional},
                          {LoopParameter::differential_gain, grid.differential}},
                         radius, instructions);
  row_length(grid.differential.count);
  const LinearLoop loop(the_case);
  const auto stable = loop.stable_rows(grid.differential);
  const auto fill = [=](std::int64_t first, std::int64_t count, std::int64_t offset,
                        const ChartMemory& memory) {
    for (std::int64_t row = 0; row < count; ++row) {
      stable(grid.proportional.at(first + row), memory.flags(offset + row));
      for (std::int64_t j = 0; radius && j < grid.differential.count && !interrupted(); ++j)
        memory.numbers(0, offset + row)[j] = loop.radius(grid.at(first + row, j));
    }
  };
  return {grid.proportional.count, grid.differential.count, radius ? 1U : 0U, fill};
}

ChartRows continuous_chart(const TwoMass<double>& plant, const GainGrid& grid, bool abscissa) {
  row_length(grid.differential.count);
  const auto abscissa_at = [plant](const PdGains<double>& gains) {
    return spectral_abscissa<double, 4>(plant.state_matrix() +
                                        plant.control_input() * gains.feedback_row());
  };
  StabilityRows<4> rows(characteristic_polynomial(plant), grid.differential);
  const auto fill = [=](std::int64_t first, std::int64_t count, std::int64_t offset,
                        const ChartMemory& memory) mutable {
    for (std::int64_t row = 0; row < count; ++row) {
      rows.fill(grid.proportional.at(first + row), memory.flags(offset + row));
      for (std::int64_t j = 0; abscissa && j < grid.differential.count; ++j)
        memory.numbers(0, offset + row)[j] = abscissa_at(grid.at(first + row, j));
    }
  };
  return {grid.proportional.count, grid.differential.count, abscissa ? 1U : 0U, fill};
}

ChartRows response_chart(const JobContext& context, const SteadyResponse<double>& response,
                         double force_amplitude, const GainGrid& grid) {
  const auto stable = LinearLoop(context.case_data).stable_rows(grid.differential);
  const auto fill = [=](std::int64_t first, std::int64_t count, std::int64_t offset,
                        const ChartMemory& memory) {
    for (std::int64_t row = 0; row < count; ++row) {
      std::uint8_t* flags = memory.flags(offset + row);
      stable(grid.proportional.at(first + row), flags);
      for (std::int64_t j = 0; j < grid.differential.count; ++j) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const PdGains<double> gains = grid.at(first + row, j);
        memory.numbers(0, offset + row)[j] =
            flags[j] != 0 ? force_amplitude * response.amplitude_per_force(gains) : none;
        memory.numbers(1, offset + row)[j] =
            flags[j] != 0 ? response.ratio_to_uncontrolled(gains) : none;
      }
    }
  };
  return {grid.proportional.count, grid.differential.count, 2, fill};
}

}  // namespace holdfast::program
