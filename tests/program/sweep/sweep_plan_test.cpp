#include "sweep/sweep_plan.hpp"
#include "case/case_file.hpp"
#include "case/model/loop_of_case.hpp"
#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"
#include "sweep/sweep_metric.hpp"

namespace holdfast::program {
namespace {

JobContext sweep_context(const std::vector<std::string>& settings = {}) {
  JobContext context;
  context.job = "sweep";
  context.case_source.overrides = settings;
  context.case_data = load_case(std::nullopt, settings);
  return context;
}

SweepOptions sweep_over(std::vector<std::string> axes) {
  SweepOptions options;
  options.axes = std::move(axes);
  return options;
}

std::string refusal_of(const SweepOptions& options) {
  return tests::message_of<WrongInput>([&] { SweepPlan(sweep_context(), options); });
}

TEST(SweepPlan, NumbersItsCellsWithTheFirstAxisSlowest) {
  const SweepPlan plan(sweep_context(),
                       sweep_over({"control.sampling_period=0.001,0.002,0.004",
                                   "backlash.width=0:0.003:4", "excitation.frequency=log:5:20:3"}));
  ASSERT_EQ(plan.cells(), 36);
  std::int64_t cell = 0;
  for (const double period : {0.001, 0.002, 0.004}) {
    for (const double width : {0.0, 0.001, 0.002, 0.003}) {
      for (const double frequency : {5.0, 10.0, 20.0}) {
        const Case the_case = plan.case_of(cell++);
        EXPECT_EQ(the_case.control.sampling_period, period);
        EXPECT_NEAR(the_case.backlash.width, width, 1e-18);
        EXPECT_NEAR(the_case.excitation.frequency, frequency, 1e-13);
        EXPECT_EQ(the_case.control.differential_gain, -13.0);
      }
    }
  }
}

TEST(SweepPlan, CountsTheSamplesOfItsMotions) {
  SweepOptions options = sweep_over({"control.sampling_period=0.001,0.01", "backlash.width=0,1"});
  options.duration = 2.0;
  EXPECT_EQ(SweepPlan(sweep_context(), options).samples(), 2.0 * (2001.0 + 201.0));
}

TEST(SweepPlan, TunesTheProportionalGainOfEveryCell) {
  const SweepPlan plan(sweep_context({"control.proportional_gain=tuned"}),
                       sweep_over({"excitation.frequency=5,10"}));
  const TwoMass<double> plant = plant_of(plan.case_of(0));
  for (const std::int64_t cell : {0, 1}) {
    const double frequency = cell == 0 ? 5.0 : 10.0;
    EXPECT_EQ(gains_of(plan.case_of(cell)).proportional,
              tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency));
  }
}

SweepOptions sweep_for(std::vector<std::string> metrics) {
  SweepOptions options = sweep_over({"backlash.width=0,1"});
  options.metrics = std::move(metrics);
  return options;
}

SweepOptions best_gain_over(const std::string& axis, double duration) {
  SweepOptions options = sweep_over({axis});
  options.best_gain = true;
  options.duration = duration;
  return options;
}

TEST(SweepPlan, RefusesWhatNoCellCouldHave) {
  const std::vector<std::pair<SweepOptions, const char*>> refused = {
      {sweep_over({}), "at least one"},
      {sweep_over({"backlash.widht=0,1"}), "backlash.width"},
      {sweep_over({"backlash.law=0,1"}), "has no numbers as values"},
      {sweep_over({"wind.speed=1,2"}), "no [wind]"},
      {sweep_over({"backlash.width=0,1", "backlash.width=2,3"}), "twice"},
      {sweep_over({"initial.z1=0:1:1000000000", "initial.z2=0:1:1000000000"}), "2^53"},
      {sweep_for({"steady_peek"}), "steady_peak"},
      {sweep_for({"steady_rms", "steady_rms"}), "twice"},
      // The best gain takes the place of another, and needs time to settle.
      {best_gain_over("control.differential_gain=-20,-10", 20.0), "remove that --axis"},
      {best_gain_over("backlash.width=0,1", 0.0), "--duration"}};
  for (const auto& [options, words] : refused)
    EXPECT_NE(refusal_of(options).find(words), std::string::npos) << words;
}

TEST(SweepPlan, AValueThatItsKeyDoesNotAdmitIsAFaultOfItsCellAlone) {
  const SweepPlan plan(sweep_context(), sweep_over({"control.sampling_period=0.001,-1"}));
  EXPECT_NO_THROW(plan.case_of(0));
  EXPECT_THROW(plan.case_of(1), WrongInput);
}

TEST(SweepPlan, PlanOfTheStoreTellsAllThatTheyDependOn) {
  const SweepOptions options = sweep_over({"backlash.width=0,1"});
  const auto entries = [&](const std::vector<std::string>& settings, const SweepOptions& asked) {
    return SweepPlan(sweep_context(settings), asked).store().plan;
  };
  const auto usual = entries({}, options);
  EXPECT_EQ(usual, entries({}, options));
  EXPECT_EQ(usual, entries({"control.differential_gain=-13"}, options));
  EXPECT_NE(usual, entries({"control.differential_gain=-12.999999999999998"}, options));
  EXPECT_NE(usual, entries({"excitation.hold=exact"}, options));
  EXPECT_NE(usual, entries({"control.proportional_gain=tuned"}, options));
  std::vector<SweepOptions> others(6, options);
  others[0].axes = {"backlash.width=0,1.0000001"};
  others[1].metrics = {"steady_rms"};
  others[2].duration = 20.000000000000004;
  others[3].largest_period = 99'999;
  others[4].best_gain = true;
  others[5].chunk_cells = 1;
  for (const SweepOptions& other : others) EXPECT_NE(usual, entries({}, other));
}

TEST(SweepPlan, PlanOfCellsWithTheirOwnPlantsTellsWhatTheyAreReducedFrom) {
  const SweepOptions options = sweep_over({"conductor.sag=0.285,0.29"});
  const auto entries = [&](const std::vector<std::string>& settings) {
    return SweepPlan(sweep_context(settings), options).store().plan;
  };
  // The value of the built-in case, but given: the plant is no longer reduced.
  EXPECT_NE(entries({}), entries({"plant.conductor_mass=0.0767"}));
  JobContext of_file = sweep_context();
  of_file.case_source.text = "[conductor]\n";
  EXPECT_NE(entries({}), SweepPlan(of_file, options).store().plan);
}

TEST(SweepPlan, OfAHundredMillionCellsIsMadeAtOnce) {
  const SweepPlan plan(sweep_context(), sweep_over({"backlash.width=0:0.003:10000",
                                                    "control.sampling_period=0.001:0.03:10000"}));
  EXPECT_EQ(plan.cells(), 100'000'000);
  EXPECT_EQ(plan.case_of(99'999'999).backlash.width, 0.003);
  EXPECT_EQ(plan.case_of(99'999'999).control.sampling_period, 0.03);
}

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
