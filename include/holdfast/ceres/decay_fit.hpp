#pragma once

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "holdfast/cable/decay_measures.hpp"
#include "holdfast/ceres/decay_question.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/two_dof.hpp"

/// Fits of the plant to records by Ceres Solver. Needs a package besides Eigen.
namespace holdfast::fit {

/// Fits the plant's decay from rest at z₁ = z₂ = z₀ to a record, from several starts of c₂ (if it
/// is free): a record met by a heavily damped absorber is often met by a lightly damped one too,
/// and both minima are reported.
///
/// The parameters are fitted by their logarithms, within a factor 10⁶ of the given plant's
/// either way (c₂: of the critical damping 2 √(k₂m₂)); derivatives come from dual numbers through
/// the motion's closed form.
/// @param plant  the values of the parameters that are not free, and where the others start
/// @throws InvalidParameter for an inadmissible plant, a record with fewer instants than unknowns,
/// or not ascending, or not finite, or not starting displaced; or no free parameter
inline DecayFit fit_decay(const DecayRecord& record, const TwoDof<double>& plant,
                          const DecayQuestion& question = {});

// ---------------------------------------------------------------------------------------------

namespace detail {

inline double value_of(double number) { return number; }
template <class T, int N>
double value_of(const ::ceres::Jet<T, N>& number) {
  return number.a;
}

constexpr std::size_t plant_parameters = 5;             // in the order of PlantParameter
constexpr std::size_t unknowns = plant_parameters + 1;  // and z₀

/// The plant whose parameters are those of `reference` times e^θ.
template <class Scalar>
TwoDof<Scalar> scaled_plant(const TwoDof<double>& reference,
                            const std::array<Scalar, plant_parameters>& theta) {
  using std::exp;
  return {
      reference.conductor_mass * exp(theta[0]),     reference.conductor_stiffness * exp(theta[1]),
      reference.conductor_damping * exp(theta[2]),  Scalar(reference.absorber_mass),
      reference.absorber_stiffness * exp(theta[3]), reference.absorber_damping * exp(theta[4])};
}

template <class Scalar>
TwoDof<double> values_of(const TwoDof<Scalar>& plant) {
  return {value_of(plant.conductor_mass),     value_of(plant.conductor_stiffness),
          value_of(plant.conductor_damping),  value_of(plant.absorber_mass),
          value_of(plant.absorber_stiffness), value_of(plant.absorber_damping)};
}

/// ± √(2 ρ(r)) of Huber's loss ρ: its square is what a least-squares solver then adds up.
template <class Scalar>
Scalar huber_residual(const Scalar& residual, double scale) {
  using std::abs;
  using std::sqrt;
  if (!(abs(residual) > Scalar(scale))) return residual;
  const Scalar root = sqrt(Scalar(2.0 * scale) * abs(residual) - Scalar(scale * scale));
  return residual < Scalar(0) ? Scalar(-root) : root;
}

/// Residuals of a record as Ceres asks for them: θ of the five parameters and of z₀.
struct DecayResiduals {
  const DecayRecord& record;
  DecayMeasures measures;
  DecayTarget target;
  TwoDof<double> reference;
  double huber_scale;  // m; ∞ for plain least squares

  int count() const {
    if (!is_measured(target)) return static_cast<int>(record.times.size());
    return target == DecayTarget::first_peak_and_period ? 2 : 3;
  }

  template <class Scalar>
  bool operator()(const Scalar* m1, const Scalar* k1, const Scalar* c1, const Scalar* k2,
                  const Scalar* c2, const Scalar* start, Scalar* residuals) const {
    const auto plant = scaled_plant<Scalar>(reference, {*m1, *k1, *c1, *k2, *c2});
    if (is_measured(target)) return compare_measures(plant, residuals);
    using std::exp;
    const auto motion =
        free_decay(plant, Scalar(record.displacements.front() * exp(*start)), record.times);
    bool finite = true;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      residuals[k] = huber_residual(Scalar(motion[k] - record.displacements[k]), huber_scale);
      finite = finite && std::isfinite(value_of(residuals[k]));
    }
    return finite;
  }

