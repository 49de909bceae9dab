#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// The columns of a table of studied motions, as gnuplot counts them.
struct MotionColumn {
  enum Number : int {
    law = 1,
    sampling_period,
    backlash_width,
    switching,
    hold,
    duration,
    largest_displacement,
    largest_of_samples,
    engaged_phases,
    gap_phases,
    stick_phases,
    verdict,
    period_samples,
    period,
    forcing_periods,
    shortest_period_samples,
    largest_multiplier
  };
};

/// What a chart of amplitudes and periods shows along its abscissa.
struct SwitchingAxis {
  MotionColumn::Number column;
  std::string label;   ///< with the unit that the scale leads to
  double scale;        ///< the picture shows scale times the value
  double first, last;  ///< values between which the picture shows the key
  double own_value;    ///< of the case, which is marked
};

/// The amplitudes (m) that a chart shows.
struct ShownAmplitudes {
  double without_control;  ///< a line for comparison
  double largest;          ///< where the picture ends; 0: at the largest that there is
};

/// Steady amplitude and, below it, period of every reading over one key of the case.
/// @param name  of the figure and of its table, one reading after the other
Figure switching_chart(const std::string& name, const std::string& title,
                       const std::string& caption, const SwitchingAxis& axis,
                       const ShownAmplitudes& amplitudes);

/// The contact of one motion in a window.
struct ContactStrip {
  std::string name;    ///< left of the strip
  std::string remark;  ///< right of it
  MotionWindow window;
};

/// What a drive does in a window when it switches at samples and when it does so exactly: the
/// contacts as strips, what is transmitted, and Δz.
/// @param name     of the figure and of its table of strips, as of contact_strips_figure(); its
///                 table NAME-motion has time, and of each motion Δz, u and the transmitted force
/// @param sampled  with the instants at which it enters and leaves its gap, as labels
Figure contact_window_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const ContactStrip& sampled,
                             const ContactStrip& exact);

/// The contacts of many motions as strips over the same window.
/// @param name  of the figure and of its table: number of the strip from 1, begin, end and mode of
///              each phase
Figure contact_strips_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const std::vector<ContactStrip>& all);

}  // namespace holdfast::program
