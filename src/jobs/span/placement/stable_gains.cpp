#include "jobs/span/placement/stable_gains.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace holdfast::program {
namespace {

/// Widens an interval by others, up to a bound of |gain|.
void widen(Interval<double>& interval, const std::vector<Interval<double>>& others, double most) {
  for (const Interval<double>& other : others) {
    interval.lower = std::min(interval.lower, std::max(other.lower, -most));
    interval.upper = std::max(interval.upper, std::min(other.upper, most));
  }
}

}  // namespace

StableGains::StableGains(const Case& the_case, double margin)
    : judge_(judged_loop_of(the_case)), cut_(cut_loop_of(the_case)), margin_(margin) {
  for (const auto* circle : {&judge_.circle, &cut_.circle})
    for (const auto& place : circle->places()) responses_.push_back(place.g);
}

bool StableGains::admits(const PdGains<double>& gains) const {
  for (const CommandResponse<double>& g : responses_) {
    const std::complex<double> p =
        1.0 - gains.proportional * g.displacement - gains.differential * g.velocity;
    if (!(std::norm(p) >= margin_ * margin_)) return false;
  }
  return is_stable(gains);
}

std::vector<Interval<double>> StableGains::along(FreeGain free, const PdGains<double>& held) const {
  const bool by_d = free == FreeGain::differential;
  const double margin = std::max(margin_, 0.01);
  std::vector<Interval<double>> nearer;
  for (const CommandResponse<double>& g : responses_) {
    const std::complex<double> moving = by_d ? g.velocity : g.displacement;
    const std::complex<double> rest =
        1.0 - (by_d ? held.proportional * g.displacement : held.differential * g.velocity);
    // |rest − x moving|² = |rest|² − 2 x middle + x² slope < margin².
    const double slope = std::norm(moving), middle = (rest * std::conj(moving)).real();
    const double root = middle * middle - slope * (std::norm(rest) - margin * margin);
    if (!(root > 0.0) || !(slope > 0.0)) continue;
    nearer.push_back({(middle - std::sqrt(root)) / slope, (middle + std::sqrt(root)) / slope});
  }
  std::sort(nearer.begin(), nearer.end(),
            [](const auto& one, const auto& other) { return one.lower < other.lower; });
  // Between them no root can pass through the circle: where one pair is stable, all are.
  std::vector<Interval<double>> kept;
  for (std::size_t k = 0; k + 1 < nearer.size(); ++k) {
    nearer[k + 1].upper = std::max(nearer[k].upper, nearer[k + 1].upper);
    const Interval<double> between{nearer[k].upper, nearer[k + 1].lower};
    const double middle = 0.5 * (between.lower + between.upper);
    if (between.lower < between.upper &&
        is_stable(by_d ? PdGains<double>{held.proportional, middle}
                       : PdGains<double>{middle, held.differential}))
      kept.push_back(between);
  }
  return kept;
}

GainWindow StableGains::around(const PdGains<double>& most) const {
  GainWindow found{{0.0, 0.0}, {0.0, 0.0}};
  for (const int lines : {5, 9}) {
    const auto at = [&](const Interval<double>& range, int k) {
      return range.lower + (range.upper - range.lower) * (k + 0.5) / lines;
    };
    Interval<double> wider = found.differential;
    for (int k = 0; k < lines; ++k)
      widen(wider, along(FreeGain::differential, {at(found.proportional, k), 0.0}),
            most.differential);
    found.differential = wider;
    wider = found.proportional;
    for (int k = 0; k < lines; ++k)
      widen(wider, along(FreeGain::proportional, {0.0, at(found.differential, k)}),
            most.proportional);
    found.proportional = wider;
  }
  // A corner may reach out between two lines.
  constexpr double beyond = 0.1;
  for (Interval<double>* range : {&found.proportional, &found.differential}) {
    const double spare = beyond * (range->upper - range->lower);
    *range = {range->lower - spare, range->upper + spare};
  }
  return found;
}

}  // namespace holdfast::program
