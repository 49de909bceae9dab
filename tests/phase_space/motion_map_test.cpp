#include "holdfast/phase_space/motion_map.hpp"

#include "support/kollar_case.hpp"
#include "support/plain_motion.hpp"

namespace holdfast {
namespace {

constexpr auto one_by_one = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t first = 0; first < count; first += tile)
    job(first, std::min(tile, count - first));
};
constexpr auto from_the_end = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t end = count; end > 0; end -= std::min(tile, end))
    job(end - std::min(tile, end), std::min(tile, end));
};

/// r₀ 0.5 … 2 mm (rows), τ in whole ms (columns).
struct PaperPlane {
  MapShape shape;
  std::vector<double> periods;

  IdealLoop<double> loop(std::size_t cell) const {
    const auto row = static_cast<double>(cell / shape.columns);
    const double width = 0.0005 + 0.0015 * row / static_cast<double>(shape.rows - 1);
    return {kollar2022_plant(),
            {periods[cell % shape.columns], 0.0},
            {-557.0, -13.0},
            {0.5, 10.0},
            width};
  }
};

const PaperPlane paper_plane{{16, 5}, {0.001, 0.003, 0.005, 0.01, 0.011}};

std::vector<MapCell> map_of_plane(const PaperPlane& which, const MotionMapOptions& options = {}) {
  return motion_map([&](std::size_t cell) { return std::optional(which.loop(cell)); }, which.shape,
                    Vector<double, 4>(Vector<double, 4>::Zero()), one_by_one, options);
}

TEST(MotionMap, AgreesWithPlainSimulationInEveryCell) {
  MotionMapOptions options;
  options.most_rounds = 0;
  const std::vector<MapCell> cells = map_of_plane(paper_plane, options);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const IdealLoop<double> loop = paper_plane.loop(cell);
    const std::int64_t coincidence = forcing_ratio(loop)->denominator;
    const test::PlainLoop plain = test::plain_loop(loop, coincidence);
    ASSERT_EQ(cells[cell].outcome, OrbitOutcome::certified) << cell;
    EXPECT_EQ(cells[cell].from_start()->period_samples,
              coincidence * test::plain_period(plain, 1'000'000))
        << cell;
  }
}

TEST(MotionMap, KnowsThePapersMotionsAndThatTheyCoexist) {
  MotionMapOptions options;
  options.more_starts = {{1e-5, 0.0, 0.0, 0.0}};
  const std::vector<MapCell> cells = map_of_plane(paper_plane, options);
  // The last row has r₀ = 2 mm.
  const MapCell* const row = &cells[cells.size() - paper_plane.shape.columns];
  EXPECT_EQ(row[0].from_start()->forcing_periods, 5);
  EXPECT_EQ(row[3].from_start()->forcing_periods, 3);
  EXPECT_EQ(row[4].from_start()->forcing_periods, 231);
  EXPECT_EQ(row[1].from_start()->forcing_periods, 57);
  const auto& motions = row[1].motions;
  EXPECT_TRUE(std::any_of(motions.begin(), motions.end(),
                          [](const MappedMotion& motion) { return motion.forcing_periods == 3; }));
}

TEST(MotionMap, DependsOnNoOrderOfTheCells) {
  const auto loop_at = [&](std::size_t cell) { return std::optional(paper_plane.loop(cell)); };
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  const auto forwards = motion_map(loop_at, paper_plane.shape, rest, one_by_one);
  const auto backwards = motion_map(loop_at, paper_plane.shape, rest, from_the_end);
  ASSERT_EQ(forwards.size(), backwards.size());
  for (std::size_t cell = 0; cell < forwards.size(); ++cell) {
    ASSERT_EQ(forwards[cell].motions.size(), backwards[cell].motions.size());
    for (std::size_t k = 0; k < forwards[cell].motions.size(); ++k)
      EXPECT_EQ(forwards[cell].motions[k].amplitude, backwards[cell].motions[k].amplitude);
  }
}

TEST(MotionMap, ContinuesAMotionOverTheCellsThatItsRegionHolds) {
  // So near to one another that the motion of 1 ms, 0.5 mm goes on in all of them.
  const auto loop_at = [](std::size_t cell) {
    IdealLoop<double> loop = paper_plane.loop(0);
    loop.backlash_width += 1e-7 * static_cast<double>(cell);
    return std::optional(loop);
  };
  MotionMapOptions options;
  const auto cells = motion_map(loop_at, {1, 10}, Vector<double, 4>(Vector<double, 4>::Zero()),
                                one_by_one, options);
  for (const MapCell& cell : cells) {
    ASSERT_EQ(cell.motions.size(), 1U);
    EXPECT_EQ(cell.motions[0].amplitude, cells[0].motions[0].amplitude);
  }
}

TEST(MotionMap, SwitchedExactlyThereIsOneMotionOfOneCoincidence) {
  const auto loop_at = [](std::size_t cell) {
    ImplementedLoop loop = implemented_loop(paper_plane.loop(cell));
    loop.switching = Switching::exact;
    return std::optional(loop);
  };
  const auto cells =
      motion_map(loop_at, {2, 5}, Vector<double, 4>(Vector<double, 4>::Zero()), one_by_one);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const MapCell& cell = cells[k];
    ASSERT_EQ(cell.outcome, OrbitOutcome::certified);
    EXPECT_EQ(cell.motions.size(), 1U);
    EXPECT_EQ(cell.from_start()->period_samples, forcing_ratio(paper_plane.loop(k))->denominator);
  }
}

TEST(MotionMap, ACellThatIsNotAdmissibleStaysEmpty) {
  const auto loop_at = [](std::size_t cell) {
    return cell == 1 ? std::nullopt : std::optional(paper_plane.loop(0));
  };
  const auto cells =
      motion_map(loop_at, {1, 3}, Vector<double, 4>(Vector<double, 4>::Zero()), one_by_one);
  EXPECT_EQ(cells[1].from_start(), nullptr);
  EXPECT_TRUE(cells[1].motions.empty());
  EXPECT_EQ(cells[2].motions.size(), 1U);
}

}  // namespace
}  // namespace holdfast
