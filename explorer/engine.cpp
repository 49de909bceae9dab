// What the page of the explorer calls beside main(): numbers in memory where a table would be too
// slow for the hand. The case is the file that every call of main() is given too, with the same
// --set lines. Each gives the program's exit code; what is wrong stands on standard error.

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "case/case_file.hpp"
#include "case/model/resolved_plant.hpp"
#include "explorer/live_charts.hpp"
#include "io/file/output.hpp"
#include "process/exit.hpp"

namespace {

using namespace holdfast;
using namespace holdfast::program;

/// @param settings  KEY=VALUE, a line each
Case case_as_given(const char* settings) {
  std::vector<std::string> overrides;
  std::istringstream lines(settings);
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);
  return load_case("/case.toml", overrides);
}

Case case_of_page(const char* settings) {
  Case the_case = case_as_given(settings);
  settle_plant(the_case);
  return the_case;
}

}  // namespace

extern "C" {

/// @param cells  p_count times d_count, P slowest: 1 where the loop is stable
int holdfast_stable_cells(const char* settings, double p_min, double p_max, int p_count,
                          double d_min, double d_max, int d_count, std::uint8_t* cells) {
  return run_guarded([&] {
    const GainGrid grid{{p_min, p_max, p_count}, {d_min, d_max, d_count}};
    const std::vector<std::uint8_t> computed = stable_cells(case_of_page(settings), grid);
    std::copy(computed.begin(), computed.end(), cells);
    return exit_code::done;
  });
}

/// @param rows  count times frequency (Hz), amplitude with control and without (m); at last 1 where
///              the loop is stable
int holdfast_amplitudes(const char* settings, double f_min, double f_max, int count, double* rows) {
  return run_guarded([&] {
    const Amplitudes amplitudes = amplitudes_over(case_of_page(settings), {f_min, f_max, count});
    for (const AmplitudesAt& at : amplitudes.at) {
      *rows++ = at.frequency;
      *rows++ = at.controlled;
      *rows++ = at.uncontrolled;
    }
    *rows = amplitudes.stable ? 1.0 : 0.0;
    return exit_code::done;
  });
}

/// Writes the whole case as a case file.
int holdfast_save_case(const char* settings, const char* file) {
  return run_guarded([&] {
    OutputFile output(std::filesystem::path{file});
    output.write(case_to_toml(case_as_given(settings)));
    output.commit();
    return exit_code::done;
  });
}

// What the C library of emscripten declares and does not have; nobody waits for either here.
int pthread_kill(pthread_t, int) { return -1; }
int sched_getaffinity(pid_t, size_t, cpu_set_t*) { return -1; }
}
