#include "holdfast/stability/boundary/boundary.hpp"
#include "case/axes/axis.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/boundary/stable_regions.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "job.hpp"
#include "jobs/charts/names.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {
namespace {

/// Fixed gains for the stable intervals of the other gain.
struct FixedGains {
  std::vector<double> proportional;  ///< values of P (N/m) for which intervals of D are sought
  std::vector<double> differential;  ///< values of D (N s/m) for which intervals of P are sought
};

/// Calls `visit` with the characteristic polynomial of the continuous or the sampled loop.
template <class Visit>
auto with_polynomial(const Case& the_case, bool continuous, const Visit& visit) {
  const TwoMass<double> plant = plant_of(the_case);
  if (continuous) return visit(characteristic_polynomial(plant));
  return visit(characteristic_polynomial(sampled_loop(plant, sampling_of(the_case))));
}

/// Name, symbol and unit of one of the two gains.
struct GainName {
  const char* column;
  const char* symbol;
  const char* unit;
};

const GainName proportional{"proportional_gain", "P", "N/m"};
const GainName differential{"differential_gain", "D", "N s/m"};

/// The stable intervals of one gain for a given value of the other gain.
struct GainPlane {
  const GainName& gain;
  const GainName& fixed;
  double value;
  std::vector<Interval<double>> intervals;

  std::string refusal() const {
    return std::string("no ") + gain.symbol + " stabilises the loop at " + fixed.symbol + " = " +
           format_number(value) + " " + fixed.unit;
  }
};

/// The continuous loop of two masses.
struct ContinuousLoop {
  AffinePolynomial<double, 4> polynomial;

  std::vector<Interval<double>> stable_gains(FreeGain free, const PdGains<double>& gains) const {
    return free == FreeGain::differential
               ? stable_differential_gains(polynomial, gains.proportional)
               : stable_proportional_gains(polynomial, gains.differential);
  }
};

/// Stable intervals for all fixed gains, by a loop with a member stable_gains().
template <class Loop>
std::vector<GainPlane> answers_by(const Loop& loop, const FixedGains& fixed) {
  std::vector<GainPlane> result;
  for (const double p : fixed.proportional)
    result.push_back(
        {differential, proportional, p, loop.stable_gains(FreeGain::differential, {p, 0.0})});
  for (const double d : fixed.differential)
    result.push_back(
        {proportional, differential, d, loop.stable_gains(FreeGain::proportional, {0.0, d})});
  return result;
}

std::vector<GainPlane> answers(const Case& the_case, const FixedGains& fixed, bool continuous) {
  if (!continuous) return answers_by(LinearLoop(the_case), fixed);
  return answers_by(ContinuousLoop{characteristic_polynomial(plant_of(the_case))}, fixed);
}

/// Warning if the end of an interval moves by more than 1 % with other modes; else empty.
std::string truncation_warning(const Case& the_case, const FixedGains& fixed,
                               const std::vector<GainPlane>& found) {
  const OtherModes other = other_modes_of(the_case);
  const std::vector<GainPlane> others = answers_by(other.circle, fixed);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& here = found[i].intervals;
    const auto& there = others[i].intervals;
    const auto differs = [](double one, double two) {
      return !(std::abs(one - two) <= 0.01 * std::max(std::abs(one), std::abs(two)));
    };
    const auto moved = [&](std::size_t k) {
      return differs(here[k].lower, there[k].lower) || differs(here[k].upper, there[k].upper);
    };
    const std::string at = std::string("at ") + found[i].fixed.symbol + " = " +
                           format_number(found[i].value) + " " + found[i].fixed.unit + " ";
    if (here.size() != there.size())
      return "the result depends on the modes used: " + at + other.words + " there are " +
             std::to_string(there.size()) + " stable intervals, not " + std::to_string(here.size());
    for (std::size_t k = 0; k < here.size(); ++k)
      if (moved(k))
        return "the result depends on the modes used: " + at + other.words + " the interval is " +
               range_text(format_rounded(there[k].lower), format_rounded(there[k].upper)) + " " +
               found[i].gain.unit;
  }
  return "";
}

/// Warns of each fixed gain without a stable interval; throws NoAnswer if no gain has one.
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

