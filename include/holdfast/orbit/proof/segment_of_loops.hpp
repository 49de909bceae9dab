#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/control/enclosed_loop.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"

namespace holdfast {

/// The loop with each number replaced by the interval of all decimals that round to that double.
/// @throws InvalidParameter where the loop is not admissible
inline IdealLoop<Enclosure> enclosed(const IdealLoop<double>& loop) {
  validate(loop);
  const auto decimal = [](double x) { return Enclosure::of_decimal(x); };
  return {enclosed(loop.plant),
          enclosed(loop.sampling),
          {decimal(loop.gains.proportional), decimal(loop.gains.differential)},
          {decimal(loop.excitation.amplitude), decimal(loop.excitation.frequency)},
          decimal(loop.backlash_width),
          loop.hold};
}

namespace detail {

/// A quantity that is linear along a segment of loops: centre + s · slope, −1/2 ≤ s ≤ 1/2.
template <class Value>
struct AlongSegment {
  Value centre, slope;
};

/// The segment between two loops that differ only in the gains P and D, the force's amplitude F_m
/// and the backlash width r₀. The maps, forces and widths are therefore linear along the segment;
/// they are stored in plant_scaling() units. A single loop is a segment of length 0.
template <class Number>
class SegmentOfLoops {
 public:
  using Map = Matrix<Number, 5>;    ///< map of z̃ over a sample
  using State = Vector<Number, 5>;  ///< state z̃ = [z; u_{j−1}]

  SegmentOfLoops(const IdealLoop<Number>& first, const IdealLoop<Number>& last,
                 const Rational& ratio)
      : SegmentOfLoops(
            Ends{ItineraryMaps<Number>(first, ratio), ItineraryMaps<Number>(last, ratio)}) {
    widths_ = {Number(0.5) * (first.backlash_width + last.backlash_width),
               last.backlash_width - first.backlash_width};
  }
  SegmentOfLoops(const IdealLoop<Number>& loop, const Rational& ratio)
      : SegmentOfLoops(Ends{ItineraryMaps<Number>(loop, ratio)}) {
    widths_ = {loop.backlash_width, Number()};
  }

  /// The interval of all positions s on the segment, −1/2 … 1/2.
  static Number position() { return {-0.5, 0.5}; }

  /// The maps S* and S at both ends of the segment, or of the single loop.
  const std::vector<std::array<Map, 2>>& ends() const { return ends_; }
  /// The map S of the engaged drive for `engaged` = 1, or the map S* in the backlash for 0.
  const AlongSegment<Map>& map(std::uint8_t engaged) const { return maps_.at(engaged); }
  /// The contribution of the excitation to the state z̃ during sampling period number `sample`.
  AlongSegment<State> addition(std::size_t sample) const {
    return additions_[sample % additions_.size()];
  }
  /// The width of the backlash r₀ (m), as a linear function along the segment.
  const AlongSegment<Number>& width() const { return widths_; }
  bool has_backlash() const {
    return widths_.centre.upper() > 0.0 || widths_.slope.magnitude() > 0.0;
  }
  /// The units of [z₁, ż₁, z₂, ż₂, u] in which maps and states are scaled.
  const Vector<double, 5>& units() const { return units_; }

 private:
  using Ends = std::vector<ItineraryMaps<Number>>;

  explicit SegmentOfLoops(const Ends& loops)
      : units_(loops.front().units().template cast<double>()) {
    for (const auto& maps : loops)
      ends_.push_back({maps.map_in_units(false), maps.map_in_units(true)});
    for (const std::size_t engaged : {std::size_t{0}, std::size_t{1}})
      maps_.at(engaged) = between(ends_.front().at(engaged), ends_.back().at(engaged));
    for (std::size_t k = 0; k < loops.front().samples_of_forcing(); ++k)
      additions_.push_back(between(in_units(loops.front(), k), in_units(loops.back(), k)));
  }

  /// A quantity from its values at both ends; constant for a single loop.
  template <class Value>
  AlongSegment<Value> between(const Value& from, const Value& to) const {
    if (ends_.size() == 1) return {from, Value::Zero()};
    return {(from + to) * Number(0.5), to - from};
  }

  static State in_units(const ItineraryMaps<Number>& maps, std::size_t phase) {
    State addition = State::Zero();
    addition.template head<4>() =
        maps.additions()[phase].cwiseQuotient(maps.units().template head<4>());
    return addition;
  }

  std::array<AlongSegment<Map>, 2> maps_;  // S*, S
  std::vector<std::array<Map, 2>> ends_;
  std::vector<AlongSegment<State>> additions_;
  AlongSegment<Number> widths_;
  Vector<double, 5> units_;
};

}  // namespace detail
}  // namespace holdfast
