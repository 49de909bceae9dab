#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "holdfast/stability/chart/proved_modal_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/charts/proved_poles.hpp"
#include "jobs/family/family.hpp"
#include "jobs/family/family_proof.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {
namespace {

LoopParameter parameter_of(const std::string& key) {
  std::string known;
  for (const auto& [parameter, name] : parameter_keys) {
    if (key == name) return parameter;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw WrongInput("stability of two masses does not depend on " + key + "; give one of " + known);
}

/// Axis of a chart; throws WrongInput where the key does not admit an end.
KeyAxis admissible_axis(const std::string& text) {
  KeyAxis axis = parse_key_axis("--axis", text);
  parameter_of(axis.key);
  require_admissible("--axis " + text, axis.key, axis.axis.min, axis.axis.max);
  return axis;
}

/// The proved chart of a case. Throws Interrupted, InvalidParameter for a grid without cells,
/// WrongInput for a plant whose poles cannot be proved, and NoAnswer where two poles cannot be
/// separated or a pole may lie on the boundary of stability.
ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided) {
  if (!has_closed_forms(the_case))
    return proved_chart(EnclosedResponse(proved_poles_of(the_case), sampling_of(the_case)), grid,
                        undecided, [] { throw_if_interrupted(); });
  const auto chart_by = [&](const auto& proof) {
    const auto decide = [&](const GainBox& box) { return throw_if_interrupted(), proof(box); };
    return proved_chart(decide, grid, undecided);
  };
  if (continuous) return chart_by(gain_box_proof(plant_of(the_case)));
  return chart_by(gain_box_proof(plant_of(the_case), sampling_of(the_case)));
}

struct StabilityQuestion {
  std::string p = "-1000:200:121";
  std::string d = "-40:20:121";
  std::vector<std::string> axes;
  bool continuous = false;
  bool radius = false;
  bool prove = false;
  std::optional<double> undecided;

  void add_to(const Job& job) {
    job.add("--p", p);
    job.add("--d", d);
    job.add("--continuous", continuous);
    job.add("--axis", axes);
    job.add("--radius", radius);
    job.add("--prove", prove);
    job.add("--undecided", undecided);
  }
  void run(const Job& job) const {
    const JobContext context = job.context();
    if (undecided && !prove) throw WrongInput("--undecided works only with --prove: add --prove");
    if (prove && job.has("--family")) return prove_whole_family(job, context);
    if (prove) return prove_gains(context);
    axes.empty() ? run_over_gains(context) : run_over_axes(context);
  }

 private:
  std::vector<CellColumn> columns() const {
    if (!radius) return cell_columns_of("stability");
    return cell_columns_of(continuous ? "continuous stability" : "sampled stability");
  }
  GainGrid gains_of_chart(const JobContext& context) const {
    return {parse_axis("--p", shown_gains(context, "--p", p)),
            parse_axis("--d", shown_gains(context, "--d", d))};
  }
  void run_over_gains(const JobContext& context) const;
  void run_over_axes(const JobContext& context) const;
  void prove_gains(const JobContext& context) const;
  static void prove_whole_family(const Job& job, const JobContext& context);
};

void StabilityQuestion::run_over_gains(const JobContext& context) const {
  const GainGrid grid = gains_of_chart(context);
  const auto rows = [&] {
    if (continuous) return continuous_chart(plant_of(context.case_data), grid, radius);
    return stability_chart_of(context.case_data, grid, radius, context.instructions);
  };
  write_chart(context, {gain_axes(grid), columns()}, rows());
}

/// Writes a chart over two keys. A sampling period on an axis changes the processing delay in
/// proportion; a tuned P stays that of the case.
void StabilityQuestion::run_over_axes(const JobContext& context) const {
  const auto [slow, fast] = key_grid(
      "--axis", axes,
      "--axis control.sampling_period=0.001:0.02:40 --axis control.differential_gain=-60:20:81",
      1'000'000'000, admissible_axis);
  const LoopChart chart{operating_point_of(context.case_data),
                        {parameter_of(slow.key), slow.axis},
                        {parameter_of(fast.key), fast.axis}};
  validate(chart);
  write_chart(context, {{grid_axis(slow), grid_axis(fast)}, columns()},
              sampled_chart(chart, radius, context.instructions));
}

void StabilityQuestion::prove_gains(const JobContext& context) const {
  if (is_netcdf_name(context.output) || is_store_name(context.output))
    throw WrongInput(
        "--output " + context.output->string() +
        ": --prove makes boxes, not the cells of a grid; give a name that ends in .csv");
  const GainGrid grid = gains_of_chart(context);
  if (grid.proportional.count < 2 || grid.differential.count < 2)
    throw WrongInput(
        "--prove needs cells between points of --p and --d: give at least two points of each");
  Table table(context, columns_of("proved stability"));
  const double share = undecided.value_or(1e-3);
  const ProvedChart chart = proved_stability_of(context.case_data, grid, continuous, share);
  const double area = chart.area(), left = chart.share(ProvedStability::undecided);
  for (const auto& [gains, stability] : chart.boxes)
    table.row(gains.proportional_from, gains.proportional_to, gains.differential_from,
              gains.differential_to, name_in(proved_names, stability), gains.area() / area);
  table.commit();
  if (left > share)
    report_warning(format_rounded(left) + " of the area is undecided, more than the " +
                       format_rounded(share) + " allowed: give a larger --undecided",
                   context.quiet);
}

void StabilityQuestion::prove_whole_family(const Job& job, const JobContext& context) {
  for (const char* other : {"--p", "--d", "--continuous", "--undecided", "--draws"})
    if (job.has(other))
      throw WrongInput(std::string(other) +
                       ": leave this option out: --family --prove proves the sampled loops of the "
                       "family at the case's gains, or over ranges of gains in [uncertain]");
  if (context.case_data.uncertain.empty())
    family_members(context.case_data, 2);  // says what to give
  Table table(context, columns_of("proved family"));
  const FamilyProof proof = family_proof_of(context);
  table.row(name_in(proved_names, proof.verdict), proof.stable_share, proof.undecided_share,
            static_cast<std::int64_t>(proof.parts), proof.unstable.text());
  table.commit();
}

}  // namespace

void add_stability(CLI::App& program) { add_job<StabilityQuestion>(program, "stability"); }

}  // namespace holdfast::program