/// Replacements of @KEY@ in the texts of columns with angles or frequencies.
Values angle_words(bool continuous) {
  if (continuous) return {{"unit", "rad/s"}, {"angle", "angular frequency of the root pair"}};
  return {{"unit", "rad"}, {"angle", "angle of the root on the unit circle"}};
}

void write_boundary(const JobContext& context, const Interval<double>& gains, bool continuous) {
  const Case& the_case = context.case_data;
  const auto points = continuous
                          ? stability_boundary(characteristic_polynomial(plant_of(the_case)), gains)
                          : LinearLoop(the_case).boundary(gains);
  Table table(context, columns_of("boundary", angle_words(continuous)));
  for (const auto& point : points) {
    table.row(name_in(curve_names, point.curve), point.angle, point.gains.proportional,
              point.gains.differential);
  }
  table.commit();
}

/// Writes one row per stable interval: of D at each fixed P, then of P at each fixed D. Warns of a
/// fixed gain without a stable interval.
void write_stable_intervals(const JobContext& context, const FixedGains& fixed, bool continuous) {
  const std::vector<GainPlane> all = answers(context.case_data, fixed, continuous);
  Table table(context, columns_of("stable intervals"));
  report_refusals(all, context.quiet);
  if (!is_two_masses(context.case_data))
    report_warning(truncation_warning(context.case_data, fixed, all), context.quiet);
  for (const GainPlane& answer : all) {
    for (const Interval<double>& interval : answer.intervals)
      table.row(answer.gain.column, answer.value, interval.lower, interval.upper);
  }
  table.commit();
}

/// Writes one row per region of the window; stable regions first, large regions first.
void write_gain_regions(const JobContext& context, const GainWindow& window, bool continuous) {
  const auto regions = with_polynomial(context.case_data, continuous, [&](const auto& polynomial) {
    return gain_regions(polynomial, window);
  });
  Table table(context, columns_of("gain regions"));
  for (const GainRegion<double>& region : regions) {
    table.row(region.unstable_roots, region.area, region.inside.proportional,
              region.inside.differential, region.proportional.lower, region.proportional.upper,
              region.differential.lower, region.differential.upper, region.at_edge ? 1 : 0);
  }
  table.commit();
}

struct BoundaryQuestion {
  std::string p = "-1000:200";
  std::string d = "-40:20";
  bool continuous = false, stable_interval = false, regions = false;
  bool prove = false;

  void add_to(const Job& job) {
    job.add("--p", p);
    job.add("--d", d);
    job.add("--continuous", continuous);
    job.add("--stable-interval", stable_interval);
    job.add("--regions", regions);
    job.add("--prove", prove);
  }

  void run(const Job& job) {
    const JobContext context = job.context();
    p = shown_gains(context, "--p", p);
    d = shown_gains(context, "--d", d);
    if (prove)
      throw WrongInput("--prove needs both --stable-interval and --family: add the missing option");
    if (stable_interval) {
      write_stable_intervals(context, fixed_gains(job, context.case_data), continuous);
    } else if (regions) {
      write_gain_regions(context, window(), continuous);
    } else if (job.has("--d")) {
      throw WrongInput("--d needs --stable-interval or --regions: add one of them");
    } else {
      write_boundary(context, proportional_range(), continuous);
    }
  }

  Interval<double> proportional_range() const {
    const Range range = parse_range("--p", p);
    return {range.min, range.max};
  }
  GainWindow window() const {
    const Range range = parse_range("--d", d);
    return {proportional_range(), {range.min, range.max}};
  }
  /// The fixed gains of the options; the case's own gains if neither option is given.
  FixedGains fixed_gains(const Job& job, const Case& the_case) const {
    const PdGains<double> own = gains_of(the_case);
    if (!job.has("--p") && !job.has("--d")) return {{own.proportional}, {own.differential}};
    FixedGains fixed;
    if (job.has("--p")) fixed.proportional = parse_list("--p", p);
    if (job.has("--d")) fixed.differential = parse_list("--d", d);
    return fixed;
  }
};

}  // namespace

void add_boundary(CLI::App& program) { add_job<BoundaryQuestion>(program, "boundary"); }

}  // namespace holdfast::program
