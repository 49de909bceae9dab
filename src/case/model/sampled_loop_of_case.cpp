#include "case/model/sampled_loop_of_case.hpp"

#include "case/model/plant_of_case.hpp"

namespace holdfast::program {

SampledLoop<double> loop_of(const Case& the_case) {
  return sampled_loop(plant_of(the_case), sampling_of(the_case));
}

OperatingPoint operating_point_of(const Case& the_case) {
  return {plant_of(the_case), sampling_of(the_case), gains_of(the_case)};
}

}  // namespace holdfast::program
