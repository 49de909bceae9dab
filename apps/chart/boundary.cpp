#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/boundary/stable_regions.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "jobs/charts/boundary_names.hpp"
#include "jobs/charts/conditioning.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

/// Gains at which the stable intervals of the other gain are asked for.
struct FixedGains {
  std::vector<double> proportional;  ///< P (N/m): the intervals of D
  std::vector<double> differential;  ///< D (N s/m): the intervals of P
};

constexpr Named<BoundaryFeatureKind> feature_names[] = {
    {BoundaryFeatureKind::vertical_tangent, "vertical_tangent"},
    {BoundaryFeatureKind::horizontal_tangent, "horizontal_tangent"},
    {BoundaryFeatureKind::cusp, "cusp"},
    {BoundaryFeatureKind::crossing, "crossing"},
    {BoundaryFeatureKind::end, "end"}};

/// Extended precision leaves single points exact to the last digit of a double but where two of
/// them are about to meet.
using Precise = long double;

AffinePolynomial<Precise, 4> precise_continuous_polynomial(const Case& the_case) {
  return characteristic_polynomial(converted<Precise>(plant_of(the_case)));
}

AffinePolynomial<Precise, 5> precise_sampled_polynomial(const Case& the_case) {
  const Sampling<double> sampling = sampling_of(the_case);
  return characteristic_polynomial(
      sampled_loop(converted<Precise>(plant_of(the_case)),
                   Sampling<Precise>{sampling.period, sampling.processing_delay}));
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
  for (const double p : fixed.proportional)
    result.push_back(
        {differential, proportional, p, stable_differential_gains(polynomial, Precise(p))});
  for (const double d : fixed.differential)
    result.push_back(
        {proportional, differential, d, stable_proportional_gains(polynomial, Precise(d))});
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
    table.row(name_in(curve_names, point.curve), point.angle, point.gains.proportional,
              point.gains.differential);
  }
  table.commit();
}

/// Tangents, cusps, crossings and ends of the curves within the window.
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
    table.row(name_in(feature_names, feature.kind), name_in(curve_names, feature.first.curve),
              static_cast<double>(feature.first.angle), name_in(curve_names, feature.second.curve),
              static_cast<double>(feature.second.angle),
              static_cast<double>(feature.gains.proportional),
              static_cast<double>(feature.gains.differential));
  }
  table.commit();
}

/// One row for every stable interval: of D at each P, then of P at each D. A gain at which nothing
/// stabilises the loop is warned of, since its row is missing.
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

/// One row for every region of the window, the stable ones first, the larger first.
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

struct BoundaryOptions {
  std::string p = "-1000:200";
  std::string d = "-40:20";
  bool p_given = false, d_given = false, continuous = false;
  bool stable_interval = false, regions = false, features = false;
};

ProportionalRange proportional_range(const BoundaryOptions& options) {
  const Range range = parse_range("--p", options.p);
  return {range.min, range.max};
}

GainWindow window(const BoundaryOptions& options) {
  const Range d = parse_range("--d", options.d);
  return {proportional_range(options), {d.min, d.max}};
}

/// The gains of the options; the case's own where neither is given.
FixedGains fixed_gains(const JobContext& context, const BoundaryOptions& options) {
  const PdGains<double> own = gains_of(context.case_data);
  if (!options.p_given && !options.d_given) return {{own.proportional}, {own.differential}};
  FixedGains fixed;
  if (options.p_given) fixed.proportional = parse_list("--p", options.p);
  if (options.d_given) fixed.differential = parse_list("--d", options.d);
  return fixed;
}

void run(const JobContext& context, const BoundaryOptions& options) {
  const bool continuous = options.continuous;
  if (options.stable_interval) {
    write_stable_intervals(context, fixed_gains(context, options), continuous);
  } else if (options.regions) {
    write_gain_regions(context, window(options), continuous);
  } else if (options.features) {
    write_boundary_features(context, window(options), continuous);
  } else if (options.d_given) {
    throw WrongInput("--d goes with --stable-interval, --regions or --features");
  } else {
    write_boundary(context, proportional_range(options), continuous);
  }
}

}  // namespace

void add_boundary(CLI::App& program) {
  const Job job(program, "boundary", question::gains,
                "Exact curves on which a characteristic root leaves the stable region");
  const auto options = std::make_shared<BoundaryOptions>();
  job.add_text("--p", options->p,
               "Proportional gains P, MIN:MAX, N/m; with --stable-interval P or P,P,…");
  job.add_text("--d", options->d, "Window in D, MIN:MAX, N s/m; with --stable-interval D or D,D,…");
  job->add_flag("--continuous", options->continuous,
                "Without sampling: the continuous loop; angle columns then hold rad/s");
  CLI::Option* intervals = job->add_flag(
      "--stable-interval", options->stable_interval,
      "Instead, stable D at P and stable P at D; without --p and --d at the case's gains");
  CLI::Option* regions =
      job->add_flag("--regions", options->regions, "Instead, the regions of the window --p, --d");
  job->add_flag("--features", options->features,
                "Instead, tangents, cusps, crossings and ends of the curves in the window");
  job->get_option("--features")->excludes(intervals)->excludes(regions);
  regions->excludes(intervals);
  job->final_callback([job, options] {
    options->p_given = job->count("--p") > 0;
    options->d_given = job->count("--d") > 0;
    run(job.context(), *options);
  });
}

}  // namespace holdfast::program
