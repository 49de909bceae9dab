#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

namespace holdfast::bench {

/// How often each side is timed.
inline constexpr int usual_repetitions = 7;

/// Seconds of each side, medians over `repetitions` in which the sides alternate.
inline std::vector<double> medians(const std::vector<std::function<void()>>& sides,
                                   int repetitions = usual_repetitions) {
  std::vector<std::vector<double>> times(sides.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t side = 0; side < sides.size(); ++side) {
      const auto start = std::chrono::steady_clock::now();
      sides[side]();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      times[side].push_back(time.count());
    }
  }
  std::vector<double> result;
  for (auto& of_side : times) {
    const auto middle = of_side.begin() + repetitions / 2;
    std::nth_element(of_side.begin(), middle, of_side.end());
    result.push_back(*middle);
  }
  return result;
}

}  // namespace holdfast::bench
