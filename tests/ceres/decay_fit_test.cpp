#include "holdfast/ceres/decay_fit.hpp"
#include "support/testing.hpp"

namespace holdfast::fit {
namespace {

constexpr double start = 3.76e-3;

TwoMass<double> plant_with(double absorber_damping) {
  TwoMass<double> plant = kollar2022_plant();
  plant.absorber_damping = absorber_damping;
  return plant;
}

/// The plant's own decay over 4 s with Gaussian noise.
DecayRecord record_of(const TwoMass<double>& plant, double noise, unsigned seed) {
  DecayRecord record;
  for (int k = 0; k <= 1000; ++k) record.times.push_back(4e-3 * k);
  record.displacements = free_decay(plant, start, record.times);
  std::mt19937 generator(seed);
  std::normal_distribution<double> scatter(0.0, 1.0);
  for (double& displacement : record.displacements) displacement += noise * scatter(generator);
  return record;
}

TEST(DecayFit, FindsTheDampingOfAnExactRecord) {
  for (const double damping : {0.5, 1.0, 2.0, 4.0, 8.0, 20.0}) {
    const DecayFit fit = fit_decay(record_of(plant_with(damping), 0.0, 1), plant_with(3.0));
    ASSERT_EQ(fit.outcome, FitOutcome::converged);
    EXPECT_NEAR(fit.minima.front().plant.absorber_damping, damping, 1e-6 * damping);
    EXPECT_LE(fit.minima.front().residual, 1e-9 * start);
  }
}

TEST(DecayFit, RecoversTheDampingFromNoiseWithinItsStandardError) {
  // Of Gaussian errors 68 % lie within one standard error: of 120 draws 82 ± 5.
  int within_one = 0, draws = 0;
  for (const double damping : {0.5, 1.0, 2.0, 4.0, 8.0, 20.0}) {
    for (unsigned seed = 1; seed <= 20; ++seed, ++draws) {
      const DecayFit fit =
          fit_decay(record_of(plant_with(damping), 0.01 * start, seed), plant_with(4.0));
      ASSERT_EQ(fit.outcome, FitOutcome::converged);
      const DecayMinimum& best = fit.minima.front();
      const double error = std::abs(best.plant.absorber_damping - damping);
      EXPECT_LT(error, 4.0 * best.standard_errors[0]) << "c2 = " << damping << ", seed " << seed;
      EXPECT_LT(best.standard_errors[0], 0.02 * damping);
      within_one += error < best.standard_errors[0] ? 1 : 0;
    }
  }
  EXPECT_GE(within_one, 0.55 * draws);
  EXPECT_LE(within_one, 0.82 * draws) << "the standard errors are too wide";
}

TEST(DecayFit, RobustLossWithstandsADropout) {
  DecayRecord record = record_of(plant_with(4.0), 0.01 * start, 3);
  for (std::size_t k = 45; k < 62; ++k) record.displacements[k] = 0.0;  // the sensor drops out
  DecayFitOptions options;
  options.fit_initial_displacement = false;
  record.displacements.front() = start;
  const double robust =
      fit_decay(record, plant_with(2.0), options).minima.front().plant.absorber_damping;
  options.robust = false;
  const double plain =
      fit_decay(record, plant_with(2.0), options).minima.front().plant.absorber_damping;
  EXPECT_NEAR(robust, 4.0, 0.1);
  EXPECT_LT(std::abs(robust - 4.0), 0.3 * std::abs(plain - 4.0));
}

TEST(DecayFit, TheStandardErrorUnderOutliersIsTheScatterOfTheEstimate) {
  // A twentieth of the samples is displaced by ten times the start.
  DecayFitOptions options;
  std::vector<double> found;
  double stated = 0.0;
  constexpr int draws = 60;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    DecayRecord record = record_of(plant_with(4.0), 0.01 * start, seed);
    std::mt19937 generator(1000 + seed);
    std::uniform_int_distribution<std::size_t> place(1, record.times.size() - 1);
    for (int k = 0; k < 50; ++k) record.displacements[place(generator)] += 10.0 * start;
    const DecayMinimum best = fit_decay(record, plant_with(4.0), options).minima.front();
    found.push_back(best.plant.absorber_damping);
    stated += best.standard_errors[0] / draws;
    EXPECT_GT(best.residual, start) << "the root mean square is of all samples";
  }
  double mean = 0.0, variance = 0.0;
  for (const double damping : found) mean += damping / draws;
  for (const double damping : found) variance += (damping - mean) * (damping - mean) / (draws - 1);
  // Of 60 draws the scatter itself is known to 9 %.
  EXPECT_NEAR(stated / std::sqrt(variance), 1.0, 0.3);
  EXPECT_NEAR(mean, 4.0, 4.0 * stated / std::sqrt(draws) + 0.01);
}

TEST(DecayFit, OfGaussianNoiseTheRobustLossWastesATwentiethOfTheInformation) {
  // Huber's loss at 1.345 standard deviations is 95 % efficient: its errors are 1/sqrt(0.95)
  // = 1.026 times those of least squares. Of one record the ratio scatters by about a per cent.
  constexpr int records = 20;
  double logarithms = 0.0;
  for (unsigned seed = 1; seed <= records; ++seed) {
    const DecayRecord record = record_of(plant_with(4.0), 0.01 * start, seed);
    DecayFitOptions options;
    options.free = {PlantParameter::conductor_damping};
    const DecayFit robust = fit_decay(record, plant_with(4.0), options);
    options.robust = false;
    const DecayFit plain = fit_decay(record, plant_with(4.0), options);
    ASSERT_EQ(robust.outcome, FitOutcome::converged);
    ASSERT_EQ(plain.outcome, FitOutcome::converged);
    logarithms += std::log(robust.minima.front().standard_errors[0] /
                           plain.minima.front().standard_errors[0]);
  }
  EXPECT_NEAR(std::exp(logarithms / records), 1.0 / std::sqrt(0.95), 0.01);
}

TEST(DecayFit, TheUnitOfLengthDoesNotMatter) {
  const DecayRecord record = record_of(plant_with(4.0), 0.01 * start, 9);
  const DecayFit metres = fit_decay(record, plant_with(4.0));
  for (const double factor : {1e-9, 1e-4, 1e6}) {
    DecayRecord scaled = record;
    for (double& displacement : scaled.displacements) displacement *= factor;
    const DecayFit other = fit_decay(scaled, plant_with(4.0));
    ASSERT_EQ(other.minima.size(), metres.minima.size());
    const DecayMinimum &here = metres.minima.front(), &there = other.minima.front();
    EXPECT_NEAR(there.plant.absorber_damping, here.plant.absorber_damping, 1e-6);
    EXPECT_NEAR(there.standard_errors[0] / here.standard_errors[0], 1.0, 1e-3);
    EXPECT_NEAR(there.residual / (factor * here.residual), 1.0, 1e-6);
  }
}

TEST(DecayFit, MeasuresOfANoisyRecordAreMetNearItsDamping) {
  DecayFitOptions options;
  options.target = DecayTarget::first_peak_and_period;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    DecayRecord record;
    for (int k = 0; k <= 4000; ++k) record.times.push_back(1e-3 * k);
    record.displacements = free_decay(plant_with(4.0), start, record.times);
    std::mt19937 generator(seed);
    std::normal_distribution<double> scatter(0.0, 0.01 * start);
    for (std::size_t k = 1; k < record.times.size(); ++k)
      record.displacements[k] += scatter(generator);
    const DecayFit fit = fit_decay(record, plant_with(4.0), options);
    ASSERT_EQ(fit.outcome, FitOutcome::converged) << seed;
    // The peak of the noise lifts r1 by two to three per cent of z0, and r1 falls with c2.
    EXPECT_NEAR(fit.minima.front().plant.absorber_damping, 4.0, 1.5) << seed;
    EXPECT_LT(fit.minima.front().residual, 0.05) << seed;
  }
}

