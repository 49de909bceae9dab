#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A table of the report: the name of its file and the command line that makes it.
struct TableRequest {
  std::string name;                    ///< "fig06a-control": data/fig06a-control.csv
  std::vector<std::string> arguments;  ///< {"simulate", "--duration", "1", …}, without --output
};

/// A unit of length and how many of it a metre has.
struct LengthUnit {
  const char* name = "mm";
  double per_metre = 1e3;
};

/// A picture of the report: the tables it is drawn from and the gnuplot commands that draw it.
struct Figure {
  std::string name;     ///< "fig06a": pictures/fig06a.svg
  std::string title;    ///< heading
  std::string caption;  ///< says what is drawn, so that the picture can be understood alone
  std::vector<TableRequest> tables;
  /// gnuplot commands; a table's file is @NAME@, the unit of small lengths (@unit@), of which a
  /// metre has @length@.
  std::string plot;
  double height = 360.0;        ///< of the picture, in points; its width is 640
  LengthUnit length_unit = {};  ///< of length_unit_for()
};

/// The unit in which a length (m) is between 0.1 and 100 or so: mm, µm or nm.
LengthUnit length_unit_for(double length);

/// `--set` pairs for a sampling period (s) and a backlash (m).
std::vector<std::string> loop_settings(const std::string& sampling_period,
                                       const std::string& backlash_width);

/// The cable at the absorber: statics, first peaks after a force is removed, one such vibration.
/// @param force  MIN:MAX:COUNT, N
Figure statics_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& force);
Figure peaks_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& force, const std::vector<std::string>& settings);
/// @param force     N; @param duration  s
Figure decay_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& force, const std::string& duration);

/// The window of gains that a stability chart shows.
struct ChartWindow {
  double p_min, p_max;  ///< N/m
  double d_min, d_max;  ///< N s/m
};

/// Makers of the kinds of figure; `settings` are options that every table of the figure gets.
Figure stability_figure(const std::string& name, const std::string& title,
                        const std::string& caption, const ChartWindow& window,
                        const std::vector<std::string>& settings);
/// Three charts side by side: processing delay 0, half the sampling period and all of it.
/// @param sampling_period  s
Figure delay_charts_figure(const std::string& name, const std::string& title,
                           const std::string& caption, const ChartWindow& window,
                           double sampling_period);
/// The best D over the excitation frequency and how far it attenuates, for several computers.
/// @param sampling_periods  s
Figure design_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<double>& sampling_periods);
/// @param remark  lines for gnuplot that mark something in the picture
Figure delay_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::vector<std::string>& settings, const std::string& remark = "");
Figure history_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to,
                      const std::vector<std::string>& settings);
Figure kick_figure(const std::string& name, const std::string& title, const std::string& caption,
                   const std::string& kick, const std::vector<std::string>& settings);
/// How contact_figure() shows whether the drive is in its backlash, for gnuplot.
struct ContactScale {
  const char* axes;     ///< settings
  const char* contact;  ///< what follows `using`
};

/// As in the paper, whose velocities stay below 0.1 m/s.
inline constexpr ContactScale paper_contact_scale = {
    "set yrange [-0.08:0.12]\n",
    "1:($7 == 1 ? 0 : 0.1) with steps ls 2 title '0 in the backlash, 0.1 outside'"};

/// For a motion of any size: an axis of its own.
inline constexpr ContactScale own_contact_scale = {
    "set border 11\nset ytics nomirror\nset y2range [-0.5:1.5]\n"
    "set y2tics ('inside' 0, 'outside' 1)\nset y2label 'backlash'\n",
    "1:($7 == 1 ? 0 : 1) axes x1y2 with steps ls 2 title 'in the backlash or not (right)'"};

Figure contact_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to, const ContactScale& scale,
                      const std::vector<std::string>& settings);
Figure phase_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& duration, const std::vector<std::string>& settings);
Figure spectrum_figure(const std::string& name, const std::string& title,
                       const std::string& caption, const std::vector<std::string>& settings);
Figure deviation_figure(const std::string& name, const std::string& title,
                        const std::string& caption, const std::vector<std::string>& settings);
Figure filling_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& duration, const std::vector<std::string>& settings);
/// @param tangent  of the job lyapunov: "printed" or "consistent"
/// @param from     s, where the picture begins
/// @param range    of the ordinate, "-0.06:0.03"
Figure exponent_figure(const std::string& name, const std::string& title,
                       const std::string& caption, const std::string& tangent,
                       const std::string& from, const std::string& range,
                       const std::vector<std::string>& settings);

/// @param published  the paper's exponents, λ₁ first
/// @param duration   of the motion, s
Figure exponent_table_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const std::string& duration,
                             const std::vector<double>& published,
                             const std::vector<std::string>& settings);

}  // namespace holdfast::program