 private:
  template <class Scalar>
  bool compare_measures(const TwoDof<Scalar>& plant, Scalar* residuals) const {
    const auto decay = relative_decay(plant, free_decay_events(values_of(plant)));
    if (!decay) return false;
    const double first_peak = measures.first_peak / record.displacements.front();
    residuals[0] = decay->first_peak / first_peak - 1.0;
    residuals[1] = decay->period / measures.period - 1.0;
    if (target == DecayTarget::first_peak_period_and_decrement)
      residuals[2] = decay->logarithmic_decrement / measures.logarithmic_decrement - 1.0;
    return std::isfinite(value_of(residuals[0] + residuals[1] + residuals[count() - 1]));
  }
};

/// Where one run of Ceres ended.
struct DecayRun {
  bool at_minimum;  // inside the admissible range, converged
  std::array<double, unknowns> theta;
  double cost;
};

inline std::array<bool, unknowns> free_unknowns(const DecayQuestion& question) {
  std::array<bool, unknowns> free{};
  for (const PlantParameter parameter : question.free)
    free[static_cast<std::size_t>(parameter)] = true;
  free.back() = question.target == DecayTarget::time_history && question.fit_initial_displacement;
  return free;
}

using DecayCost = ::ceres::AutoDiffCostFunction<DecayResiduals, ::ceres::DYNAMIC, 1, 1, 1, 1, 1, 1>;

inline std::unique_ptr<DecayCost> decay_cost(const DecayResiduals& residuals) {
  return std::make_unique<DecayCost>(new DecayResiduals(residuals), residuals.count());
}

inline DecayRun run_from(const DecayResiduals& residuals, const DecayQuestion& question,
                         const std::array<double, unknowns>& start) {
  constexpr double reach = 13.8155;  // ln 10⁶
  DecayRun run{false, start, 0.0};
  const auto free = free_unknowns(question);
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

/// Residuals (count) and their derivatives by the free θ (count × free) at a point.
struct Linearisation {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

inline Linearisation linearise(const DecayResiduals& residuals, const DecayQuestion& question,
                               const std::array<double, unknowns>& theta) {
  const int count = residuals.count();
  Linearisation result{Eigen::VectorXd(count), Eigen::MatrixXd(count, unknowns)};
  std::array<const double*, unknowns> at{};
  std::array<double*, unknowns> columns{};
  for (std::size_t k = 0; k < unknowns; ++k) {
    at[k] = &theta[k];
    columns[k] = result.jacobian.col(static_cast<Eigen::Index>(k)).data();
  }
  decay_cost(residuals)->Evaluate(at.data(), result.residuals.data(), columns.data());
  Eigen::Index kept = 0;
  const auto free = free_unknowns(question);
  for (std::size_t k = 0; k < unknowns; ++k) {
    if (!free[k]) continue;
    result.jacobian.col(kept++) = result.jacobian.col(static_cast<Eigen::Index>(k)).eval();
  }
  result.jacobian.conservativeResize(Eigen::NoChange, kept);
  return result;
}

/// 1.4826 times the median of |r|: the standard deviation of Gaussian noise, whatever a few
/// outliers do.
inline double median_deviation(const Eigen::VectorXd& residuals) {
  std::vector<double> sizes(residuals.data(), residuals.data() + residuals.size());
  for (double& size : sizes) size = std::abs(size);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

inline double parameter_of(const TwoDof<double>& plant, PlantParameter parameter) {
  switch (parameter) {
    case PlantParameter::conductor_mass:
      return plant.conductor_mass;
    case PlantParameter::conductor_stiffness:
      return plant.conductor_stiffness;
    case PlantParameter::conductor_damping:
      return plant.conductor_damping;
    case PlantParameter::absorber_stiffness:
      return plant.absorber_stiffness;
    case PlantParameter::absorber_damping:
      break;
  }
  return plant.absorber_damping;
}

/// σ_p = p σ_θ, with the covariance s² (JᵀJ)⁻¹ of θ. NaN where the record says nothing of θ.
inline std::vector<double> standard_errors(const Linearisation& at, const TwoDof<double>& plant,
                                           const DecayQuestion& question) {
  const Eigen::Index count = at.residuals.size(), free = at.jacobian.cols();
  const double variance = at.residuals.squaredNorm() / static_cast<double>(count - free);
  const Eigen::MatrixXd covariance =
      (at.jacobian.transpose() * at.jacobian).ldlt().solve(Eigen::MatrixXd::Identity(free, free));
  // The columns stand in the order of the unknowns, the answer in that of the question.
  std::vector<PlantParameter> ordered = question.free;
  std::sort(ordered.begin(), ordered.end());
  std::vector<double> errors;
  for (const PlantParameter parameter : question.free) {
    const auto place = std::find(ordered.begin(), ordered.end(), parameter) - ordered.begin();
    errors.push_back(parameter_of(plant, parameter) *
                     std::sqrt(variance * covariance(place, place)));
  }
  return errors;
}

inline DecayMinimum minimum_of(const DecayResiduals& residuals, const DecayQuestion& question,
                               const DecayRun& run) {
  const Linearisation at = linearise(residuals, question, run.theta);
  DecayMinimum minimum{};
  minimum.plant = scaled_plant<double>(
      residuals.reference, {run.theta[0], run.theta[1], run.theta[2], run.theta[3], run.theta[4]});
  minimum.initial_displacement =
      residuals.record.displacements.front() * std::exp(run.theta.back());
  minimum.standard_errors = standard_errors(at, minimum.plant, question);
  minimum.residual = std::sqrt(at.residuals.squaredNorm() / static_cast<double>(residuals.count()));
  minimum.cost = run.cost;
  minimum.found_from = 1;
  return minimum;
}

/// Adds a minimum, or one more start to the minimum that it repeats.
inline void collect(std::vector<DecayMinimum>& minima, const DecayMinimum& found,
                    const DecayQuestion& question) {
  const auto same = [&](const DecayMinimum& known) {
    return std::all_of(question.free.begin(), question.free.end(), [&](PlantParameter parameter) {
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

/// c₂ of the starts: from 1/32 to 4 times the critical damping 2 √(k₂m₂) of the absorber, by twos.
inline std::vector<TwoDof<double>> starts_of(const TwoDof<double>& plant,
                                             const DecayQuestion& question) {
  const bool damping_is_free = std::find(question.free.begin(), question.free.end(),
                                         PlantParameter::absorber_damping) != question.free.end();
  if (!damping_is_free) return {plant};
  const double critical = 2.0 * std::sqrt(plant.absorber_stiffness * plant.absorber_mass);
  std::vector<TwoDof<double>> starts;
  for (double ratio = 1.0 / 32.0; ratio <= 4.0; ratio *= 2.0) {
    starts.push_back(plant);
    starts.back().absorber_damping = ratio * critical;
  }
  return starts;
}

inline void validate(const DecayRecord& record, const TwoDof<double>& plant,
                     const DecayQuestion& question) {
  holdfast::validate(plant);
  const auto& t = record.times;
  const auto& z = record.displacements;
  if (t.size() != z.size())
    throw InvalidParameter("number of displacements", static_cast<double>(z.size()), "",
                           "the number of times");
  if (t.size() < unknowns + 2)
    throw InvalidParameter("number of instants", static_cast<double>(t.size()), "", ">= 8");
  for (std::size_t k = 0; k < t.size(); ++k) {
    require_finite("time", t[k], "s");
    require_finite("displacement", z[k], "m");
    if (k > 0 && t[k] <= t[k - 1])
      throw InvalidParameter("time", t[k], "s", "above the one before");
  }
  if (z.front() == 0.0)
    throw InvalidParameter("first displacement", 0.0, "m", "not 0: the decay starts displaced");
  if (question.free.empty()) throw InvalidParameter("number of free parameters", 0.0, "", ">= 1");
  for (const PlantParameter parameter : question.free) {
    if (parameter != PlantParameter::absorber_damping)
      require_positive("start of a free parameter", parameter_of(plant, parameter), "");
    if (std::count(question.free.begin(), question.free.end(), parameter) > 1)
      throw InvalidParameter("number of times that a parameter is free", 2.0, "", "1");
  }
  const std::size_t most = question.target == DecayTarget::first_peak_and_period ? 1 : 2;
  if (is_measured(question.target) && question.free.size() > most)
    throw InvalidParameter("number of free parameters", static_cast<double>(question.free.size()),
                           "", "fewer than the measures that are to be met");
}

}  // namespace detail

inline DecayFit fit_decay(const DecayRecord& record, const TwoDof<double>& plant,
                          const DecayQuestion& question) {
  detail::validate(record, plant, question);
  constexpr double plain = std::numeric_limits<double>::infinity();
  DecayFit fit{FitOutcome::no_minimum, {}, 0};
  const bool robust = question.robust && question.target == DecayTarget::time_history;
  const DecayMeasures measures = decay_measures(record);
  if (is_measured(question.target) && !std::isfinite(measures.logarithmic_decrement)) return fit;
  for (const TwoDof<double>& start : detail::starts_of(plant, question)) {
    ++fit.starts;
    detail::DecayResiduals residuals{record, measures, question.target, start, plain};
    detail::DecayRun run = detail::run_from(residuals, question, {});
    if (run.at_minimum && robust) {
      const auto scatter = detail::linearise(residuals, question, run.theta).residuals;
      residuals.huber_scale = 1.345 * detail::median_deviation(scatter);
      if (residuals.huber_scale > 0.0) run = detail::run_from(residuals, question, run.theta);
    }
    if (!run.at_minimum) continue;
    detail::collect(fit.minima, detail::minimum_of(residuals, question, run), question);
  }
  std::sort(fit.minima.begin(), fit.minima.end(),
            [](const DecayMinimum& a, const DecayMinimum& b) { return a.cost < b.cost; });
  if (!fit.minima.empty()) fit.outcome = FitOutcome::converged;
  return fit;
}

}  // namespace holdfast::fit
