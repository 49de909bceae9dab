#include "axis.hpp"
#include "holdfast/stability/characteristic_polynomial.hpp"
#include "holdfast/stability/chart.hpp"
#include "holdfast/stability/spectral_radius.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::string p = "-1000:200:121";
  std::string d = "-40:20:121";
  bool continuous = false;
  bool radius = false;
};

std::vector<Column> columns(const Options& options) {
  std::vector<Column> result = {{"proportional_gain", "N/m", "P"},
                                {"differential_gain", "N.s/m", "D"},
                                {"stable", "", "1: asymptotically stable, 0: not", "integer"}};
  if (!options.radius) return result;
  if (options.continuous) {
    result.push_back({"spectral_abscissa", "1/s", "largest real part of a characteristic root"});
  } else {
    result.push_back({"spectral_radius", "", "largest modulus of a characteristic root"});
  }
  return result;
}

double growth(const Options& options, const TwoDof<double>& plant, const SampledLoop<double>& loop,
              const PdGains<double>& gains) {
  if (!options.continuous) return spectral_radius<double, 5>(loop.engaged_map(gains));
  const Matrix<double, 4> closed =
      plant.state_matrix() + plant.control_input() * gains.feedback_row();
  return spectral_abscissa<double, 4>(closed);
}

void run(const JobContext& context, const Options& options) {
  const TwoDof<double> plant = plant_of(context.case_data);
  const SampledLoop<double> loop = loop_of(context.case_data);
  const GainGrid grid{parse_axis("--p", options.p), parse_axis("--d", options.d)};
  Table table(context, columns(options));
  const auto write = [&](const PdGains<double>& gains, bool stable) {
    table.writer().cell(gains.proportional);
    table.writer().cell(gains.differential);
    table.writer().cell(stable ? 1 : 0);
    if (options.radius) table.writer().cell(growth(options, plant, loop, gains));
    table.writer().end_row();
  };
  if (options.continuous) {
    visit_stability_chart(characteristic_polynomial(plant), grid, write);
  } else {
    visit_stability_chart(characteristic_polynomial(loop).transformed(in_half_plane<double, 6>),
                          grid, write);
  }
  table.commit();
}

}  // namespace

void add_stability(CLI::App& program) {
  const Job job(program, "stability", question::gains, "Chart of stable gains (P, D)");
  const auto options = std::make_shared<Options>();
  job.add_text("--p", options->p, "Proportional gains P, MIN:MAX:COUNT, N/m");
  job.add_text("--d", options->d, "Differential gains D, MIN:MAX:COUNT, N s/m");
  job->add_flag("--continuous", options->continuous, "Without sampling: the continuous loop");
  job->add_flag("--radius", options->radius,
                "Add the spectral radius (continuous: spectral abscissa)");
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
