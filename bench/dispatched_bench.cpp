// What it costs that the program chooses its kernels when it starts. The same work twice:
// everything compiled for the processor (dispatched_bench_native_SET), and as in the program
// (dispatched_bench_SET), where all around the kernels is compiled for the baseline. Each
// prints nanoseconds of processor time of four computations, medians; tools/bench_dispatch runs the
// two in turn and prints their ratios.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "holdfast/plant/two_mass.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "sweep_cells.hpp"
#ifdef HOLDFAST_BENCH_KERNELS
#include "kernels/pack_kernels.hpp"
#else
#include "holdfast/simd/pack.hpp"
#include "kernels/kernels_on.hpp"
#include "processor.hpp"
#endif

namespace {

using namespace holdfast;

volatile double sink = 0.0;

#ifdef HOLDFAST_BENCH_KERNELS
const program::PackKernels& kernels() { return program::HOLDFAST_BENCH_KERNELS(); }
bool processor_suffices() { return true; }
#else
const program::PackKernels& kernels() { return program::KernelsOn<simd::Pack<double>>::all; }
bool processor_suffices() { return bench::processor_suffices(); }
#endif

class Source final : public program::MotionSource {
 public:
  const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) override {
    return matrices_.of(loop);
  }
  void pause() override {}

 private:
  detail::SweepMatrices matrices_;
};

void metrics(const std::vector<SweepMotion>& motions, double duration,
             std::vector<MotionMetrics>& results) {
  const auto spans = detail::ordered_spans(motions.data(), motions.size(), duration);
  Source source;
  kernels().metrics(motions.data(), spans.data(), motions.size(), results.data(), source);
}

constexpr std::int64_t side = 1000;

LoopChart gains_chart() {
  return {{kollar2022_plant(), {0.01, 0.01}, {}},
          {LoopParameter::proportional_gain, {-1000.0, 200.0, side}},
          {LoopParameter::differential_gain, {-40.0, 20.0, side}}};
}

LoopChart period_chart() {
  return {{kollar2022_plant(), {0.01, 0.0}, {}},
          {LoopParameter::sampling_period, {0.0005, 0.02, side}},
          {LoopParameter::differential_gain, {-40.0, 20.0, side}}};
}

void rows(const LoopChart& chart, bool radius) {
  const auto kernel = kernels().chart(chart, radius);
  constexpr std::int64_t tile = 32;
  std::vector<std::uint8_t> flags(side * tile);
  std::vector<double> radii(side * tile);
  for (std::int64_t k = 0; k < side; k += tile) {
    kernel(k, std::min(tile, side - k), flags.data(), radii.data());
    sink = flags[0] + radii[0];
  }
}

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

template <class Work>
void line(const char* name, double units, const Work& work) {
  constexpr std::size_t repetitions = 5;
  std::vector<double> times;
  for (std::size_t k = 0; k < repetitions; ++k) {
    const double start = processor_time();
    work();
    times.push_back((processor_time() - start) / units);
  }
  std::sort(times.begin(), times.end());
  std::printf("%s %.4f\n", name, times[repetitions / 2]);
}

}  // namespace

int main() {
  if (!processor_suffices()) return 0;
  constexpr double cells = static_cast<double>(side * side);
  line("chart_of_gains", cells, [] { rows(gains_chart(), false); });
  line("chart_cell_by_cell", cells, [] { rows(period_chart(), false); });
  line("radius", cells, [] { rows(gains_chart(), true); });
  const auto motions = bench::sweep_cells();
  std::vector<MotionMetrics> results(motions.size());
  constexpr double duration = 10.0;
  line("trajectory_sample", static_cast<double>(motions.size()) * 10001.0, [&] {
    metrics(motions, duration, results);
    sink = results[0].steady_rms;
  });
}
