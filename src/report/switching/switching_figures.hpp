#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/figures/figure.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// A chart of steady amplitude and, below it, period of every reading over one key of the case.
struct SwitchingChart {
  std::string name, title, caption;
  std::string key;
  std::string column;  ///< of the key in the table of motions, for gnuplot
  std::string label;   ///< in thousandths of the key's unit
  std::vector<double> values = {};
  double own_value = 0.0;  ///< of the case, which is marked
};

/// The amplitudes (m) that a chart shows.
struct ShownAmplitudes {
  double without_control;  ///< a line for comparison
  double largest;          ///< where the picture ends; 0: at the largest that there is
};

/// @param chart  with values; the table NAME is of write_motions(), one reading after the other
Figure switching_chart(const SwitchingChart& chart, const ShownAmplitudes& amplitudes);

/// The contact of one motion in a window.
struct ContactStrip {
  std::string name;    ///< left of the strip
  std::string remark;  ///< right of it
  MotionWindow window;
};

/// What a drive does in a window when it switches at samples and when it does so exactly: the
/// contacts as strips, what is transmitted, and Δz. The tables are NAME of write_strips() and
/// NAME-motion of write_window().
/// @param sampled  with the instants at which it enters and leaves its gap, as labels
Figure contact_window_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const ContactStrip& sampled,
                             const ContactStrip& exact);

/// The contacts of many motions as strips over the same window, of write_strips().
Figure contact_strips_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const std::vector<ContactStrip>& all);

/// Tables of the figures, FOLDER/data/NAME.csv with metadata: a row a motion; a row a phase, the
/// strips one after the other; a row an instant. All throw what Table throws.
/// @param context  its output is the report's folder
void write_motions(const JobContext& context, const std::string& name,
                   const std::vector<StudiedMotion>& motions);
void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips);
void write_window(const JobContext& context, const std::string& name, const MotionWindow& exact,
                  const MotionWindow& sampled);

}  // namespace holdfast::program
