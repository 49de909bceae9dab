#include "jobs/charts/chart_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "jobs/charts/row_blocks.hpp"
#include "jobs/columns.hpp"
#include "kernels/pack_kernels.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

/// Values in a row of a chart. Whole rows are held in memory, and between two of them a signal is
/// looked for, hence not any number of them.
std::size_t row_length(std::int64_t columns) {
  constexpr std::int64_t most = 1000000;
  if (columns > most)
    throw WrongInput("a row of the chart would have " + std::to_string(columns) +
                     " values: at most " + std::to_string(most) +
                     " along the second axis, any number along the first");
  return static_cast<std::size_t>(columns);
}

/// Rows that a thread takes at a time. It depends on the chart alone, as the results may not depend
/// on the number of threads.
std::int64_t rows_of_tile(std::int64_t columns) { return columns <= 65536 ? 32 : 8; }

/// Rows that are held in memory: many tiles, so that no thread waits long for the last one, but no
/// more than some tens of megabytes where rows are of a usual length.
std::int64_t rows_of_block(std::int64_t columns) {
  const std::int64_t tiles = (std::int64_t{1} << 21) / (columns * rows_of_tile(columns));
  return rows_of_tile(columns) * std::clamp(tiles, std::int64_t{1}, std::int64_t{16});
}

/// Where rows of a chart are computed: flags, then columns of numbers.
struct RowsInMemory {
  std::size_t columns;
  std::uint8_t* first_flags;
  std::vector<double*> first_numbers;

  std::uint8_t* flags(std::int64_t row) const { return first_flags + start(row); }
  double* numbers(std::size_t column, std::int64_t row) const {
    return first_numbers[column] + start(row);
  }
  std::size_t start(std::int64_t row) const { return static_cast<std::size_t>(row) * columns; }
};

/// The values of a block of rows: flags, then as many columns of numbers as the chart has.
class Block {
 public:
  Block(std::int64_t columns, std::size_t number_columns)
      : columns_(row_length(columns)),
        flags_(columns_ * static_cast<std::size_t>(rows_of_block(columns))),
        numbers_(number_columns, std::vector<double>(flags_.size())) {}

  RowsInMemory rows() {
    RowsInMemory rows{columns_, flags_.data(), {}};
    for (std::vector<double>& numbers : numbers_) rows.first_numbers.push_back(numbers.data());
    return rows;
  }

  std::int64_t columns() const { return static_cast<std::int64_t>(columns_); }

  void append_to(GridOutput& output, std::int64_t rows) const {
    std::vector<double> stable(flags_.size());
    std::transform(flags_.begin(), flags_.end(), stable.begin(),
                   [](std::uint8_t flag) { return flag != 0 ? 1.0 : 0.0; });
    std::vector<const double*> values = {stable.data()};
    for (const std::vector<double>& numbers : numbers_) values.push_back(numbers.data());
    output.append(rows * columns(), values);
  }

 private:
  std::size_t columns_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<double>> numbers_;
};

/// Computes and appends all rows block by block: `compute(kernel, first, count, offset, rows)` on
/// many threads, `offset` being the first row's place in memory. Throws Interrupted.
template <class Kernel, class Compute>
void append_rows(const JobContext& context, std::int64_t rows, Block block, const Kernel& kernel,
                 GridOutput& output, const Compute& compute) {
  Progress progress(static_cast<std::uint64_t>(rows), context.job, progress_wanted(context));
  const std::int64_t block_rows = rows_of_block(block.columns());
  const RowsInMemory in_memory = block.rows();
  for (std::int64_t begin = 0; begin < rows; begin += block_rows) {
    throw_if_interrupted();
    const std::int64_t count = std::min(block_rows, rows - begin);
    parallel_rows(count, rows_of_tile(block.columns()), context.threads, kernel,
                  [&](Kernel& own, std::int64_t first, std::int64_t tile) {
                    if (!interrupted()) compute(own, begin + first, tile, first, in_memory);
                  });
    throw_if_interrupted();
    block.append_to(output, count);
    progress.advance(static_cast<std::uint64_t>(count));
  }
}

/// Computes all rows where they are wanted, in the tiles in which append_rows() does. Throws
/// Interrupted.
template <class Kernel, class Compute>
void fill_rows(const ChartWork& work, std::int64_t rows, const RowsInMemory& in_memory,
               const Kernel& kernel, const Compute& compute) {
  const auto columns = static_cast<std::int64_t>(in_memory.columns);
  row_length(columns);
  Progress progress(static_cast<std::uint64_t>(rows), "stability", false);
  parallel_rows(rows, rows_of_tile(columns), work.threads, kernel,
                [&](Kernel& own, std::int64_t first, std::int64_t tile) {
                  if (!interrupted()) compute(own, first, tile, first, in_memory);
                  progress.advance(static_cast<std::uint64_t>(tile));
                });
  throw_if_interrupted();
}

using SampledKernel = CopiedKernel<ChartKernel>;

SampledKernel sampled_kernel(InstructionSet instructions, const LoopChart& chart, bool radius) {
  return SampledKernel(pack_kernels(instructions).chart(chart, radius));
}

void compute_sampled(SampledKernel& own, std::int64_t first, std::int64_t count,
                     std::int64_t offset, const RowsInMemory& rows) {
  own->fill(first, count, rows.flags(offset),
            rows.first_numbers.empty() ? nullptr : rows.numbers(0, offset));
}

using ModalKernel = std::optional<ModalRadius>;

ModalKernel modal_kernel(const Case& the_case, bool radius) {
  return radius ? ModalKernel(the_case) : ModalKernel();
}

