#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/figures/figure.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// A chart of steady amplitude and, below it, period of every reading over one key of the case.
struct SwitchingChart {
  Figure figure;  ///< without tables and plot
  std::string key;
  std::string column;  ///< of the key in the table of motions, for gnuplot
  std::string label;   ///< in thousandths of the key's unit
  std::vector<double> values;
  double own_value;  ///< of the case, which is marked
};

/// The amplitudes (m) that a chart shows.
struct ShownAmplitudes {
  double without_control;  ///< a line for comparison
  double largest;          ///< where the picture ends; 0: at the largest that there is
};

/// Gives the chart's figure, which has a name and words, its plot and its table: NAME of
/// write_motions(), one reading after the other.
void draw_chart(SwitchingChart& chart, const ShownAmplitudes& amplitudes);

/// The contact of one motion in a window.
struct ContactStrip {
  std::string name;    ///< left of the strip
  std::string remark;  ///< right of it
  MotionWindow window;
};

/// The same for what a drive does in a window when it switches at samples and when it does so
/// exactly: the contacts as strips, what is transmitted, and Δz. The tables are NAME of
/// write_strips() and NAME-motion of write_window().
/// @param sampled  with the instants at which it enters and leaves its gap, as labels
void draw_window(Figure& figure, const ContactStrip& sampled, const ContactStrip& exact);

/// The same for the contacts of many motions as strips over one window, of write_strips().
void draw_strips(Figure& figure, const std::vector<ContactStrip>& all);

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
