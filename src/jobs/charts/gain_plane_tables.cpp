#include "jobs/charts/gain_plane_tables.hpp"

#include <string>

#include "case/model/plant_of_case.hpp"
#include "case/model/sampled_loop_of_case.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/boundary/stable_regions.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "jobs/charts/boundary_names.hpp"
#include "jobs/charts/conditioning.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

const char* word_for(BoundaryFeatureKind kind) {
  switch (kind) {
    case BoundaryFeatureKind::vertical_tangent:
      return "vertical_tangent";
    case BoundaryFeatureKind::horizontal_tangent:
      return "horizontal_tangent";
    case BoundaryFeatureKind::cusp:
      return "cusp";
    case BoundaryFeatureKind::crossing:
      return "crossing";
    case BoundaryFeatureKind::end:
      return "end";
  }
  return "";
}

/// Extended precision leaves single points exact to the last digit of a double but where two of
/// them are about to meet.
using Precise = long double;

TwoMass<Precise> precise_plant(const Case& the_case) {
  return converted<Precise>(plant_of(the_case));
}

AffinePolynomial<Precise, 4> precise_continuous_polynomial(const Case& the_case) {
  return characteristic_polynomial(precise_plant(the_case));
}

AffinePolynomial<Precise, 5> precise_sampled_polynomial(const Case& the_case) {
  const Sampling<double> sampling = sampling_of(the_case);
  return characteristic_polynomial(sampled_loop(
      precise_plant(the_case), Sampling<Precise>{sampling.period, sampling.processing_delay}));
}

/// Of D, as wide as a window may be (N s/m).
constexpr DifferentialRange every_gain{-1e150, 1e150};

std::vector<BoundaryFeature<Precise>> precise_features(const Case& the_case,
                                                       const GainWindow& window, bool continuous) {
  return continuous ? boundary_features(precise_continuous_polynomial(the_case), window)
                    : boundary_features(precise_sampled_polynomial(the_case), window);
}

/// One of the two gains, as the program writes and says it.
struct GainName {
  const char* column;
  const char* symbol;
  const char* unit;
};

const GainName proportional{"proportional_gain", "P", "N/m"};
const GainName differential{"differential_gain", "D", "N s/m"};

/// The stable intervals of one gain at one value of the other.
struct GainPlane {
  const GainName& gain;
  const GainName& fixed;
  double value;
  std::vector<Interval<Precise>> intervals;

  std::string refusal() const {
    return std::string("no ") + gain.symbol + " stabilises the loop at " + fixed.symbol + " = " +
           format_number(value) + " " + fixed.unit;
  }
};

template <int Degree>
std::vector<GainPlane> answers(const AffinePolynomial<Precise, Degree>& polynomial,
                               const FixedGains& fixed) {
  std::vector<GainPlane> result;
  for (const double p : fixed.proportional) {
    result.push_back(
        {differential, proportional, p, stable_differential_gains(polynomial, Precise(p))});
  }
  for (const double d : fixed.differential) {
    result.push_back(
        {proportional, differential, d, stable_proportional_gains(polynomial, Precise(d))});
  }
  return result;
}

/// The refusals of those without an interval, each on its own or, when there is no other, as one.
void report_refusals(const std::vector<GainPlane>& all, bool quiet) {
  std::vector<std::string> refusals;
  std::string together;
  for (const GainPlane& answer : all) {
    if (!answer.intervals.empty()) continue;
    refusals.push_back(answer.refusal());
    together += (together.empty() ? "" : "; ") + answer.refusal();
  }
  if (refusals.size() == all.size()) throw NoAnswer(together);
  for (const std::string& refusal : refusals) report_warning(refusal, quiet);
}

const char* angle_unit(bool continuous) { return continuous ? "rad/s" : "rad"; }

const char* angle_description(bool continuous) {
  return continuous ? "angular frequency of the root pair" : "angle of the root on the unit circle";
}

}  // namespace

