// The tests of the properties rest on this: that a broken property is found and told by a simple
// case.
#include "support/property.hpp"

#include <gtest/gtest-spi.h>

namespace holdfast::test {
namespace {

struct Sum {
  double first = 0.0, second = 0.0;
  int count = 0;

  std::vector<Parameter> parameters() {
    return {{"first (m)", &first, 1.0}, {"second (m)", &second}, {"count", &count}};
  }
};

Sum random_sum(Random& random) {
  return {random.log_uniform(1.0, 1e6), random.uniform(-100.0, 100.0),
          static_cast<int>(random.index(1000))};
}

TEST(Property, ThatHoldsIsTriedAsOftenAsAskedFor) {
  const auto tally = for_all(1, 500, random_sum, [](const Sum& sum) {
    if (sum.second < 0.0) return does_not_apply();
    return sum.first + sum.second >= sum.first ? holds() : fails("smaller");
  });
  EXPECT_EQ(tally.held + tally.did_not_apply, 500);
  EXPECT_GT(tally.held, 150);
  EXPECT_GT(tally.did_not_apply, 150);
}

TEST(Property, ThatIsBrokenIsToldByASimpleCase) {
  PropertyTally tally;
  const auto found = find_counterexample(
      2, 1000, random_sum,
      [](const Sum& sum) {
        return sum.first > 50.0 && sum.count > 20 ? fails("too large") : holds();
      },
      tally);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->what, "too large");
  EXPECT_GT(found->shrunk.first, 50.0);
  EXPECT_LE(found->shrunk.first, 50.0 * 50.0);
  EXPECT_EQ(found->shrunk.first, detail::rounded_to(found->shrunk.first, 1));
  EXPECT_EQ(found->shrunk.second, 0.0);
  EXPECT_GT(found->shrunk.count, 20);
  EXPECT_LE(found->shrunk.count, 42);
  EXPECT_GT(found->drawn.first, 50.0);
}

TEST(Property, DrawsDoNotDependOnThoseBeforeThem) {
  std::vector<double> all;
  for_all(3, 10, random_sum, [&](const Sum& sum) {
    all.push_back(sum.first);
    return holds();
  });
  Random random = detail::random_of_draw(3, 7);
  EXPECT_EQ(random_sum(random).first, all[7]);
  EXPECT_NE(all[6], all[7]);
}

TEST(Property, AnExceptionBreaksItButIsNotShrunkTo) {
  PropertyTally tally;
  const auto throwing = find_counterexample(
      4, 10, random_sum,
      [](const Sum&) -> PropertyOutcome { throw std::runtime_error("no answer"); }, tally);
  ASSERT_TRUE(throwing.has_value());
  EXPECT_EQ(throwing->what, "threw: no answer");
  EXPECT_EQ(throwing->shrunk.first, 1.0);

  const auto wrong = find_counterexample(
      4, 10, random_sum,
      [](const Sum& sum) -> PropertyOutcome {
        if (sum.count == 0) throw std::runtime_error("refused");
        return fails("wrong");
      },
      tally);
  ASSERT_TRUE(wrong.has_value());
  EXPECT_EQ(wrong->what, "wrong");
  EXPECT_NE(wrong->shrunk.count, 0);
}

TEST(Property, AFailureNamesSeedDrawAndNumbersInFullPrecision) {
  EXPECT_NONFATAL_FAILURE(
      for_all(5, 10, random_sum,
              [](const Sum& sum) { return sum.first > 2.0 ? fails("more than two") : holds(); }),
      "seed 5, draw 0: more than two");
  EXPECT_EQ(written_out(Sum{0.1, -3.0, 7}),
            "  first (m) = 0.10000000000000001\n  second (m) = -3\n  count = 7\n");
}

}  // namespace
}  // namespace holdfast::test
