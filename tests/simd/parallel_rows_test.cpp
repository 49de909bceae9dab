#include "holdfast/simd/parallel_rows.hpp"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(ParallelRows, DoesEveryRowOnceAndHandsExceptionsOut) {
  for (const std::int64_t rows : {0, 1, 31, 32, 33, 200}) {
    std::vector<int> done(static_cast<std::size_t>(rows), 0);
    simd::parallel_rows(rows, 32, 2, 0, [&done](int, std::int64_t first, std::int64_t count) {
      EXPECT_EQ(first % 32, 0);
      for (std::int64_t row = first; row < first + count; ++row) {
        ++done[static_cast<std::size_t>(row)];
      }
    });
    for (const int times : done) EXPECT_EQ(times, 1);
  }
  const auto fails = [](int, std::int64_t, std::int64_t) { throw std::runtime_error("no"); };
  EXPECT_THROW(simd::parallel_rows(5, 1, 2, 0, fails), std::runtime_error);
}

}  // namespace
}  // namespace holdfast
