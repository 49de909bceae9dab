#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/control/digital_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/phasor_table.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"

namespace holdfast {

/// The excitation of a pack of motions, each with its own harmonics and ForceHold. A force held
/// over the sampling period is treated as one harmonic of frequency 0.
template <class Scalar>
class LaneExcitation {
 public:
  /// @param of_lane  function from the number of a lane to its DigitalLoop (const&)
  template <class OfLane>
  explicit LaneExcitation(const OfLane& of_lane) {
    std::size_t lines = 1;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      lines = std::max(lines, of_lane(lane).force.harmonics.size());
    for (std::size_t l = 0; l < lines; ++l) lines_.push_back(line_of_lanes(of_lane, l));
    for (std::size_t lane = 0; lane < lanes; ++lane)
      held_[lane] = of_lane(lane).hold == ForceHold::sampled ? 1.0 : 0.0;
    any_held_ = any(held_.all() > Scalar(0.5));
    phases_.resize(lines);
  }

  /// Selects sample j = `index`: the one after the last, or a multiple of RotatingPhasor::block.
  void begin_sample(std::int64_t index) {
    const auto k = static_cast<std::size_t>(index) % RotatingPhasor<Scalar>::block;
    Scalar held_force(0);
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      if (k == 0) lines_[l].turning.turn_to(index);
      phases_[l] = lines_[l].turning.at(k);
      held_force = held_force + lines_[l].at_sample.cosine * phases_[l].cosine -
                   lines_[l].at_sample.sine * phases_[l].sine;
    }
    if (!any_held_) return;
    const Mask<Scalar> held = held_.all() > Scalar(0.5);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      phases_[l] = {select(held, l == 0 ? held_force : Scalar(0), phases_[l].cosine),
                    select(held, Scalar(0), phases_[l].sine)};
  }

  /// Whether the force in a lane is held constant over each sampling period.
  bool is_held(std::size_t lane) const { return held_[lane] > 0.5; }
  /// The largest number of harmonics in any lane, ≥ 1.
  std::size_t lines() const { return lines_.size(); }
  /// The phasor F_l (cos ω_l t_j, sin ω_l t_j) of harmonic l = `line` with amplitude F_l (N). In
  /// lanes with a held force F_j the phasor is (F_j, 0) for l = 0 and (0, 0) for other l.
  const ExcitationSample<Scalar>& phase(std::size_t line) const { return phases_[line]; }

  /// Computes the phasors of all harmonics, including phase angles, `after` (s) after the sample.
  void turned(const Scalar& after, std::vector<LanePhasor<Scalar>>& phasors) const {
    for (std::size_t l = 0; l < lines_.size(); ++l)
      phasors[l] = {lines_[l].angular_frequency, turned_by(turn_of(lines_[l], after), l)};
  }

  /// Sets the times (s) after the sample for which turned_to() and force_at() may be called.
  void fix_instants(const std::vector<Scalar>& after) {
    fixed_.clear();
    for (const Scalar& one : after)
      for (const Line& line : lines_) fixed_.push_back(turn_of(line, one));
  }
  /// Computes the phasors as turned(), at a time given by its number (from 0) in fix_instants().
  void turned_to(std::size_t instant, std::vector<LanePhasor<Scalar>>& phasors) const {
    for (std::size_t l = 0; l < lines_.size(); ++l)
      phasors[l] = {lines_[l].angular_frequency, turned_by(fixed_turn(instant, l), l)};
  }
  /// The excitation force F (N) at a time given by its number (from 0) in fix_instants().
  Scalar force_at(std::size_t instant) const {
    Scalar sum(0);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      sum = sum + turned_by(fixed_turn(instant, l), l).cosine;
    return sum;
  }

 private:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;

  struct Line {
    RotatingPhasor<Scalar> turning;
    ExcitationSample<Scalar> at_sample;                 // cos φ and sin φ
    Scalar frequency, phase_cycles, angular_frequency;  // 0 where the force is held
  };

  /// The unit phasor by which a harmonic turns in the time `after` (s), including its phase φ_l.
  static ExcitationSample<Scalar> turn_of(const Line& line, const Scalar& after) {
    using std::floor;
    const Scalar cycles = line.frequency * after + line.phase_cycles;
    return unit_phasor(Scalar(cycles - floor(cycles)));
  }

  const ExcitationSample<Scalar>& fixed_turn(std::size_t instant, std::size_t l) const {
    return fixed_[instant * lines_.size() + l];
  }

  ExcitationSample<Scalar> turned_by(const ExcitationSample<Scalar>& turn, std::size_t l) const {
    const ExcitationSample<Scalar>& now = phases_[l];
    return {turn.cosine * now.cosine - turn.sine * now.sine,
            turn.cosine * now.sine + turn.sine * now.cosine};
  }

  template <class OfLane>
  static Line line_of_lanes(const OfLane& of_lane, std::size_t l) {
    const auto number = [&](const auto& part) {
      return detail::from_lanes<Scalar>([&](std::size_t lane) -> double {
        const auto& lines = of_lane(lane).force.harmonics;
        return part(l < lines.size() ? lines[l] : Harmonic{0.0, 1.0, 0.0},
                    of_lane(lane).hold == ForceHold::exact);
      });
    };
    const Scalar period =
        detail::from_lanes<Scalar>([&](std::size_t lane) { return of_lane(lane).sampling.period; });
    return {
        RotatingPhasor<Scalar>({number([](const Harmonic& line, bool) { return line.amplitude; }),
                                number([](const Harmonic& line, bool) { return line.frequency; })},
                               period),
        {number([](const Harmonic& line, bool) { return std::cos(line.phase); }),
         number([](const Harmonic& line, bool) { return std::sin(line.phase); })},
        number([](const Harmonic& line, bool exact) { return exact ? line.frequency : 0.0; }),
        number([](const Harmonic& line, bool exact) {
          return exact ? line.phase / (2.0 * pi<double>) : 0.0;
        }),
        number([](const Harmonic& line, bool exact) {
          return exact ? line.angular_frequency() : 0.0;
        })};
  }

  std::vector<Line> lines_;
  std::vector<ExcitationSample<Scalar>> phases_;
  std::vector<ExcitationSample<Scalar>> fixed_;  // turns to the fixed times, line by line
  LaneNumbers<Scalar> held_;
  bool any_held_;
};

}  // namespace holdfast
