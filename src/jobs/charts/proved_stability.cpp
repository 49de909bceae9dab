#include "jobs/charts/proved_stability.hpp"

#include "case/model/plant_of_case.hpp"
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

}  // namespace

ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided) {
  const TwoMass<double> plant = plant_of(the_case);
  if (continuous) return chart_by(gain_box_proof(plant), grid, undecided);
  return chart_by(gain_box_proof(plant, sampling_of(the_case)), grid, undecided);
}

}  // namespace holdfast::program
