#include "case/model/decay/damping_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

#ifdef HOLDFAST_HAS_CERES
#include "holdfast/ceres/decay_fit.hpp"
#include "holdfast/plant/two_mass.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_CERES

void require_ceres() {}

fit::DecayFit fit_record(const DecayRecord& record, const TwoMass<double>& plant,
                         const fit::DecayFitOptions& options) {
  fit::DecayFit found = fit::fit_decay(record, plant, options);
  if (found.outcome == fit::FitOutcome::no_minimum)
    throw NoAnswer("the record does not determine the fitted parameters: give a longer record");
  return found;
}

#else

void require_ceres() {
  throw NoAnswer(
      "a fit needs Ceres Solver, which this program was built without: install the package "
      "libceres-dev and build again");
}

fit::DecayFit fit_record(const DecayRecord&, const TwoMass<double>&, const fit::DecayFitOptions&) {
  require_ceres();
  return {};
}

#endif

DecayRecord record_for_fit(const Case& the_case) {
  CableDecayOptions options = usual_decay(the_case);
  options.elements = 60;
  return cable_decay(the_case, options).record;
}

namespace {

DecayRecord first_part(const DecayRecord& record, double duration) {
  DecayRecord part;
  for (std::size_t k = 0; k < record.times.size(); ++k) {
    if (record.times[k] > duration * (1.0 + 1e-9)) break;
    part.times.push_back(record.times[k]);
    part.displacements.push_back(record.displacements[k]);
  }
  return part;
}

/// A fit of c2 to a decay with a known initial displacement.
struct DampingReading {
  fit::DecayFit fit;
  double misfit;  // relative to the fitted quantities, or to z(0)

  double value() const { return fit.minima.front().plant.absorber_damping; }
};

/// Fits c2 to a decay; none if the decay does not determine c2.
std::optional<DampingReading> damping_by(fit::DecayTarget target, const DecayRecord& record,
                                         const TwoMass<double>& plant) {
  fit::DecayFitOptions options;
  options.fit_initial_displacement = false;
  options.target = target;
  try {
    fit::DecayFit found = fit_record(record, plant, options);
    const double unit = fit::is_measured(target) ? 1.0 : std::abs(record.displacements.front());
    const double misfit = found.minima.front().residual / unit;
    return DampingReading{std::move(found), misfit};
  } catch (const NoAnswer&) {
    return std::nullopt;
  }
}

double misfit_of(const std::optional<DampingReading>& reading) {
  return reading ? reading->misfit : std::nan("");
}

}  // namespace

AbsorberDampingFit fit_absorber_damping(const Case& the_case, const TwoMass<double>& plant) {
  require_ceres();
  constexpr double largest_misfit = 0.1;
  const DecayRecord record = record_for_fit(the_case);
  const auto peak = damping_by(fit::DecayTarget::first_peak_and_period, record, plant);
  std::vector<std::optional<DampingReading>> histories;  // the whole record last
  for (const double periods : {1.0, 2.0, 3.0, 6.0}) {
    const double window = periods / the_case.reduction.first_frequency;
    histories.push_back(
        damping_by(fit::DecayTarget::time_history, first_part(record, window), plant));
  }
  const std::optional<DampingReading>& whole = histories.back();
  const bool by_peak = peak && peak->misfit <= largest_misfit;
  if (!by_peak && !whole)
    throw NoAnswer("the cable's decay does not determine plant.absorber_damping: set that key");
  const DampingReading& taken = by_peak ? *peak : *whole;
  AbsorberDampingFit found{
      by_peak ? fit::DecayTarget::first_peak_and_period : fit::DecayTarget::time_history,
      taken.fit,
      misfit_of(peak),
      misfit_of(whole),
      taken.value(),
      taken.value()};
  for (const auto& history : histories) {
    if (!history) continue;
    found.lowest = std::min(found.lowest, history->value());
    found.highest = std::max(found.highest, history->value());
  }
  return found;
}

std::string misfit_warning(const AbsorberDampingFit& found) {
  if (fit::is_measured(found.target)) return "";
  const TwoMass<double>& plant = found.fit.minima.front().plant;
  const double critical = 2.0 * std::sqrt(plant.absorber_stiffness * plant.absorber_mass);
  const std::string overdamped =
      plant.absorber_damping > critical ? "; above critical damping an absorber hardly swings" : "";
  return "no absorber_damping gives the two-mass plant the first peak and period of the continuous "
         "cable's decay; with the fitted absorber_damping the two decays differ by " +
         format_number(std::round(found.history_misfit * 100.0)) +
         " % of the initial displacement" + overdamped;
}

}  // namespace holdfast::program
