#include "case/model/linear_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/stability/boundary/circle_boundary.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude_gains.hpp"
#include "holdfast/stability/design/modal_design.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

/// The loop as a sum over its poles. Each part is computed on first use.
struct LinearLoop::ByPoles {
  explicit ByPoles(const Case& of) : case_(of) {}

  const ModalResponse<double>& response() const {
    return kept(response_, [this] { return command_response_of(case_); });
  }
  const UnitCircleCrossings<double>& circle() const {
    const ModalResponse<double>& of = response();
    return kept(circle_, [&of] { return UnitCircleCrossings<double>(of); });
  }
  const ConductorWithAbsorber& conductor() const {
    return kept(conductor_, [this] { return conductor_with_absorber_of(case_); });
  }
  ModalResponse<double> response_at(const Sampling<double>& sampling) const {
    return has_own_plant(case_) ? ModalResponse<double>(modal_plant_of(case_), sampling)
                                : modal_response(conductor(), sampling);
  }
  const LoopMap<double>& map() const {
    return kept(map_, [this] {
      const auto measured = loop_map(modal_plant_of(case_), sampling_of(case_));
      return hardware_of(case_).has_velocity_sensor ? measured
                                                    : with_velocity_by_difference(measured);
    });
  }

  mutable SharedCircles shared;  // of the periods that searches for the longest one try

 private:
  template <class Part, class Make>
  const Part& kept(std::optional<Part>& part, const Make& make) const {
    const std::lock_guard lock(guard_);
    if (!part) part.emplace(make());
    return *part;
  }

  const Case& case_;
  mutable std::mutex guard_;
  mutable std::optional<ModalResponse<double>> response_;
  mutable std::optional<UnitCircleCrossings<double>> circle_;
  mutable std::optional<ConductorWithAbsorber> conductor_;
  mutable std::optional<LoopMap<double>> map_;  // used only if roots are not found otherwise
};

LinearLoop::LinearLoop(const Case& the_case)
    : case_(the_case), by_poles_(std::make_shared<const ByPoles>(the_case)) {
  if (has_closed_forms(the_case)) closed_ = loop_of(the_case);
}

LinearLoop::~LinearLoop() = default;

std::vector<Interval<double>> LinearLoop::stable_gains(FreeGain free,
                                                       const PdGains<double>& gains) const {
  if (!closed_) return by_poles_->circle().stable_gains(free, gains);
  // `margins` uses the same crossings.
  return holdfast::stable_gains(loop_map(linear_plant(plant_of(case_)), closed_->sampling), free,
                                gains);
}

std::function<void(double, std::uint8_t*)> LinearLoop::stable_rows(const Axis& differential) const {
  if (!closed_)  // the circle is computed before threads use it
    return [=, kept = by_poles_, &circle = by_poles_->circle()](double p, std::uint8_t* flags) {
      fill_stability_row(circle, p, differential, flags);
    };
  StabilityRows<5> rows(in_half_plane(characteristic_polynomial(*closed_)), differential);
  return [=](double p, std::uint8_t* flags) mutable { rows.fill(p, flags); };
}

double LinearLoop::radius(const PdGains<double>& gains) const {
  if (closed_) return spectral_radius(closed_->engaged_map(gains));
  const std::complex<double> root = largest_loop_root(by_poles_->response(), gains);
  if (std::abs(root) > 0.0) return std::abs(root);
  const double excess = loop_excess_or_turn(by_poles_->response(), gains);
  if (std::isfinite(excess)) return 1.0 + excess;
  return spectral_radius(by_poles_->map().closed_map(gains));
}

std::vector<BoundaryPoint<double>> LinearLoop::boundary(
    const Interval<double>& proportional) const {
  return closed_ ? stability_boundary(characteristic_polynomial(*closed_), proportional)
                 : stability_boundary(by_poles_->response(), proportional);
}

SteadyResponse<double> LinearLoop::response(double frequency) const {
  const double omega = 2.0 * pi<double> * frequency;
  return steady_response_of(case_, sampling_of(case_), force_hold_of(case_), omega)
      .relative_to(true_amplitude_of(case_, omega));
}

void LinearLoop::require_poles() const {
  if (closed_ || by_poles_->response().at_radius(0.0)) return;
  loop_poles_of(case_);  // throws with a more specific message, if it can
  throw NoAnswer(
      "two poles of the loop nearly coincide and cannot be separated: change a parameter of the "
      "plant by a thousandth");
}

MinimumAmplitude LinearLoop::quietest(const AmplitudeOptions& options, double frequency,
                                      double p) const {
  if (closed_) return minimum_amplitude(plant_of(case_), options, frequency, p);
  require_poles();
  return minimum_amplitude(by_poles_->response(), options, frequency, p, response(frequency));
}

MinimumAmplitudeGains LinearLoop::quietest_pair(const AmplitudeOptions& options,
                                                double frequency) const {
  require_poles();
  return minimum_amplitude_gains(by_poles_->response(), options, frequency,
                                 range_about_tuned(frequency), response(frequency));
}

Interval<double> LinearLoop::range_about_tuned(double frequency) const {
  const auto& plant = case_.plant;
  const double omega = 2.0 * pi<double> * frequency;
  const double tuned =
      tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);
  const double stiffness = plant.absorber_stiffness + plant.absorber_mass * omega * omega;
  return {tuned - stiffness, tuned + stiffness};
}

