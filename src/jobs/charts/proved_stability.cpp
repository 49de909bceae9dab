#include "jobs/charts/proved_stability.hpp"

#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/chart/proved_modal_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "jobs/charts/proved_poles.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

template <class Proof>
ProvedChart chart_by(const Proof& proof, const GainGrid& grid, double undecided) {
  const auto decide = [&](const GainBox& box) {
    throw_if_interrupted();
    return proof(box);
  };
  return proved_chart(decide, grid, undecided);
}

ProvedChart modal_chart_of(const Case& the_case, const GainGrid& grid, double undecided) {
  const EnclosedResponse response(proved_poles_of(the_case), sampling_of(the_case));
  return proved_chart(response, grid, undecided, [] { throw_if_interrupted(); });
}

}  // namespace

ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided) {
  if (!has_closed_forms(the_case)) return modal_chart_of(the_case, grid, undecided);
  const TwoMass<double> plant = plant_of(the_case);
  if (continuous) return chart_by(gain_box_proof(plant), grid, undecided);
  return chart_by(gain_box_proof(plant, sampling_of(the_case)), grid, undecided);
}

}  // namespace holdfast::program
