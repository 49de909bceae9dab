#pragma once

#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {

/// A string with an absorber and its sampling, as enclosures, sums over poles, and its map have it.
struct StringLoop {
  ConductorWithAbsorber conductor;
  Sampling<double> sampling;

  EnclosedResponse enclosed() const { return {enclosed_poles(conductor), sampling}; }
  ModalResponse<double> doubles() const { return modal_response<double>(conductor, sampling); }
  LoopMap<double> map() const { return loop_map(linear_plant(conductor), sampling); }
};

/// How far sums over poles are from the elimination of a map, of either's size, at angles in equal
/// steps.
inline double off_elimination(const ModalResponse<double>& sums, const LoopMap<double>& map) {
  const LoopResponse<double> elimination(map);
  double largest = 0.0;
  for (int i = 1; i < 200; ++i) {
    const double angle = pi<double> * i / 200.0;
    const auto found = sums.at_angle(angle), expected = elimination.at_angle(angle);
    largest = std::max({largest, std::abs(found.displacement / expected.displacement - 1.0),
                        std::abs(found.velocity / expected.velocity - 1.0)});
  }
  return largest;
}

}  // namespace holdfast::test
