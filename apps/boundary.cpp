#include "holdfast/stability/boundary.hpp"
#include "axis.hpp"
#include "errors.hpp"
#include "holdfast/stability/characteristic_polynomial.hpp"
#include "holdfast/stability/stable_intervals.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "table.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::string p = "-1000:200";
  bool continuous = false;
  bool stable_interval = false;
};

const char* name_of(BoundaryCurve curve) {
  switch (curve) {
    case BoundaryCurve::plus_one:
      return "plus_one";
    case BoundaryCurve::minus_one:
      return "minus_one";
    case BoundaryCurve::complex_pair:
      return "complex_pair";
    case BoundaryCurve::zero:
      return "zero";
    case BoundaryCurve::imaginary_pair:
      return "imaginary_pair";
  }
  return "";
}

void run_curves(const JobContext& context, const Options& options) {
  const Range range = parse_range("--p", options.p);
  const ProportionalRange gains{range.min, range.max};
  const auto points =
      options.continuous
          ? stability_boundary(characteristic_polynomial(plant_of(context.case_data)), gains)
          : stability_boundary(characteristic_polynomial(loop_of(context.case_data)), gains);
  Table table(context, {{"curve", "", "which characteristic root is on the boundary", "string"},
                        {"angle_rad", options.continuous ? "rad/s" : "rad",
                         options.continuous ? "angular frequency of the root pair"
                                            : "angle of the root on the unit circle"},
                        {"proportional_gain", "N/m", "P"},
                        {"differential_gain", "N.s/m", "D"}});
  for (const auto& point : points) {
    table.row(name_of(point.curve), point.angle, point.gains.proportional,
              point.gains.differential);
  }
  table.commit();
}

using Precise = long double;
using Intervals = std::vector<Interval<Precise>>;

TwoDof<Precise> in_extended_precision(const TwoDof<double>& plant) {
  return {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
          plant.absorber_mass,  plant.absorber_stiffness,  plant.absorber_damping};
}

/// The intervals of both gains.
struct GainIntervals {
  Intervals differential;
  Intervals proportional;
};

/// In extended precision, which leaves the ends exact to the last digit but where two of them are
/// about to meet.
template <class Polynomial>
GainIntervals intervals_of(const Polynomial& polynomial, const PdGains<double>& gains) {
  return {stable_differential_gains(polynomial, Precise(gains.proportional)),
          stable_proportional_gains(polynomial, Precise(gains.differential))};
}

GainIntervals intervals_of(const Case& the_case, bool continuous) {
  const TwoDof<Precise> plant = in_extended_precision(plant_of(the_case));
  const PdGains<double> gains = gains_of(the_case);
  if (continuous) return intervals_of(characteristic_polynomial(plant), gains);
  const Sampling<double> sampling = sampling_of(the_case);
  const auto loop =
      sampled_loop(plant, Sampling<Precise>{sampling.period, sampling.processing_delay});
  return intervals_of(characteristic_polynomial(loop), gains);
}

void run_intervals(const JobContext& context, const Options& options) {
  const PdGains<double> gains = gains_of(context.case_data);
  const GainIntervals stable = intervals_of(context.case_data, options.continuous);
  if (stable.differential.empty() && stable.proportional.empty()) {
    throw NoAnswer("no D stabilises the loop at P = " + format_number(gains.proportional) +
                   " N/m, and no P at D = " + format_number(gains.differential) + " N s/m");
  }
  Table table(context, {{"gain", "", "the gain that the interval is of", "string"},
                        {"other_gain", "", "the other gain, held: P in N/m, D in N s/m"},
                        {"lower", "", "lower end: D in N s/m, P in N/m; -inf: none"},
                        {"upper", "", "upper end: D in N s/m, P in N/m; inf: none"}});
  const auto write = [&table](const char* gain, double other, const Intervals& intervals) {
    for (const Interval<Precise>& interval : intervals) {
      table.row(gain, other, static_cast<double>(interval.lower),
                static_cast<double>(interval.upper));
    }
  };
  write("differential_gain", gains.proportional, stable.differential);
  write("proportional_gain", gains.differential, stable.proportional);
  table.commit();
}

}  // namespace

void add_boundary(CLI::App& program) {
  const Job job(program, "boundary", question::gains,
                "Exact curves on which a characteristic root leaves the stable region");
  const auto options = std::make_shared<Options>();
  job.add_text("--p", options->p, "Range of proportional gains P, MIN:MAX, N/m");
  job->add_flag("--continuous", options->continuous,
                "Without sampling: the continuous loop; the angle column then holds rad/s");
  job->add_flag("--stable-interval", options->stable_interval,
                "The stable intervals of D at the case's P and of P at the case's D instead");
  job->final_callback([job, options] {
    options->stable_interval ? run_intervals(job.context(), *options)
                             : run_curves(job.context(), *options);
  });
}

}  // namespace holdfast::program
