#pragma once

#include <optional>
#include <string>
#include <vector>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "report/comparison/comparison.hpp"
#include "report/figures/figure.hpp"
#include "report/page/html.hpp"

namespace holdfast::program {

/// The loop of the paper's §4.2: P = −557 N/m, D = −13 N s/m, 0.5 N at 10 Hz.
/// @param sampling_period  s
/// @param backlash_width   m
/// @param delay_fraction   δ/τ
inline IdealLoop<double> paper_loop(double sampling_period, double backlash_width = 0.0,
                                    double delay_fraction = 0.0) {
  return {kollar2022_plant(),
          {sampling_period, delay_fraction * sampling_period},
          {-557.0, -13.0},
          {0.5, 10.0},
          backlash_width};
}

/// Its motion from rest, but for z₁ (m).
inline SampledMotion<double> motion_of(const IdealLoop<double>& loop,
                                       double initial_displacement = 0.0) {
  return harmonically_forced_motion(loop, Vector<double, 4>{initial_displacement, 0.0, 0.0, 0.0});
}

/// The observer once it has seen so many seconds of the motion from rest.
template <class Observer>
Observer seen_by(Observer observer, const IdealLoop<double>& loop, double duration,
                 const std::optional<Kick>& kick = std::nullopt) {
  auto motion = motion_of(loop);
  run_trajectory(motion, samples_within(duration, loop.sampling.period), kick, observer);
  return observer;
}

/// δ/τ: what the paper's numbers belong to, and what its Eq. 14 prints.
constexpr double delay_fractions[] = {0.0, 1.0};
/// @delay@ of the rows.
Values delay_of(double fraction);

/// The rows of the comparison, one after the other; `why` is kept only where they differ.
class Comparisons {
 public:
  /// A number of the paper beside ours, in its unit.
  /// @param row     its name in texts/comparison.toml; there the paper's number and unit stand at
  ///                the end of what it prints: "about 30 ms", "−33.7 N s/m"
  /// @param values  what the texts of the row leave open
  void number(const std::string& row, double ours, const Values& values = {});

  /// A statement of the paper that holds or does not.
  void statement(const std::string& row, const std::string& ours, bool holds,
                 const Values& values = {});

  std::vector<Comparison> rows;
};

/// Fig. 2 and Table 1: the plant from its conductor.
void compare_cable(Comparisons& rows);

/// Figs. 9–13 and Table 2: what kind of motion it is.
void compare_characteristics(Comparisons& rows);

}  // namespace holdfast::program
