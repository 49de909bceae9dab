#include "sweep/sweep_metric.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

std::vector<SweepMetric> all_metrics() {
  std::vector<SweepMetric> all;
  for (int code = 0; code <= static_cast<int>(SweepMetric::outcome); ++code)
    all.push_back(static_cast<SweepMetric>(code));
  return all;
}

TEST(SweepMetric, IsFoundByTheNameOfItsColumn) {
  for (const SweepMetric metric : all_metrics()) {
    EXPECT_EQ(metric_named(metric_column(metric).column.name), metric);
    EXPECT_NE(metric_names().find(metric_column(metric).column.name), std::string::npos);
  }
  const std::string message = tests::message_of<WrongInput>([] { metric_named("force_pek"); });
  EXPECT_NE(message.find("did you mean force_peak"), std::string::npos) << message;
}

TEST(SweepMetric, RatioIsOverTheUncontrolledPeak) {
  CellResult cell;
  cell.outcome = CellOutcome::computed;
  cell.motion.steady_peak = 0.003;
  cell.uncontrolled_peak = 0.004;
  EXPECT_EQ(metric_value(SweepMetric::ratio_to_uncontrolled, cell), 0.75);
  EXPECT_EQ(metric_value(SweepMetric::attenuates, cell), 1.0);
  cell.uncontrolled_peak = 0.003;
  EXPECT_EQ(metric_value(SweepMetric::attenuates, cell), 0.0);
  cell.motion.steady_peak = cell.uncontrolled_peak = 0.0;  // no force: nothing to attenuate
  EXPECT_EQ(metric_value(SweepMetric::attenuates, cell), 0.0);
}

TEST(SweepMetric, OfAnInadmissibleCellIsNoNumberAndSaysSo) {
  const CellResult cell;
  for (const SweepMetric metric : all_metrics()) {
    const CellColumn& column = metric_column(metric);
    const double value = metric_value(metric, cell);
    if (column.column.datatype == "double") {
      EXPECT_TRUE(std::isnan(value));
    } else if (column.column.datatype == "integer") {
      EXPECT_EQ(value, 0.0);
    } else {
      EXPECT_EQ(column.words.at(static_cast<std::size_t>(value)), "invalid");
    }
  }
}

TEST(SweepMetric, WordsAreThoseOfTheirCodes) {
  CellResult cell;
  cell.outcome = CellOutcome::computed;
  const auto word_of = [&](SweepMetric metric) {
    return metric_column(metric).words.at(static_cast<std::size_t>(metric_value(metric, cell)));
  };
  for (const auto kind :
       {AttractorType::periodic, AttractorType::quasi_periodic, AttractorType::chaotic,
        AttractorType::diverges, AttractorType::undecided}) {
    cell.kind = kind;
    EXPECT_EQ(word_of(SweepMetric::verdict),
              attractor_type_text(kind).substr(0, attractor_type_text(kind).find('(')));
  }
  cell.kind = AttractorType::irregular_contracting;
  EXPECT_EQ(word_of(SweepMetric::verdict), "irregular");
  EXPECT_EQ(word_of(SweepMetric::outcome), "computed");
  cell.outcome = CellOutcome::diverges;
  EXPECT_EQ(word_of(SweepMetric::verdict), "diverges");
  EXPECT_EQ(word_of(SweepMetric::outcome), "diverges");
}

}  // namespace
}  // namespace holdfast::program
