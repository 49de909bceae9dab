#include "jobs/charts/chart_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/poly/mobius_zhukovsky.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "jobs/charts/row_blocks.hpp"
#include "kernels/rows_on_packs.hpp"
#include "process/errors.hpp"

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

/// The values of a block of rows: flags, then as many columns of numbers as the chart has.
class Block {
 public:
  Block(std::int64_t columns, std::size_t number_columns)
      : columns_(row_length(columns)),
        flags_(columns_ * static_cast<std::size_t>(rows_of_block(columns))),
        numbers_(number_columns, std::vector<double>(flags_.size())) {}

  std::uint8_t* flags(std::int64_t row) { return flags_.data() + start(row); }
  double* numbers(std::size_t column, std::int64_t row) {
    return numbers_[column].data() + start(row);
  }

  std::int64_t columns() const { return static_cast<std::int64_t>(columns_); }

  void append_to(GridTable& table, std::int64_t rows) {
    for (std::int64_t row = 0; row < rows; ++row) {
      std::vector<GridValues> values = {flags(row)};
      for (std::size_t column = 0; column < numbers_.size(); ++column) {
        values.emplace_back(numbers(column, row));
      }
      table.append_row(values);
    }
  }

 private:
  std::size_t start(std::int64_t row) const { return static_cast<std::size_t>(row) * columns_; }

  std::size_t columns_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<double>> numbers_;
};

/// Computes and appends all rows; `compute(kernel, row, count, offset, block)`.
template <class Kernel, class Compute>
void append_rows(const JobContext& context, std::int64_t rows, Block block, const Kernel& kernel,
                 GridTable& table, const Compute& compute) {
  Progress progress(static_cast<std::uint64_t>(rows), context.job, progress_wanted(context));
  for_row_blocks(
      rows, block.columns(), context.threads, progress, kernel,
      [&](Kernel& own, std::int64_t first, std::int64_t count, std::int64_t offset) {
        compute(own, first, count, offset, block);
      },
      [&](std::int64_t, std::int64_t count) { block.append_to(table, count); });
}

/// Both parts of a chart with the spectral radius.
template <int Degree>
struct RadiusKernels {
  StabilityChartRows<double, HurwitzOnPacks> stability;
  RadiusChartRows<double, Degree, RadiusOnPacks<Degree>> radius;

  RadiusKernels(const LoopChart& chart, const PackKernels& kernels)
      : stability(chart, HurwitzOnPacks(kernels)), radius(chart, RadiusOnPacks<Degree>(kernels)) {}

  void fill(std::int64_t first, std::int64_t count, std::int64_t offset, Block& block) {
    for (std::int64_t row = 0; row < count; ++row) {
      stability.fill(first + row, block.flags(offset + row));
    }
    radius.fill(first, count, block.numbers(0, offset));
  }
};

template <int Degree>
void append_radius_chart(const JobContext& context, const LoopChart& chart, GridTable& table) {
  using Kernels = RadiusKernels<Degree>;
  append_rows(context, chart.slow.values.count, Block(chart.fast.values.count, 1),
              Kernels(chart, pack_kernels(context.instructions)), table,
              [](Kernels& own, std::int64_t first, std::int64_t count, std::int64_t offset,
                 Block& block) { own.fill(first, count, offset, block); });
}

}  // namespace

void append_sampled_chart(const JobContext& context, const LoopChart& chart, bool radius,
                          GridTable& table) {
  if (radius && has_processing_delay(chart)) return append_radius_chart<6>(context, chart, table);
  if (radius) return append_radius_chart<5>(context, chart, table);
  using Kernel = StabilityChartRows<double, HurwitzOnPacks>;
  append_rows(
      context, chart.slow.values.count, Block(chart.fast.values.count, 0),
      Kernel(chart, HurwitzOnPacks(pack_kernels(context.instructions))), table,
      [](Kernel& own, std::int64_t first, std::int64_t count, std::int64_t offset, Block& block) {
        for (std::int64_t row = 0; row < count; ++row) {
          own.fill(first + row, block.flags(offset + row));
        }
      });
}

void append_continuous_chart(const JobContext& context, const TwoMass<double>& plant,
                             const GainGrid& grid, bool abscissa, GridTable& table) {
  using Kernel = StabilityRows<4>;
  const auto abscissa_at = [&](const PdGains<double>& gains) {
    const Matrix<double, 4> closed =
        plant.state_matrix() + plant.control_input() * gains.feedback_row();
    return spectral_abscissa<double, 4>(closed);
  };
  append_rows(
      context, grid.proportional.count, Block(grid.differential.count, abscissa ? 1 : 0),
      Kernel(characteristic_polynomial(plant), grid.differential), table,
      [&](Kernel& own, std::int64_t first, std::int64_t count, std::int64_t offset, Block& block) {
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

void append_response_chart(const JobContext& context, const SampledLoop<double>& loop,
                           const SteadyResponse<double>& response, double force_amplitude,
                           const GainGrid& grid, GridTable& table) {
  using Kernel = StabilityRows<5>;
  const Kernel kernel(characteristic_polynomial(loop).transformed(in_half_plane<double, 6>),
                      grid.differential);
  append_rows(
      context, grid.proportional.count, Block(grid.differential.count, 2), kernel, table,
      [&](Kernel& own, std::int64_t first, std::int64_t count, std::int64_t offset, Block& block) {
        for (std::int64_t row = offset; row < offset + count; ++row) {
          own.fill(grid.proportional.at(first + row - offset), block.flags(row));
          for (std::int64_t j = 0; j < grid.differential.count; ++j) {
            const bool stable = block.flags(row)[j] != 0;
            const double ratio =
                stable ? response.ratio_to_uncontrolled(grid.at(first + row - offset, j))
                       : std::numeric_limits<double>::quiet_NaN();
            block.numbers(0, row)[j] =
                force_amplitude * response.uncontrolled_amplitude_per_force() * ratio;
            block.numbers(1, row)[j] = ratio;
          }
        }
      });
}

}  // namespace holdfast::program
