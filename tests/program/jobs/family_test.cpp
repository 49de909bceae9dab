#include "jobs/family/family.hpp"

#include <set>

#include "case/uncertain.hpp"
#include "program/case/case_text.hpp"
#include "program/jobs/answer_in_memory.hpp"

namespace holdfast::program {
namespace {

using tests::answer_of, tests::AnswerInMemory;
using Words = std::vector<std::string>;

/// "key=1;other=2" as settings.
Words settings_of(const std::string& member) {
  Words settings;
  for (const std::string_view one : split(member, ';')) settings.emplace_back(one);
  return settings;
}

const Words box = {"uncertain.plant.absorber_mass=± 10 %",
                   "uncertain.control.sampling_period=[0.0005, 0.002]",
                   "uncertain.plant.absorber_damping=± 0.5 N s/m"};

TEST(Family, HasTheMiddleTheCornersAndALatinHypercubeOfItsBox) {
  const Case the_case = load_case(std::nullopt, box);
  const std::vector<UncertainRange> ranges = uncertain_ranges(the_case);
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_NEAR(ranges[0].lowest, 0.144, 1e-12);
  EXPECT_NEAR(ranges[0].highest, 0.176, 1e-12);
  EXPECT_EQ(ranges[1].highest, 0.002);
  EXPECT_EQ(ranges[2].lowest, 3.5);
  const auto members = family_members(the_case, 109);
  ASSERT_EQ(members.size(), 109U);
  std::set<std::string> corners;
  for (std::size_t k = 1; k < 9; ++k) corners.insert(members[k].text());
  EXPECT_EQ(corners.size(), 8U);
  for (std::size_t key = 0; key < ranges.size(); ++key) {
    std::set<int> slices;
    for (std::size_t k = 9; k < members.size(); ++k) {
      const double place = (members[k].values[key].second - ranges[key].lowest) /
                           (ranges[key].highest - ranges[key].lowest);
      slices.insert(static_cast<int>(100.0 * place));
    }
    EXPECT_EQ(slices.size(), 100U);
  }
  EXPECT_EQ(members.back().text(), family_members(the_case, 109).back().text());
  const auto one_range = family_members(load_case(std::nullopt, {box[1]}), 4);
  EXPECT_EQ(one_range.back().values.front().second, 0.002);
  EXPECT_NEAR(one_range[1].values.front().second, 0.001, 1e-15);
}

TEST(Family, RefusesRangesThatNoCaseHas) {
  EXPECT_TRUE(holds(override_refusal({"uncertain.absorber.masss=± 5 %"}), "did you mean"));
  EXPECT_TRUE(holds(override_refusal({"uncertain.plant.model=± 5 %"}), "only a key with a number"));
  for (const std::string wrong : {"[2, 1]", "5 %"})
    EXPECT_TRUE(holds(override_refusal({"uncertain.absorber.mass=" + wrong}), "[lowest, highest]"));
  EXPECT_TRUE(
      holds(override_refusal({"uncertain.absorber.mass=± 2 mm"}), "not a unit of this key"));
  EXPECT_THROW(uncertain_ranges(load_case(std::nullopt, {"uncertain.absorber.mass=± 120 %"})),
               WrongInput);
  EXPECT_THROW(answer_of({"margins", "--family"}, "", {}), WrongInput);
  EXPECT_THROW(answer_of({"boundary", "--family"}, "", box), WrongInput);
  EXPECT_THROW(answer_of({"boundary", "--prove"}, "", box), WrongInput);
  EXPECT_THROW(answer_of({"boundary", "--stable-interval", "--prove"}, "", box), WrongInput);
  for (const char* other : {"--p=-4:0:3", "--d=-3:0:3", "--continuous", "--draws=9"})
    EXPECT_THROW(answer_of({"stability", "--family", "--prove", other}, "", box), WrongInput);
  EXPECT_TRUE(
      holds(tests::refusal("[uncertain]\nabsorber.mass = [1, 2]\n"), "write the key in quotes"));
}

TEST(Family, AnswersWithTheRowThatItsWorstMemberAloneHas) {
  for (const Words& job : {Words{"margins"}, Words{"response", "--p=-557:-557:1", "--d=-12:0:3"},
                           Words{"stability", "--radius", "--p=-557:0:2", "--d=-35:0:3"},
                           Words{"max-delay", "--frequency=8:12:2"}}) {
    Words of_family = job;
    of_family.insert(of_family.end(), {"--family", "--draws=20"});
    AnswerInMemory worst = answer_of(of_family, "", box);
    EXPECT_TRUE(holds(worst.warnings.front(), "not covered"));
    const std::size_t rows = worst.table.columns.front().rows();
    for (std::size_t row = 0; row < rows; ++row) {
      const std::string member = worst.word("worst_member", row);
      AnswerInMemory alone = answer_of(job, "", settings_of(member));
      for (ReceivedColumn& column : alone.table.columns) {
        if (column.kind() != ReceivedColumn::Kind::numbers) continue;
        const double here = worst.numbers(column.about().name)[row];
        if (std::isnan(here)) continue;
        EXPECT_EQ(here, column.numbers()[row]) << job.front() << ' ' << member;
      }
    }
  }
}

TEST(Family, IsStableWhereEachOfItsMembersIs) {
  const Words job = {"boundary", "--stable-interval"};
  AnswerInMemory common =
      answer_of({"boundary", "--stable-interval", "--family", "--draws=30"}, "", box);
  double lower = -1e300, upper = 1e300;
  for (const FamilyMember& member : family_members(load_case(std::nullopt, box), 30)) {
    AnswerInMemory alone = answer_of(job, "", settings_of(member.text()));
    lower = std::max(lower, alone.numbers("lower")[0]);
    upper = std::min(upper, alone.numbers("upper")[0]);
  }
  EXPECT_EQ(common.numbers("lower")[0], lower);
  EXPECT_EQ(common.numbers("upper")[0], upper);
}

/// The proved interval is that of its members but for a share at each end, and other members are
/// stable in it.
void expect_proved_interval(const std::string& text, const Words& uncertain) {
  const Words job = {"boundary", "--stable-interval", "--p=-100"};
  Words compared = job;
  compared.insert(compared.end(), {"--family", "--draws=20"});
  Words proved = compared;
  proved.emplace_back("--prove");
  AnswerInMemory common = answer_of(compared, text, uncertain);
  AnswerInMemory inside = answer_of(proved, text, uncertain);
  EXPECT_FALSE(holds(inside.warnings.empty() ? "" : inside.warnings.front(), "not covered"));
  const double lower = inside.numbers("lower")[0], upper = inside.numbers("upper")[0];
  const double width = common.numbers("upper")[0] - common.numbers("lower")[0];
  EXPECT_GE(lower, common.numbers("lower")[0]);
  EXPECT_LE(upper, common.numbers("upper")[0]);
  EXPECT_GE(upper - lower, 0.98 * width);
  for (const FamilyMember& member : family_members(tests::from_text(text, uncertain), 57)) {
    AnswerInMemory alone = answer_of(job, text, settings_of(member.text()));
    EXPECT_LE(alone.numbers("lower")[0], lower) << member.text();
    EXPECT_GE(alone.numbers("upper")[0], upper) << member.text();
  }
}

TEST(Family, HasAProvedIntervalNextToThatOfItsMembers) {
  expect_proved_interval("", {box[0], box[2], "uncertain.control.sampling_period=[0.001, 0.0013]"});
  expect_proved_interval(
      "[conductor]\nname = \"Drake\"\nspan = 350\ndamping_ratio = 1e-3\n[stringing]\n"
      "temperature = 15\ntension = 28020\n[absorber]\nmass = 4\nposition = 1.2\n[plant]\n"
      "model = \"string\"\nmodes = 12\nabsorber_stiffness = 35530\nabsorber_damping = 75\n"
      "[control]\nsampling_period = 1e-3\n",
      {"uncertain.weather.temperature=[-30, 80]"});
}

TEST(Family, HasTheQuantilesOfItsMotions) {
  const Words metrics = {"--duration=2", "--metric=steady_peak", "--metric=attenuates"};
  Words of_family = {"sweep", "--family", "--draws=21"}, of_axis = {"sweep"};
  of_axis.emplace_back("--axis=control.sampling_period=0.0005:0.03:21");
  for (Words* words : {&of_family, &of_axis})
    words->insert(words->end(), metrics.begin(), metrics.end());
  const Words range = {"uncertain.control.sampling_period=[0.0005, 0.03]"};
  AnswerInMemory quantiles = answer_of(of_family, "", range);
  AnswerInMemory cells = answer_of(of_axis, "", {});
  std::vector<double> peaks = cells.numbers("steady_peak");
  const auto largest = std::max_element(peaks.begin(), peaks.end()) - peaks.begin();
  EXPECT_NEAR(std::stod(quantiles.word("highest_member", 0).substr(24)),
              0.0005 + 0.0295 * static_cast<double>(largest) / 20.0, 1e-12);
  std::sort(peaks.begin(), peaks.end());
  const std::vector<std::pair<const char*, std::size_t>> ranks = {
      {"lowest", 0}, {"quantile_05", 1}, {"median", 10}, {"quantile_95", 19}, {"highest", 20}};
  for (const auto& [name, rank] : ranks)
    EXPECT_NEAR(quantiles.numbers(name)[0], peaks[rank], 1e-9 * peaks[rank]) << name;
  EXPECT_LT(peaks.front(), 0.9 * peaks.back());
  // Eleven of 21 delays are within the hundred periods that a delay may have.
  AnswerInMemory delayed =
      answer_of(of_family, "", {"uncertain.control.processing_delay=[0, 0.2]"});
  EXPECT_EQ(delayed.column("members").whole_numbers(), std::vector<std::int64_t>({11, 11}));
  for (const char* other : {"--axis=backlash.width=0:1e-3:2", "--part=1/2", "--resume"}) {
    Words more = of_family;
    more.emplace_back(other);
    EXPECT_THROW(answer_of(more, "", range), WrongInput) << other;
  }
}

}  // namespace
}  // namespace holdfast::program
