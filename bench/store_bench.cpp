// What it costs to keep a sweep: the cells of a store computed and thrown away beside the same
// cells computed and written, compressed and looked at in the end, on the same threads. The two
// alternate in one run; the medians and their ratio are printed, and how many bytes a cell has on
// the disk.
//
//     store_bench [FOLDER [SIDE [DURATION [REPETITIONS]]]]
//
// The grid is SIDE times SIDE cells of backlash and differential gain, DURATION seconds each.
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "case/case_file.hpp"
#include "kernels/instruction_set.hpp"
#include "medians.hpp"
#include "output/row_blocks.hpp"
#include "process/exit.hpp"
#include "sweep/sweep_plan.hpp"

namespace {

using namespace holdfast::program;
namespace fs = std::filesystem;

JobContext context_for(const fs::path& output) {
  JobContext context;
  context.job = "sweep";
  context.case_data = load_case(std::nullopt, {});
  context.instructions = chosen_instruction_set("");
  context.on_packs = true;
  context.quiet = true;
  context.output = output;
  return context;
}

SweepOptions sweep_of(const std::string& side, double duration) {
  SweepOptions options;
  options.axes = {"backlash.width=0:0.003:" + side, "control.differential_gain=-20:0:" + side};
  options.duration = duration;
  return options;
}

/// One chunk after the other to whichever thread is free, as a store is filled.
void compute_all(const SweepPlan& plan) {
  const ChunkGrid& grid = plan.grid();
  const auto threads = static_cast<std::int64_t>(std::thread::hardware_concurrency());
  std::atomic<std::int64_t> next{0};
  parallel_rows(threads, 1, static_cast<int>(threads), 0, [&](int&, std::int64_t, std::int64_t) {
    for (std::int64_t chunk = next++; chunk < grid.chunks(); chunk = next++)
      compute_cells(plan, grid.first_cell(chunk), grid.cells_of(chunk));
  });
}

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

void compare(const fs::path& folder, const std::string& side, double duration, int repetitions) {
  const fs::path output = folder / "store_bench.zarr";
  const JobContext context = context_for(output);
  const SweepOptions options = sweep_of(side, duration);
  const SweepPlan plan(context, options);
  const auto cells = static_cast<double>(plan.cells());
  double bytes = 0.0;
  const auto write = [&] {
    fs::remove_all(output);
    write_sweep(context, options);
    bytes = static_cast<double>(bytes_in(output));
  };
  const auto times = holdfast::bench::medians({[&] { compute_all(plan); }, write}, repetitions);
  std::printf("%.0f cells of %g s, %lld chunks of %lld\n", cells, duration,
              static_cast<long long>(plan.grid().chunks()),
              static_cast<long long>(plan.grid().cells_of_file()));
  std::printf("computed alone  %8.2f s  %8.3g cells/s\n", times[0], cells / times[0]);
  std::printf("into a store    %8.2f s  %8.3g cells/s  %.3f of it  %.1f B a cell\n", times[1],
              cells / times[1], times[0] / times[1], bytes / cells);
  fs::remove_all(output);
}

}  // namespace

int main(int count, char** words) {
  return run_guarded([&] {
    const auto word = [&](int place, const char* usual) {
      return std::string(count > place ? words[place] : usual);
    };
    compare(word(1, "."), word(2, "1000"), std::stod(word(3, "0.1")), std::stoi(word(4, "3")));
    return exit_code::done;
  });
}