void write_boundary(const JobContext& context, const ProportionalRange& gains, bool continuous) {
  const Case& the_case = context.case_data;
  report_warning(near_cusp_warning(precise_features(the_case, {gains, every_gain}, continuous)),
                 context.quiet);
  const auto points = continuous
                          ? stability_boundary(characteristic_polynomial(plant_of(the_case)), gains)
                          : stability_boundary(characteristic_polynomial(loop_of(the_case)), gains);
  Table table(context, {{"curve", "", "which characteristic root is on the boundary", "string"},
                        {"angle_rad", angle_unit(continuous), angle_description(continuous)},
                        {"proportional_gain", "N/m", "P"},
                        {"differential_gain", "N.s/m", "D"}});
  for (const auto& point : points) {
    table.row(name_of(point.curve), point.angle, point.gains.proportional,
              point.gains.differential);
  }
  table.commit();
}

void write_boundary_features(const JobContext& context, const GainWindow& window, bool continuous) {
  const Case& the_case = context.case_data;
  const auto features = precise_features(the_case, window, continuous);
  const std::string unit = angle_unit(continuous), description = angle_description(continuous);
  Table table(context, {{"feature", "", "what is special about the point", "string"},
                        {"first_curve", "", "a curve through it", "string"},
                        {"first_angle_rad", unit, description + " on the first curve"},
                        {"second_curve", "", "the other curve; the same where one is", "string"},
                        {"second_angle_rad", unit, description + " on the second curve"},
                        {"proportional_gain", "N/m", "P"},
                        {"differential_gain", "N.s/m", "D"}});
  report_warning(near_cusp_warning(features), context.quiet);
  for (const BoundaryFeature<Precise>& feature : features) {
    table.row(word_for(feature.kind), name_of(feature.first.curve),
              static_cast<double>(feature.first.angle), name_of(feature.second.curve),
              static_cast<double>(feature.second.angle),
              static_cast<double>(feature.gains.proportional),
              static_cast<double>(feature.gains.differential));
  }
  table.commit();
}

void write_stable_intervals(const JobContext& context, const FixedGains& fixed, bool continuous) {
  const Case& the_case = context.case_data;
  const std::vector<GainPlane> all = continuous
                                         ? answers(precise_continuous_polynomial(the_case), fixed)
                                         : answers(precise_sampled_polynomial(the_case), fixed);
  Table table(context, {{"gain", "", "the gain that the interval is of", "string"},
                        {"other_gain", "", "the other gain, held: P in N/m, D in N s/m"},
                        {"lower", "", "lower end: D in N s/m, P in N/m; -inf: none"},
                        {"upper", "", "upper end: D in N s/m, P in N/m; inf: none"}});
  report_refusals(all, context.quiet);
  for (const GainPlane& answer : all) {
    for (const Interval<Precise>& interval : answer.intervals) {
      table.row(answer.gain.column, answer.value, static_cast<double>(interval.lower),
                static_cast<double>(interval.upper));
    }
  }
  table.commit();
}

void write_gain_regions(const JobContext& context, const GainWindow& window, bool continuous) {
  const Case& the_case = context.case_data;
  const auto regions = continuous
                           ? gain_regions(characteristic_polynomial(plant_of(the_case)), window)
                           : gain_regions(characteristic_polynomial(loop_of(the_case)), window);
  Table table(context, {{"unstable_roots", "", "0: asymptotically stable", "integer"},
                        {"area", "N2.s/m2", "of the region within the window"},
                        {"proportional_gain", "N/m", "P of a point inside"},
                        {"differential_gain", "N.s/m", "D of a point inside"},
                        {"proportional_min", "N/m", "least P of the region"},
                        {"proportional_max", "N/m", "largest P of the region"},
                        {"differential_min", "N.s/m", "least D of the region"},
                        {"differential_max", "N.s/m", "largest D of the region"},
                        {"at_edge", "", "1: reaches the window's edge, 0: not", "integer"}});
  for (const GainRegion<double>& region : regions) {
    table.row(region.unstable_roots, region.area, region.inside.proportional,
              region.inside.differential, region.proportional.lower, region.proportional.upper,
              region.differential.lower, region.differential.upper, region.at_edge ? 1 : 0);
  }
  table.commit();
}

}  // namespace holdfast::program