TEST(DecayFit, ARecordThatSaysNothingHasNoMinimum) {
  const DecayRecord good = record_of(plant_with(4.0), 0.0, 1);
  DecayRecord constant = good, late = good;
  for (double& displacement : constant.displacements) displacement = start;
  for (std::size_t k = 1; k < late.times.size(); ++k) {
    late.times[k] *= 1e200;
    late.displacements[k] = 0.0;
  }
  for (const DecayRecord& record : {constant, late})
    EXPECT_EQ(fit_decay(record, plant_with(4.0)).outcome, FitOutcome::no_minimum);
}

TEST(DecayFit, FindsAllFiveParameters) {
  TwoMass<double> guess = plant_with(3.0);
  guess.conductor_mass *= 1.1;
  guess.conductor_stiffness *= 0.95;
  guess.conductor_damping *= 1.3;
  guess.absorber_stiffness *= 0.9;
  DecayFitOptions options;
  options.free = {PlantParameter::conductor_mass, PlantParameter::conductor_stiffness,
                  PlantParameter::conductor_damping, PlantParameter::absorber_stiffness,
                  PlantParameter::absorber_damping};
  const DecayFit fit = fit_decay(record_of(plant_with(4.0), 0.0, 1), guess, options);
  ASSERT_EQ(fit.outcome, FitOutcome::converged);
  const TwoMass<double>& found = fit.minima.front().plant;
  EXPECT_NEAR(found.conductor_mass, 0.0767, 1e-5);
  EXPECT_NEAR(found.conductor_stiffness, 50.3, 1e-3);
  EXPECT_NEAR(found.conductor_damping, 0.079, 1e-4);
  EXPECT_NEAR(found.absorber_stiffness, 74.4, 1e-2);
  EXPECT_NEAR(found.absorber_damping, 4.0, 1e-3);
}

