// Charts of stable gains and of the spectral radius, cell by cell and by crossings.
// Peer: Eigen's EigenSolver on S, cell by cell. Limits: a loop of independent multiply-adds and
// memset. All sides alternate in one run; the medians and their ratios are printed.
#include <sys/resource.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "holdfast/plant/two_mass.hpp"
#include "holdfast/simd/charts.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "medians.hpp"
#include "processor.hpp"

namespace {

using namespace holdfast;
using bench::medians;
using Pack = simd::Pack<double>;
constexpr std::size_t lanes = Lanes<Pack>::count;

LoopChart chart_of(double delay_fraction, std::int64_t rows, std::int64_t columns) {
  const double period = 0.001;
  return {{kollar2022_plant(), {period, delay_fraction * period}, {-557.0, -13.0}},
          {LoopParameter::proportional_gain, {-1000.0, 200.0, rows}},
          {LoopParameter::differential_gain, {-40.0, 20.0, columns}}};
}

volatile double sink = 0.0;

/// Largest |eigenvalue| of `cells` cells spread over the chart.
void eigen_solver(const LoopChart& chart, std::int64_t cells) {
  const auto loop = sampled_loop(chart.point.plant, chart.point.sampling);
  double sum = 0.0;
  for (std::int64_t k = 0; k < cells; ++k) {
    const PdGains<double> gains{chart.slow.values.at(k * 7919 % chart.slow.values.count),
                                chart.fast.values.at(k * 104729 % chart.fast.values.count)};
    const Eigen::EigenSolver<Matrix<double, 5>> solver(loop.engaged_map(gains), false);
    sum += solver.eigenvalues().cwiseAbs().maxCoeff();
  }
  sink = sum;
}

/// Every cell by Liénard and Chipart's conditions on packs.
void kernel(const LoopChart& chart, std::vector<std::uint8_t>& stable) {
  const ChartPolynomials<5, PolynomialVariable::half_plane> polynomials(
      chart, StabilityChartRows<Pack>::polynomial_of);
  std::vector<double> values;
  for (std::int64_t j = 0; j < polynomials.columns(); ++j)
    values.push_back(chart.fast.values.at(j));
  for (std::int64_t row = 0; row < chart.slow.values.count; ++row) {
    const AffineLine<5> line = polynomials.line(row);
    hurwitz_row<Pack, 6>(line.constant, line.slope, values,
                         stable.data() + row * polynomials.columns());
  }
}

/// Operations of the kernel per pack: 6 multiply-adds for the polynomial, 11 for the conditions, 5
/// comparisons.
constexpr int kernel_operations = 22;

/// As many independent multiply-adds as the kernel has operations on that many cells.
void multiply_adds(std::int64_t cells) {
  const std::int64_t count = cells / static_cast<std::int64_t>(lanes) * kernel_operations / 12;
  Pack a(0.1), b(0.2), c(0.3), d(0.4), e(0.5), f(0.6), g(0.7), h(0.8), i(0.9), j(1.0), k(1.1),
      l(1.2);
  const Pack factor(0.999999), term(1e-7);
  for (std::int64_t n = 0; n < count; ++n) {
    a = a * factor + term, b = b * factor + term, c = c * factor + term, d = d * factor + term;
    e = e * factor + term, f = f * factor + term, g = g * factor + term, h = h * factor + term;
    i = i * factor + term, j = j * factor + term, k = k * factor + term, l = l * factor + term;
  }
  double values[lanes];
  Lanes<Pack>::store(a + b + c + d + e + f + g + h + i + j + k + l, values);
  sink = values[0];
}

void crossings(const LoopChart& chart, std::vector<std::uint8_t>& stable) {
  StabilityChartRows<Pack> rows(chart);
  rows.fill(0, chart.slow.values.count, stable.data());
}

template <int Degree>
void radius(const LoopChart& chart, std::vector<double>& result) {
  using Rows = RadiusChartRows<Pack, Degree>;
  Rows rows(chart);
  for (std::int64_t row = 0; row < chart.slow.values.count; row += Rows::most_rows) {
    rows.fill(row, std::min(Rows::most_rows, chart.slow.values.count - row),
              result.data() + row * chart.fast.values.count);
  }
}

void stable_or_not(double delay_fraction) {
  const std::int64_t side = 4000, cells = side * side, eigen_cells = 20000;
  const LoopChart chart = chart_of(delay_fraction, side, side);
  std::vector<std::uint8_t> stable(static_cast<std::size_t>(cells)), filled(stable), blank(stable);
  const auto time =
      medians({[&] { eigen_solver(chart, eigen_cells); }, [&] { kernel(chart, stable); },
               [&] { multiply_adds(cells); }, [&] { crossings(chart, filled); },
               [&] { std::memset(blank.data(), 1, blank.size()); }});
  const double eigen = time[0] / eigen_cells;
  const auto ns = [&](int which) { return time[static_cast<std::size_t>(which)] / cells * 1e9; };
  std::int64_t differ = 0;
  for (std::size_t k = 0; k < stable.size(); ++k) differ += stable[k] != filled[k];
  std::printf("\nstable or not, 4000 x 4000, delta = %g tau, one core (ns per cell)\n",
              delay_fraction);
  std::printf("  EigenSolver              %10.1f\n", eigen * 1e9);
  std::printf("  kernel on packs          %10.3f   EigenSolver / kernel    %8.0f\n", ns(1),
              eigen * 1e9 / ns(1));
  std::printf("  its multiply-adds alone  %10.3f   kernel / limit          %8.2f\n", ns(2),
              ns(1) / ns(2));
  std::printf("  crossings                %10.3f   kernel / crossings      %8.1f\n", ns(3),
              ns(1) / ns(3));
  std::printf("  memset                   %10.3f   crossings / memset      %8.2f\n", ns(4),
              ns(3) / ns(4));
  std::printf("  cells that differ        %10lld\n", static_cast<long long>(differ));
}

/// Largest error on cells spread over the chart, against the same loop built and solved in extended
/// precision.
double largest_error(const LoopChart& chart, const std::vector<double>& radii, std::int64_t cells) {
  using Precise = long double;
  const TwoMass<double>& p = chart.point.plant;
  const TwoMass<Precise> plant{p.conductor_mass, p.conductor_stiffness, p.conductor_damping,
                               p.absorber_mass,  p.absorber_stiffness,  p.absorber_damping};
  const auto polynomial = characteristic_polynomial(sampled_loop(
      plant,
      Sampling<Precise>{chart.point.sampling.period, chart.point.sampling.processing_delay}));
  double worst = 0.0;
  for (std::int64_t k = 0; k < cells; ++k) {
    const std::int64_t i = k * 7919 % chart.slow.values.count;
    const std::int64_t j = k * 104729 % chart.fast.values.count;
    Precise largest = 0;
    for (const auto& root :
         roots(polynomial.at({chart.slow.values.at(i), chart.fast.values.at(j)}))) {
      largest = std::max(largest, std::abs(Precise(1) + root));
    }
    const double rho = radii[static_cast<std::size_t>(i * chart.fast.values.count + j)];
    const double error = std::abs(static_cast<double>(rho - largest));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

void spectral_radius_chart(double delay_fraction, std::int64_t side) {
  const std::int64_t cells = side * side, eigen_cells = 20000;
  const LoopChart chart = chart_of(delay_fraction, side, side);
  std::vector<double> radii(static_cast<std::size_t>(cells));
  const auto time =
      medians({[&] { eigen_solver(chart, eigen_cells); },
               [&] { delay_fraction > 0 ? radius<6>(chart, radii) : radius<5>(chart, radii); }});
  const double eigen = time[0] / eigen_cells * 1e9,
               ours = time[1] / static_cast<double>(cells) * 1e9;
  std::printf("  %5lld^2  delta = %g tau  EigenSolver %8.1f  ours %8.2f  ratio %6.0f  error %.1e\n",
              static_cast<long long>(side), delay_fraction, eigen, ours, eigen / ours,
              largest_error(chart, radii, 20000));
}

void two_cores() {
  std::printf("\none core and two (ms), 4000 x 4000, delta = tau\n");
  const LoopChart chart = chart_of(1.0, 4000, 4000);
  const auto line = [](const char* name, const std::vector<double>& time) {
    std::printf("  %-12s %10.1f %10.1f   ratio %5.2f\n", name, time[0] * 1e3, time[1] * 1e3,
                time[0] / time[1]);
  };
  const LoopChart delays{chart.point,
                         {LoopParameter::sampling_period, {0.0005, 0.02, 4000}},
                         {LoopParameter::differential_gain, {-40.0, 20.0, 4000}}};
  // One buffer for all: what is measured is the method, not the system handing out memory.
  std::vector<std::uint8_t> flags(4000 * 4000);
  std::vector<double> radii(4000 * 4000);
  const auto stable = [&flags](const LoopChart& of, int threads) {
    return [&flags, of, threads] { simd::stability_chart(of, flags.data(), threads); };
  };
  const auto radius = [&radii, &chart](int threads) {
    return [&radii, &chart, threads] { simd::radius_chart(chart, radii.data(), threads); };
  };
  line("kernel", medians({stable(delays, 1), stable(delays, 2)}));
  line("radius", medians({radius(1), radius(2)}));
  line("crossings", medians({stable(chart, 1), stable(chart, 2)}));
}

/// Largest resident memory so far, bytes.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// The output is one row that is written over and over: what is left is the cost of the method.
void sizes() {
  std::printf("\ncost per cell over the size, one core, delta = tau (ns), and memory (MB)\n");
  std::printf("  %12s %10s %10s %10s %10s\n", "cells", "kernel", "crossings", "radius", "memory");
  for (const std::int64_t side : {32, 100, 316, 1000, 3162, 10000}) {
    const LoopChart chart = chart_of(1.0, side, side);
    const double cells = static_cast<double>(side * side);
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(side));
    std::vector<double> radii(static_cast<std::size_t>(side) * RadiusChartRows<Pack, 6>::most_rows);
    const auto time =
        medians({[&] {
                   const ChartPolynomials<5, PolynomialVariable::half_plane> polynomials(
                       chart, StabilityChartRows<Pack>::polynomial_of);
                   std::vector<double> values;
                   for (std::int64_t j = 0; j < side; ++j)
                     values.push_back(chart.fast.values.at(j));
                   for (std::int64_t row = 0; row < side; ++row) {
                     const AffineLine<5> line = polynomials.line(row);
                     hurwitz_row<Pack, 6>(line.constant, line.slope, values, flags.data());
                   }
                 },
                 [&] {
                   StabilityChartRows<Pack> rows(chart);
                   for (std::int64_t row = 0; row < side; ++row) rows.fill(row, 1, flags.data());
                 },
                 [&] {
                   using Rows = RadiusChartRows<Pack, 6>;
                   Rows rows(chart);
                   for (std::int64_t row = 0; row < side; row += Rows::most_rows) {
                     rows.fill(row, std::min(Rows::most_rows, side - row), radii.data());
                   }
                 }});
    std::printf("  %12.0f %10.3f %10.3f %10.2f %10.1f\n", cells, time[0] / cells * 1e9,
                time[1] / cells * 1e9, time[2] / cells * 1e9, peak_memory() / 1e6);
  }
}

}  // namespace

int main() {
  if (!holdfast::bench::processor_suffices()) return 0;
  std::printf("%zu lanes; medians of %d alternating repetitions\n", lanes,
              bench::usual_repetitions);
  sizes();
  for (const double delay_fraction : {0.0, 1.0}) stable_or_not(delay_fraction);
  std::printf("\nspectral radius, one core (ns per cell), error against extended precision\n");
  for (const std::int64_t side : {1000, 4000}) {
    for (const double delay_fraction : {0.0, 1.0}) spectral_radius_chart(delay_fraction, side);
  }
  two_cores();
}