double LinearLoop::first_frequency() const {
  if (!closed_) return by_poles_->conductor().modes.front().angular_frequency / (2.0 * pi<double>);
  const TwoMass<double> plant = plant_of(case_);
  return std::sqrt(plant.conductor_stiffness / plant.conductor_mass) / (2.0 * pi<double>);
}

namespace {

/// Gains with the least worst amplitude of a family over its band; `admissible` gives D at each P.
template <class Family, class Admissible>
MinimaxGains quietest_of(Family family, const Admissible& admissible, std::optional<double> p,
                         const Interval<double>& range) {
  MinimaxGains best{std::nan(""), {MinimaxOutcome::none}};
  double least = std::numeric_limits<double>::infinity();
  const auto ask = [&](double at) {
    const MinimaxAmplitude there = family.least(at, admissible(at), least);
    if (there.outcome == MinimaxOutcome::none) return std::numeric_limits<double>::infinity();
    if (there.worst_ratio < least) {
      least = there.worst_ratio;
      best = {at, there};
    }
    return there.lower_bound;
  };
  if (p)
    ask(*p);
  else
    detail::search_proportional_gain(range, ask);
  return best;
}

}  // namespace

MinimaxGains LinearLoop::quietest_for_all(const std::vector<LinearLoop>& loops,
                                          const std::vector<AmplitudeOptions>& options,
                                          const FrequencyBand& band, std::optional<double> p) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  const auto range = loops.front().range_about_tuned(0.5 * (band.lower + band.upper));
  std::vector<detail::ModulusLevels<double>::Series> nearby(loops.size());
  const auto admissible = [&](double at) {
    std::vector<Interval<double>> common{{-unbounded, unbounded}};
    for (std::size_t k = 0; k < loops.size() && !common.empty(); ++k)
      common = intersection(common, detail::gains_of_modulus(loops[k].by_poles_->circle(), at,
                                                             options[k], nearby[k]));
    return common;
  };
  std::vector<PlantOverBand<TwoMass<double>>> masses;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    loops[k].require_poles();
    if (loops[k].closed_) masses.push_back({plant_of(loops[k].case_), options[k]});
  }
  if (masses.size() == loops.size())
    return quietest_of(FamilyOverBand<PlantOverBand<TwoMass<double>>>(masses, band), admissible, p,
                       range);
  std::vector<ConductorOverBand<double>> conductors;
  conductors.reserve(loops.size());
  for (std::size_t k = 0; k < loops.size(); ++k)
    conductors.push_back({loops[k].by_poles_->conductor(), options[k]});
  return quietest_of(FamilyOverBand<ConductorOverBand<double>>(conductors, band), admissible, p,
                     range);
}

MinimaxAmplitude LinearLoop::quietest_over(const AmplitudeOptions& options, double p,
                                           const FrequencyBand& band) const {
  return closed_ ? minimax_amplitude(plant_of(case_), options, p, band)
                 : modal_minimax_amplitude(by_poles_->conductor(), options, p, band);
}

MinimumRadius LinearLoop::fastest(double p) const {
  require_poles();
  return closed_ ? minimum_radius(*closed_, p) : minimum_radius(by_poles_->response(), p);
}

MaxDelay LinearLoop::longest_period(const MaxDelayOptions& question) const {
  if (closed_) return max_sampling_period(plant_of(case_), question);
  if (has_own_plant(case_)) return max_sampling_period(modal_plant_of(case_), question);
  return modal_max_sampling_period(by_poles_->conductor(), question, 1.03, &by_poles_->shared);
}

std::vector<Interval<double>> LinearLoop::stable_gains(const MaxDelayOptions& question,
                                                       double period) const {
  if (closed_) return feasible_differential_gains(plant_of(case_), question, period);
  const UnitCircleCrossings<double> circle(by_poles_->response_at(question.sampling(period)));
  return circle.stable_gains(FreeGain::differential, {question.proportional_gain, 0.0});
}

double LinearLoop::excess(const Sampling<double>& sampling, const PdGains<double>& gains) const {
  if (closed_) return loop_polynomial(sampled_loop(plant_of(case_), sampling)).excess(gains);
  return loop_excess_or_turn(by_poles_->response_at(sampling), gains);
}

StabilityMargins LinearLoop::margins(const PdGains<double>& gains, bool of_delay) const {
  const Sampling<double> sampling = sampling_of(case_);
  MarginSearch search;
  search.of_delay = of_delay;
  if (closed_) return stability_margins(plant_of(case_), sampling, gains, search);
  search.longest_period_ratio = 100.0;
  return modal_stability_margins(loop_poles_of(case_), sampling, gains, search,
                                 hardware_of(case_).has_velocity_sensor);
}

LoopMargins LinearLoop::whole_margins(const PdGains<double>& gains) const {
  const Sampling<double> sampling = sampling_of(case_);
  if (closed_) return loop_margins(plant_of(case_), sampling, gains);
  return modal_loop_margins(loop_poles_of(case_), sampling, gains,
                            hardware_of(case_).has_velocity_sensor);
}

}  // namespace holdfast::program