TEST(DecayFit, StandardErrorsKeepTheOrderOfTheQuestion) {
  DecayFitOptions forth, back;
  forth.free = {PlantParameter::conductor_damping, PlantParameter::absorber_damping};
  back.free = {PlantParameter::absorber_damping, PlantParameter::conductor_damping};
  const DecayRecord record = record_of(plant_with(4.0), 0.01 * start, 5);
  const auto first = fit_decay(record, plant_with(4.0), forth).minima.front().standard_errors;
  const auto second = fit_decay(record, plant_with(4.0), back).minima.front().standard_errors;
  EXPECT_NEAR(first[0], second[1], 1e-6 * first[0]);
  EXPECT_NEAR(first[1], second[0], 1e-6 * first[1]);
  EXPECT_NE(first[0], first[1]);
}

TEST(DecayFit, DerivativesAgreeWithDifferences) {
  const DecayRecord record = record_of(plant_with(4.0), 0.0, 1);
  for (const auto target :
       {DecayTarget::time_history, DecayTarget::first_peak_period_and_decrement}) {
    DecayFitOptions options;
    options.target = target;
    options.free = {PlantParameter::conductor_stiffness, PlantParameter::absorber_damping};
    options.fit_initial_displacement = false;
    const detail::DecayResiduals residuals{record, decay_measures(record), target, plant_with(2.5)};
    const auto at = [&](double stiffness, double damping) {
      return detail::linearise(residuals, options, {0.0, stiffness, 0.0, 0.0, damping, 0.0});
    };
    const double step = 1e-6;
    const Eigen::VectorXd by_damping =
        (at(0.0, step).residuals - at(0.0, -step).residuals) / (2.0 * step);
    const Eigen::VectorXd by_stiffness =
        (at(step, 0.0).residuals - at(-step, 0.0).residuals) / (2.0 * step);
    const Eigen::MatrixXd jacobian = at(0.0, 0.0).jacobian;
    EXPECT_LE((jacobian.col(0) - by_stiffness).norm(), 1e-6 * by_stiffness.norm());
    EXPECT_LE((jacobian.col(1) - by_damping).norm(), 1e-6 * by_damping.norm());
  }
}

