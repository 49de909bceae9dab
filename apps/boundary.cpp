#include "holdfast/stability/boundary.hpp"
#include "axis.hpp"
#include "holdfast/stability/characteristic_polynomial.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::string p = "-1000:200";
  bool continuous = false;
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

void run(const JobContext& context, const Options& options) {
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

}  // namespace

void add_boundary(CLI::App& program) {
  const Job job(program, "boundary", question::gains,
                "Exact curves on which a characteristic root leaves the stable region");
  const auto options = std::make_shared<Options>();
  job.add_text("--p", options->p, "Range of proportional gains P, MIN:MAX, N/m");
  job->add_flag("--continuous", options->continuous,
                "Without sampling: the continuous loop; the angle column then holds rad/s");
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