/// What computes rows of a modal case.
auto modal_rows(const ResolvedCircle<double>& circle, const GainGrid& grid) {
  return [&circle, &grid](ModalKernel& own, std::int64_t first, std::int64_t count,
                          std::int64_t offset, const RowsInMemory& rows) {
    for (std::int64_t row = 0; row < count; ++row) {
      fill_stability_row(circle, grid.proportional.at(first + row), grid.differential,
                         rows.flags(offset + row));
      for (std::int64_t j = 0; own && j < grid.differential.count && !interrupted(); ++j)
        rows.numbers(0, offset + row)[j] = (*own)(grid.at(first + row, j));
    }
  };
}

}  // namespace

void fill_chart(const Case& the_case, const GainGrid& grid, const ChartCells& cells,
                const ChartWork& work) {
  RowsInMemory rows{static_cast<std::size_t>(grid.differential.count), cells.stable, {}};
  const bool radius = cells.radius != nullptr;
  if (radius) rows.first_numbers.push_back(cells.radius);
  if (is_modal(the_case)) {
    const ResolvedCircle<double> circle = circle_of(the_case);
    fill_rows(work, grid.proportional.count, rows, modal_kernel(the_case, radius),
              modal_rows(circle, grid));
  } else {
    const LoopChart chart = chart_over_gains(the_case, grid);
    fill_rows(work, grid.proportional.count, rows, sampled_kernel(work.instructions, chart, radius),
              compute_sampled);
  }
}

std::vector<GridAxis> gain_axes(const GainGrid& grid) {
  const std::vector<Column> columns = columns_of("gain axes");
  return {{columns[0], grid.proportional}, {columns[1], grid.differential}};
}

LoopChart chart_over_gains(const Case& the_case, const GainGrid& grid) {
  return {operating_point_of(the_case),
          {LoopParameter::proportional_gain, grid.proportional},
          {LoopParameter::differential_gain, grid.differential}};
}

void append_sampled_chart(const JobContext& context, const LoopChart& chart, bool radius,
                          GridOutput& output) {
  append_rows(context, chart.slow.values.count, Block(chart.fast.values.count, radius ? 1 : 0),
              sampled_kernel(context.instructions, chart, radius), output, compute_sampled);
}

void append_modal_chart(const JobContext& context, const GainGrid& grid, bool radius,
                        GridOutput& output) {
  const ResolvedCircle<double> circle = circle_of(context.case_data);
  append_rows(context, grid.proportional.count, Block(grid.differential.count, radius ? 1 : 0),
              modal_kernel(context.case_data, radius), output, modal_rows(circle, grid));
}

void append_continuous_chart(const JobContext& context, const TwoMass<double>& plant,
                             const GainGrid& grid, bool abscissa, GridOutput& output) {
  using Kernel = StabilityRows<4>;
  const auto abscissa_at = [&](const PdGains<double>& gains) {
    const Matrix<double, 4> closed =
        plant.state_matrix() + plant.control_input() * gains.feedback_row();
    return spectral_abscissa<double, 4>(closed);
  };
  append_rows(context, grid.proportional.count, Block(grid.differential.count, abscissa ? 1 : 0),
              Kernel(characteristic_polynomial(plant), grid.differential), output,
              [&](Kernel& own, std::int64_t first, std::int64_t count, std::int64_t offset,
                  const RowsInMemory& block) {
                for (std::int64_t row = 0; row < count; ++row) {
                  own.fill(grid.proportional.at(first + row), block.flags(offset + row));
                  if (!abscissa) continue;
                  double* values = block.numbers(0, offset + row);
                  for (std::int64_t j = 0; j < grid.differential.count; ++j) {
                    values[j] = abscissa_at(grid.at(first + row, j));
                  }
                }
              });
}

void append_response_chart(const JobContext& context, const SteadyResponse<double>& response,
                           double force_amplitude, const GainGrid& grid, GridOutput& output) {
  // @param fill  (kernel, P, flags): the stable cells of a row
  const auto append = [&](const auto& kernel, const auto& fill) {
    append_rows(context, grid.proportional.count, Block(grid.differential.count, 2), kernel, output,
                [&](auto& own, std::int64_t first, std::int64_t count, std::int64_t offset,
                    const RowsInMemory& block) {
                  for (std::int64_t row = offset; row < offset + count; ++row) {
                    const std::int64_t i = first + row - offset;
                    fill(own, grid.proportional.at(i), block.flags(row));
                    for (std::int64_t j = 0; j < grid.differential.count; ++j) {
                      const bool stable = block.flags(row)[j] != 0;
                      constexpr double none = std::numeric_limits<double>::quiet_NaN();
                      const PdGains<double> gains = grid.at(i, j);
                      block.numbers(0, row)[j] =
                          stable ? force_amplitude * response.amplitude_per_force(gains) : none;
                      block.numbers(1, row)[j] =
                          stable ? response.ratio_to_uncontrolled(gains) : none;
                    }
                  }
                });
  };
  if (is_modal(context.case_data)) {
    const ResolvedCircle<double> circle = circle_of(context.case_data);
    append(nullptr, [&](std::nullptr_t, double p, std::uint8_t* flags) {
      fill_stability_row(circle, p, grid.differential, flags);
    });
  } else {
    const auto polynomial = characteristic_polynomial(loop_of(context.case_data));
    append(StabilityRows<5>(in_half_plane(polynomial), grid.differential),
           [](StabilityRows<5>& rows, double p, std::uint8_t* flags) { rows.fill(p, flags); });
  }
}

}  // namespace holdfast::program