TEST(DecayFit, ReportsBothBranchesOfFirstPeakAndPeriod) {
  // r1 falls and rises again with c₂: a record of c₂ = 4.9 has the first peak of c₂ = 0.9 too.
  DecayFitOptions options;
  options.target = DecayTarget::first_peak_and_period;
  const DecayFit fit = fit_decay(record_of(plant_with(4.9), 0.0, 1), plant_with(3.0), options);
  ASSERT_GE(fit.minima.size(), 2U);
  EXPECT_NEAR(fit.minima[0].plant.absorber_damping, 4.9, 1e-2);
  EXPECT_GT(fit.minima[1].plant.absorber_damping, 0.6);
  EXPECT_LT(fit.minima[1].plant.absorber_damping, 1.2);
  EXPECT_LT(fit.minima[0].residual, 1e-3);
  EXPECT_GT(fit.minima[1].residual, 0.005) << "the period tells the two apart";
  EXPECT_GE(fit.minima[0].found_from, 2);
  EXPECT_GE(fit.minima[1].found_from, 2);
}

TEST(DecayFit, HuberResidualIsSmoothAndLinearFarOut) {
  EXPECT_EQ(detail::huber_residual(0.5, 1.0), 0.5);
  EXPECT_EQ(detail::huber_residual(-1.0, 1.0), -1.0);
  const double far = detail::huber_residual(-8.0, 1.0);
  EXPECT_LT(far, 0.0);
  EXPECT_NEAR(far * far, 2.0 * 8.0 - 1.0, 1e-14) << "twice Huber's loss";
}

TEST(DecayFit, RefusesWhatCannotBeFitted) {
  const DecayRecord good = record_of(plant_with(4.0), 0.0, 1);
  const TwoMass<double> plant = plant_with(4.0);
  DecayRecord record = good;
  record.times[5] = record.times[4];
  EXPECT_THROW(fit_decay(record, plant), InvalidParameter);
  record = good;
  record.displacements[7] = std::nan("");
  EXPECT_THROW(fit_decay(record, plant), InvalidParameter);
  record = good;
  record.displacements[0] = 0.0;
  EXPECT_THROW(fit_decay(record, plant), InvalidParameter);
  record = good;
  record.displacements.pop_back();
  EXPECT_THROW(fit_decay(record, plant), InvalidParameter);
  EXPECT_THROW(fit_decay({{0.0, 1.0}, {1.0, 0.5}}, plant), InvalidParameter);
  DecayFitOptions options;
  options.free = {};
  EXPECT_THROW(fit_decay(good, plant, options), InvalidParameter);
  options.free = {PlantParameter::absorber_damping, PlantParameter::absorber_damping};
  EXPECT_THROW(fit_decay(good, plant, options), InvalidParameter);
  options.free = {PlantParameter::conductor_mass, PlantParameter::absorber_damping};
  options.target = DecayTarget::first_peak_and_period;
  EXPECT_THROW(fit_decay(good, plant, options), InvalidParameter);
}

TEST(DecayFit, OfARecordWithoutPeaksHasNoMinimum) {
  DecayRecord record;
  for (int k = 0; k < 100; ++k) {
    record.times.push_back(0.01 * k);
    record.displacements.push_back(start * std::exp(-0.05 * k));
  }
  DecayFitOptions options;
  options.target = DecayTarget::first_peak_and_period;
  EXPECT_EQ(fit_decay(record, plant_with(4.0), options).outcome, FitOutcome::no_minimum);
}

}  // namespace
}  // namespace holdfast::fit
