#pragma once

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "holdfast/ceres/decay_fit_options.hpp"
#include "holdfast/ceres/decay_residuals.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

/// Fits of a plant to records of its free decay; this header needs the package Ceres Solver.
namespace holdfast::fit {

namespace detail {

using Theta = std::array<double, unknowns>;

struct DecayRun {
  bool at_minimum;  // inside the admissible range, converged
  Theta theta;
  double cost;
};

inline std::array<bool, unknowns> free_unknowns(const DecayFitOptions& fit_options) {
  std::array<bool, unknowns> free{};
  for (const PlantParameter parameter : fit_options.free)
    free[static_cast<std::size_t>(parameter)] = true;
  free.back() =
      fit_options.target == DecayTarget::time_history && fit_options.fit_initial_displacement;
  return free;
}

using DecayCost = ::ceres::AutoDiffCostFunction<DecayResiduals, ::ceres::DYNAMIC, 1, 1, 1, 1, 1, 1>;

inline std::unique_ptr<DecayCost> decay_cost(const DecayResiduals& residuals) {
  return std::make_unique<DecayCost>(new DecayResiduals(residuals), residuals.count());
}

/// Residuals without a robust loss, and their derivatives by the free unknowns θ.
struct Linearisation {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;

  bool finite() const { return residuals.allFinite() && jacobian.allFinite(); }
};

inline Linearisation linearise(const DecayResiduals& residuals, const DecayFitOptions& fit_options,
                               const Theta& theta) {
  const int count = residuals.count();
  Linearisation result{Eigen::VectorXd(count), Eigen::MatrixXd(count, unknowns)};
  std::array<const double*, unknowns> at{};
  std::array<double*, unknowns> columns{};
  for (std::size_t k = 0; k < unknowns; ++k) {
    at[k] = &theta[k];
    columns[k] = result.jacobian.col(static_cast<Eigen::Index>(k)).data();
  }
  DecayResiduals plain = residuals;
  plain.huber_scale = std::numeric_limits<double>::infinity();
  if (!decay_cost(plain)->Evaluate(at.data(), result.residuals.data(), columns.data()))
    result.residuals.setConstant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Index kept = 0;
  const auto free = free_unknowns(fit_options);
  for (std::size_t k = 0; k < unknowns; ++k) {
    if (!free[k]) continue;
    result.jacobian.col(kept++) = result.jacobian.col(static_cast<Eigen::Index>(k)).eval();
  }
  result.jacobian.conservativeResize(Eigen::NoChange, kept);
  return result;
}

inline DecayRun run_from(const DecayResiduals& residuals, const DecayFitOptions& fit_options,
                         const Theta& start) {
  constexpr double reach = 13.8155;  // ln 10⁶
  DecayRun run{false, start, 0.0};
  const auto free = free_unknowns(fit_options);
  ::ceres::Problem problem;
  std::vector<double*> blocks;
  for (double& theta : run.theta) blocks.push_back(&theta);
  problem.AddResidualBlock(decay_cost(residuals).release(), nullptr, blocks);
  for (std::size_t k = 0; k < unknowns; ++k) {
    if (!free[k]) problem.SetParameterBlockConstant(blocks[k]);
    if (!free[k]) continue;
    problem.SetParameterLowerBound(blocks[k], 0, -reach);
    problem.SetParameterUpperBound(blocks[k], 0, reach);
  }
  // Ceres prints what it cannot evaluate; a library does not.
  if (!linearise(residuals, fit_options, start).finite()) return run;
  ::ceres::Solver::Options options;
  options.logging_type = ::ceres::SILENT;
  options.linear_solver_type = ::ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-11;
  ::ceres::Solver::Summary summary;
  ::ceres::Solve(options, &problem, &summary);
  run.cost = summary.final_cost;
  run.at_minimum = summary.termination_type == ::ceres::CONVERGENCE;
  for (std::size_t k = 0; k < unknowns; ++k)
    run.at_minimum = run.at_minimum && (!free[k] || std::abs(run.theta[k]) < 0.99 * reach);
  return run;
}

/// Robust estimate of the standard deviation of residuals r: 1.4826 times the median of |r|.
inline double median_deviation(const Eigen::VectorXd& residuals) {
  std::vector<double> sizes(residuals.data(), residuals.data() + residuals.size());
  for (double& size : sizes) size = std::abs(size);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

/// Factor of (JᵀJ)⁻¹ in the covariance of p free unknowns, for n residuals r with derivatives J:
/// Σr²/(n − p) for measures, at least (1 %)²; [Σψ²/(n − p)]/(mean ψ′)² for a time history, where ψ
/// are the bounded residuals. Source: P. J. Huber, Robust Statistics, 1981, Sect. 7.6.
inline double variance_factor(const DecayResiduals& residuals, const Linearisation& at) {
  const auto freedom = static_cast<double>(at.residuals.size() - at.jacobian.cols());
  if (is_measured(residuals.target))
    return std::fmax(at.residuals.squaredNorm() / freedom, 0.01 * 0.01);
  double squares = 0.0, inside = 0.0;
  for (const double residual : at.residuals) {
    const double bounded = std::fmin(std::abs(residual), residuals.huber_scale);
    squares += bounded * bounded;
    inside += std::abs(residual) <= residuals.huber_scale ? 1.0 : 0.0;
  }
  const double share = inside / static_cast<double>(at.residuals.size());
  return squares / freedom / (share * share);
}

/// Standard errors σ_p = p σ_θ of the free parameters p, from the covariance of their logarithms θ.
inline std::vector<double> standard_errors(const DecayResiduals& residuals, const Linearisation& at,
                                           const TwoMass<double>& plant,
                                           const DecayFitOptions& fit_options) {
  const Eigen::Index free = at.jacobian.cols();
  if (Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(at.jacobian).rank() < free)
    return std::vector<double>(fit_options.free.size(), std::numeric_limits<double>::quiet_NaN());
  const Eigen::MatrixXd covariance =
      variance_factor(residuals, at) *
      (at.jacobian.transpose() * at.jacobian).ldlt().solve(Eigen::MatrixXd::Identity(free, free));
  // The columns are in the order of the unknowns, the result in the order of `free`.
  std::vector<PlantParameter> ordered = fit_options.free;
  std::sort(ordered.begin(), ordered.end());
  std::vector<double> errors;
  for (const PlantParameter parameter : fit_options.free) {
    const auto place = std::find(ordered.begin(), ordered.end(), parameter) - ordered.begin();
    errors.push_back(parameter_of(plant, parameter) * std::sqrt(covariance(place, place)));
  }
  return errors;
}

inline DecayMinimum minimum_of(const DecayResiduals& residuals, const DecayFitOptions& fit_options,
                               const DecayRun& run) {
  const Linearisation at = linearise(residuals, fit_options, run.theta);
  const auto& theta = run.theta;
  DecayMinimum minimum{};
  minimum.plant =
      scaled_plant<double>(residuals.reference, {theta[0], theta[1], theta[2], theta[3], theta[4]});
  minimum.initial_displacement = residuals.record.displacements.front() * std::exp(theta.back());
  minimum.standard_errors = standard_errors(residuals, at, minimum.plant, fit_options);
  minimum.residual = std::sqrt(at.residuals.squaredNorm() / residuals.count());
  if (!is_measured(fit_options.target)) minimum.residual *= residuals.amplitude();
  minimum.cost = run.cost;
  minimum.found_from = 1;
  return minimum;
}

/// Whether a parameter is at least its standard error; else the cost is too flat for a minimum.
inline bool is_determined(const DecayMinimum& minimum, const DecayFitOptions& fit_options) {
  for (std::size_t k = 0; k < fit_options.free.size(); ++k)
    if (minimum.standard_errors[k] <= parameter_of(minimum.plant, fit_options.free[k])) return true;
  return false;
}

/// Adds a minimum, or increments `found_from` of a known minimum with the same parameters.
inline void collect(std::vector<DecayMinimum>& minima, const DecayMinimum& found,
                    const DecayFitOptions& fit_options) {
  const auto same = [&](const DecayMinimum& known) {
    return std::all_of(fit_options.free.begin(), fit_options.free.end(),
                       [&](PlantParameter parameter) {
                         return std::abs(std::log(parameter_of(known.plant, parameter) /
                                                  parameter_of(found.plant, parameter))) < 1e-3;
                       });
  };
  const auto known = std::find_if(minima.begin(), minima.end(), same);
  if (known == minima.end()) {
    minima.push_back(found);
    return;
  }
  const int starts = known->found_from + 1;
  if (found.cost < known->cost) *known = found;
  known->found_from = starts;
}

inline bool damping_is_free(const DecayFitOptions& fit_options) {
  return std::find(fit_options.free.begin(), fit_options.free.end(),
                   PlantParameter::absorber_damping) != fit_options.free.end();
}

/// Reference plant of a fit: the given plant, but a free c₂ at the critical damping 2 √(k₂m₂).
inline TwoMass<double> reference_of(TwoMass<double> plant, const DecayFitOptions& fit_options) {
  if (damping_is_free(fit_options))
    plant.absorber_damping = 2.0 * std::sqrt(plant.absorber_stiffness * plant.absorber_mass);
  return plant;
}

/// Start values of a fit: c₂, if free, at 1/32, 1/16, … 4 times the critical damping.
inline std::vector<Theta> starts_of(const DecayFitOptions& fit_options) {
  if (!damping_is_free(fit_options)) return {Theta{}};
  std::vector<Theta> starts;
  for (int power = -5; power <= 2; ++power) {
    starts.push_back({});
    starts.back()[static_cast<std::size_t>(PlantParameter::absorber_damping)] =
        power * std::log(2.0);
  }
  return starts;
}

inline void validate(const DecayRecord& record, const TwoMass<double>& plant,
                     const DecayFitOptions& fit_options) {
  holdfast::validate(plant);
  const auto& t = record.times;
  const auto& z = record.displacements;
  if (t.size() != z.size())
    throw InvalidParameter("number of displacements", static_cast<double>(z.size()), "",
                           "equal to the number of instants");
  if (t.size() < unknowns + 2)
    throw InvalidParameter("number of instants", static_cast<double>(t.size()), "", ">= 8");
  for (std::size_t k = 0; k < t.size(); ++k) {
    require_finite("time", t[k], "s");
    require_finite("displacement", z[k], "m");
    if (k > 0 && t[k] <= t[k - 1])
      throw InvalidParameter("time", t[k], "s", "later than the previous instant");
  }
  if (z.front() == 0.0)
    throw InvalidParameter("first displacement", 0.0, "m", "nonzero: the decay starts from it");
  if (fit_options.free.empty())
    throw InvalidParameter("number of free parameters", 0.0, "", ">= 1");
  for (const PlantParameter parameter : fit_options.free) {
    if (parameter != PlantParameter::absorber_damping)
      require_positive("start value of a free parameter", parameter_of(plant, parameter), "");
    if (std::count(fit_options.free.begin(), fit_options.free.end(), parameter) > 1)
      throw InvalidParameter("number of times that one free parameter is listed", 2.0, "", "1");
  }
  const std::size_t most = fit_options.target == DecayTarget::first_peak_and_period ? 1 : 2;
  if (is_measured(fit_options.target) && fit_options.free.size() > most)
    throw InvalidParameter("number of free parameters",
                           static_cast<double>(fit_options.free.size()), "",
                           "fewer than the measured quantities of the target");
}

/// Continues the runs with Huber's loss, whose scale follows from the residuals at the deepest
/// minimum. This is done twice, since outliers shift the first minima.
inline void make_robust(DecayResiduals& residuals, const DecayFitOptions& fit_options,
                        std::vector<DecayRun>& runs) {
  const auto deeper = [](const DecayRun& a, const DecayRun& b) { return a.cost < b.cost; };
  for (int pass = 0; pass < 2 && !runs.empty(); ++pass) {
    const auto deepest = std::min_element(runs.begin(), runs.end(), deeper);
    const double deviation =
        median_deviation(linearise(residuals, fit_options, deepest->theta).residuals);
    if (!(deviation > 1e-12)) return;  // an exact record has no outliers
    residuals.huber_scale = 1.345 * deviation;
    for (DecayRun& run : runs) run = run_from(residuals, fit_options, run.theta);
  }
}

}  // namespace detail

/// Fits parameters of a plant to a record of the conductor's displacement z₁ in a free decay. The
/// decay starts from rest at z₁ = z₂ = z₀, where z₂ is the absorber's displacement. If the damping
/// c₂ of the absorber is fitted, the fit starts from several values of c₂ and reports all minima: a
/// heavily and a lightly damped absorber often fit the same record.
///
/// The unknowns are the logarithms of the parameters. Each parameter stays within a factor 10⁶ of a
/// reference: its value in `plant`, but the critical damping 2 √(k₂m₂) for c₂ and the record's
/// first z₁ for z₀. Derivatives are exact (dual numbers).
/// @param record       finite z₁ at 8 or more ascending instants; z₁ ≠ 0 at the first one
/// @param plant        start values of fitted parameters other than c₂; values of all others
/// @param fit_options  parameters that are fitted, and quantities of the record to be matched
/// @throws InvalidParameter for an inadmissible plant or record; if no parameter is fitted, one is
///         listed twice, or one other than c₂ starts from 0; for a target of measures (DecayTarget)
///         also unless there are fewer fitted parameters than measures
inline DecayFit fit_decay(const DecayRecord& record, const TwoMass<double>& plant,
                          const DecayFitOptions& fit_options = {}) {
  detail::validate(record, plant, fit_options);
  DecayFit fit{FitOutcome::no_minimum, {}, 0};
  const DecayMeasures measures = decay_measures(record);
  if (is_measured(fit_options.target) && !std::isfinite(measures.logarithmic_decrement)) return fit;
  detail::DecayResiduals residuals{record, measures, fit_options.target,
                                   detail::reference_of(plant, fit_options)};
  std::vector<detail::DecayRun> runs;
  for (const detail::Theta& start : detail::starts_of(fit_options)) {
    ++fit.starts;
    const detail::DecayRun run = detail::run_from(residuals, fit_options, start);
    if (run.at_minimum) runs.push_back(run);
  }
  if (fit_options.robust && !is_measured(fit_options.target))
    detail::make_robust(residuals, fit_options, runs);
  for (const detail::DecayRun& run : runs) {
    if (!run.at_minimum) continue;
    const DecayMinimum minimum = detail::minimum_of(residuals, fit_options, run);
    if (detail::is_determined(minimum, fit_options))
      detail::collect(fit.minima, minimum, fit_options);
  }
  std::sort(fit.minima.begin(), fit.minima.end(),
            [](const DecayMinimum& a, const DecayMinimum& b) { return a.cost < b.cost; });
  if (!fit.minima.empty()) fit.outcome = FitOutcome::converged;
  return fit;
}

}  // namespace holdfast::fit
