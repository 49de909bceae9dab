#include "report/figures/figure.hpp"

#include <algorithm>
#include <array>

#include "io/text/text.hpp"
#include "report/figures/figure_text.hpp"

namespace holdfast::program {
namespace {

constexpr std::array<LengthUnit, 3> length_units = {{{"mm", 1e3}, {"µm", 1e6}, {"nm", 1e9}}};

using Arguments = std::vector<std::string>;

std::string range(double from, double to) {
  return "[" + format_number(from) + ":" + format_number(to) + "]";
}

/// One curve of a boundary table, drawn in a line style.
std::string boundary_curve(const std::string& name, const std::string& curve,
                           const std::string& style, const std::string& label) {
  return "  @" + name + "-boundary@ using 3:(root('" + curve + "')) with lines ls " + style +
         " title '" + label + "'";
}

/// A computer so fast that delay and hold are not seen: 0.1 ms, without backlash.
const Arguments ideal_drive = {"--set", "control.sampling_period=0.0001",
                               "--set", "control.processing_delay=0",
                               "--set", "backlash.width=0"};

}  // namespace

LengthUnit length_unit_for(double length) {
  const auto fits = [length](const LengthUnit& unit) { return length * unit.per_metre >= 0.1; };
  const auto found = std::find_if(length_units.begin(), length_units.end(), fits);
  if (found != length_units.end()) return *found;
  return length > 0.0 ? length_units.back() : length_units.front();  // the latter: nothing moves
}

std::vector<std::string> loop_settings(const std::string& sampling_period,
                                       const std::string& backlash_width) {
  return {"--set", "control.sampling_period=" + sampling_period, "--set",
          "backlash.width=" + backlash_width};
}

Figure stability_figure(const std::string& name, const std::string& title,
                        const std::string& caption, const ChartWindow& window,
                        const std::vector<std::string>& settings) {
  const std::string p = format_number(window.p_min) + ":" + format_number(window.p_max);
  const std::string d = format_number(window.d_min) + ":" + format_number(window.d_max);
  const bool continuous =
      std::find(settings.begin(), settings.end(), "--continuous") != settings.end();
  Figure figure{name, title, caption, {}, "", 400.0};
  figure.tables = {
      {name + "-boundary", joined({"boundary", "--p", p}, settings)},
      {name + "-chart", joined({"stability", "--p", p + ":241", "--d", d + ":241"}, settings)}};
  figure.plot =
      axes("proportional gain {/:Italic P} (N/m)", "differential gain {/:Italic D} (N s/m)") +
      "set xrange " + range(window.p_min, window.p_max) + "\nset yrange " +
      range(window.d_min, window.d_max) +
      "\nset palette defined (0 'white', 1 '#cfe3ef')\nset cbrange [0:1]\nunset colorbox\n"
      "root(name) = (strcol(1) eq name ? $4 : NaN)\n"
      "plot @" +
      name +
      "-chart@ using 1:2:3 with image notitle, \\\n"
      "  keyentry with boxes fill solid lc rgb '#cfe3ef' title 'stable', \\\n";
  figure.plot += continuous ? boundary_curve(name, "imaginary_pair", "1", "pair {/:Italic s} = ±iω")
                            : boundary_curve(name, "complex_pair", "1", "pair λ = e^{±iθ}") +
                                  ", \\\n" + boundary_curve(name, "minus_one", "2", "root λ = −1");
  figure.plot += "\n";
  return figure;
}

Figure delay_charts_figure(const std::string& name, const std::string& title,
                           const std::string& caption, const ChartWindow& window,
                           double sampling_period) {
  const std::string p = format_number(window.p_min) + ":" + format_number(window.p_max);
  const std::string d = format_number(window.d_min) + ":" + format_number(window.d_max);
  Figure figure{name, title, caption, {}, "", 300.0};
  figure.plot = "set xrange " + range(window.p_min, window.p_max) + "\nset yrange " +
                range(window.d_min, window.d_max) +
                "\nset palette defined (0 'white', 1 '#cfe3ef')\nset cbrange [0:1]\n"
                "unset colorbox\nunset key\nset xtics 400\n"
                "root(name) = (strcol(1) eq name ? $4 : NaN)\n"
                "set multiplot layout 1,3 margins 0.12,0.98,0.25,0.87 spacing 0.03,0\n" +
                axes("{/:Italic P} (N/m)", "{/:Italic D} (N s/m)");
  const std::vector<std::pair<double, std::string>> delays = {
      {0.0, "δ = 0"}, {0.5, "δ = τ/2"}, {1.0, "δ = τ"}};
  for (std::size_t k = 0; k < delays.size(); ++k) {
    const std::string table = name + "-" + std::to_string(k + 1);
    const Arguments settings = {
        "--set", "control.sampling_period=" + format_number(sampling_period), "--set",
        "control.processing_delay=" + format_number(delays[k].first * sampling_period)};
    figure.tables.push_back({table + "-boundary", joined({"boundary", "--p", p}, settings)});
    figure.tables.push_back(
        {table + "-chart", joined({"stability", "--p", p + ":161", "--d", d + ":161"}, settings)});
    figure.plot += "set title '" + delays[k].second + "'\nplot @" + table +
                   "-chart@ using 1:2:3 with image, \\\n" +
                   boundary_curve(table, "complex_pair", "1", "") + ", \\\n" +
                   boundary_curve(table, "minus_one", "2", "") +
                   "\nunset ylabel\nset format y ''\n";
  }
  figure.plot += "unset multiplot\n";
  return figure;
}

Figure design_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<double>& sampling_periods) {
  Figure figure{name, title, caption, {}, "", 440.0};
  std::string gains, attenuations;
  for (std::size_t k = 0; k < sampling_periods.size(); ++k) {
    const std::string table = name + "-" + std::to_string(k + 1);
    figure.tables.push_back(
        {table, Arguments{"design", "--frequency", "3:60:229", "--set",
                          "control.sampling_period=" + format_number(sampling_periods[k])}});
    const std::string file = std::string(k == 0 ? "plot" : ", \\\n ") + " @" + table + "@ using ";
    const std::string style = " with lines ls " + std::to_string(k + 1) +
                              " title 'τ = " + format_number(1e3 * sampling_periods[k]) + " ms'";
    gains += file + "1:3" + style;
    attenuations += file + "1:5" + style;
  }
  figure.plot =
      "set multiplot layout 2,1 margins 0.13,0.98,0.17,0.92 spacing 0,0.05\n"
      "set xrange [0:60]\nset yrange [-160:10]\nset format x ''\n" +
      axes("", "best {/:Italic D} (N s/m)") + gains +
      "\nunset key\nset yrange [-5:30]\nset format x '%g'\n" +
      axes("excitation frequency {/:Italic f} (Hz)", "attenuation (dB)") + attenuations +
      ", \\\n  0 with lines lc rgb '#888888' dt 3\nunset multiplot\n";
  return figure;
}

Figure delay_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::vector<std::string>& settings, const std::string& remark) {
  const Arguments frequencies = {"--frequency", "3:60:115"};
  Figure figure{name, title, caption, {}, "", 360.0};
  for (const std::string criterion : {"attenuates", "stable"}) {
    figure.tables.push_back(
        {name + "-" + criterion,
         joined(joined({"max-delay", "--criterion", criterion}, frequencies), settings)});
  }
  figure.plot =
      axes("excitation frequency {/:Italic f} (Hz)", "largest sampling period (ms)") +
      "set logscale y\nset yrange [1:1000]\nset xrange [0:60]\n" + remark + "plot @" + name +
      "-stable@ using 1:($3*1e3) with lines ls 4 dt 2 title 'some D stabilises', \\\n"
      "  @" +
      name +
      "-attenuates@ using 1:($3*1e3) with lines ls 1 title 'some stabilising D attenuates'\n";
  return figure;
}

Figure history_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to,
                      const std::vector<std::string>& settings) {
  const Arguments span = {"simulate", "--duration", to, "--from", from};
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name + "-no-control", joined(joined(span, settings), {"--no-control"})},
                   {name + "-ideal", joined(joined(span, settings), ideal_drive)},
                   {name + "-loop", joined(span, settings)}};
  figure.plot = axes("time {/:Italic t} (s)", "displacement {/:Italic z}_1 (@unit@)") +
                "set xrange [" + from + ":" + to +
                "]\n"
                "plot @" +
                name +
                "-no-control@ using 1:($2*@length@) with lines ls 1 title 'no control', \\\n"
                "  @" +
                name +
                "-ideal@ using 1:($2*@length@) with lines ls 2 title 'ideal control', \\\n"
                "  @" +
                name +
                "-loop@ using 1:($2*@length@) with lines ls 3 title 'with delay and backlash'\n";
  return figure;
}

Figure kick_figure(const std::string& name, const std::string& title, const std::string& caption,
                   const std::string& kick, const std::vector<std::string>& settings) {
  const Arguments span = {"simulate", "--duration", "4"};
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name + "-undisturbed", joined(span, settings)},
                   {name + "-kicked", joined(joined(span, {"--kick", kick}), settings)}};
  figure.plot = axes("time {/:Italic t} (s)", "displacement {/:Italic z}_1 (mm)") +
                "set xrange [0:4]\n"
                "plot @" +
                name +
                "-kicked@ using 1:($2*1e3) with lines ls 2 title 'perturbed by 3 mm', \\\n"
                "  @" +
                name + "-undisturbed@ using 1:($2*1e3) with lines ls 1 title 'undisturbed'\n";
  return figure;
}

Figure contact_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to, const ContactScale& scale,
                      const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name, joined({"simulate", "--duration", to, "--from", from}, settings)}};
  figure.plot =
      axes("time {/:Italic t} (s)", "relative velocity {/:Italic v}_2 − {/:Italic v}_1 (m/s)") +
      "set xrange [" + from + ":" + to + "]\n" + scale.axes + "plot @" + name +
      "@ using 1:($5-$3) with lines ls 1 title 'v_2 − v_1', \\\n"
      "  '' using " +
      scale.contact + "\n";
  return figure;
}

Figure phase_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& duration, const std::vector<std::string>& settings) {
  const Arguments steady = {"simulate", "--duration", duration, "--from", "30"};
  const Arguments cycle = {"simulate", "--duration", "30.3", "--from", "30"};
  Figure figure{name, title, caption, {}, "", 420.0};
  figure.tables = {{name + "-no-control", joined(joined(cycle, {"--no-control"}), ideal_drive)},
                   {name + "-ideal", joined(cycle, ideal_drive)},
                   {name + "-loop", joined(steady, settings)}};
  figure.plot =
      axes("displacement {/:Italic z}_1 (@unit@)", "velocity {/:Italic v}_1 (m/s)") + "plot @" +
      name +
      "-no-control@ using ($2*@length@):3 with lines ls 1 title 'no control', \\\n"
      "  @" +
      name +
      "-loop@ using ($2*@length@):3 with lines lw 0.8 lc rgb '#009e73' title 'with delay and "
      "backlash', \\\n"
      "  @" +
      name + "-ideal@ using ($2*@length@):3 with lines ls 2 title 'ideal control'\n";
  return figure;
}

Figure spectrum_figure(const std::string& name, const std::string& title,
                       const std::string& caption, const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name, joined({"spectrum", "--duration", "100", "--discard", "40"}, settings)}};
  figure.plot = axes("frequency {/:Italic f} (Hz)", "amplitude of {/:Italic z}_1 (m)") +
                "set logscale y\nset format y '10^{%L}'\nset xrange [0:45]\nset yrange "
                "[1e-8:2e-3]\nunset key\n"
                "plot @" +
                name + "@ using 1:($2 > 1e-8 ? $2 : 1e-8) with impulses ls 1\n";
  return figure;
}

Figure deviation_figure(const std::string& name, const std::string& title,
                        const std::string& caption, const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name, joined({"deviation", "--offset", "1e-5", "--duration", "30"}, settings)}};
  figure.plot = axes("time {/:Italic t} (s)", "|{/:Italic z}_{1,b} − {/:Italic z}_{1,a}| (m)") +
                "set logscale y\nset format y '10^{%L}'\nset yrange [1e-18:1e-2]\nunset key\n"
                "plot @" +
                name + "@ using 1:(abs($2) > 0 ? abs($2) : 1e-18) with lines ls 1 lw 0.6\n";
  return figure;
}

Figure filling_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& duration, const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {{name, joined({"simulate", "--duration", duration}, settings)}};
  figure.plot = axes("displacement {/:Italic z}_1 (mm)", "velocity {/:Italic v}_1 (m/s)") +
                "set xrange [0:1]\nset yrange [-0.05:0.05]\nunset key\n"
                "plot @" +
                name +
                "@ using ($2 > 0 && $2 < 1e-3 && abs($3) < 0.05 ? $2*1e3 : NaN):3 "
                "with points pt 7 ps 0.3 lc rgb '#0072b2'\n";
  return figure;
}

Figure exponent_figure(const std::string& name, const std::string& title,
                       const std::string& caption, const std::string& tangent,
                       const std::string& from, const std::string& range,
                       const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {
      {name,
       joined({"lyapunov", "--duration", "10", "--history", "--tangent", tangent}, settings)}};
  figure.plot = axes("time {/:Italic t} (s)", "exponent {/:Italic λ} per sample") + "set xrange [" +
                from + ":10]\nset yrange [" + range +
                "]\n"
                "plot for [i=1:3] @" +
                name + "@ every 5 using ($1 >= " + from +
                " ? $1 : NaN):(column(i+1)) with lines ls i "
                "title sprintf('λ_%d', i), 0 with lines lc rgb '#888888' dt 3 notitle\n";
  return figure;
}

Figure exponent_table_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const std::string& duration,
                             const std::vector<double>& published,
                             const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "$published << END\n", 320.0};
  for (std::size_t i = 0; i < published.size(); ++i) {
    figure.plot += std::to_string(i + 1) + "," + format_number(published[i]) + "\n";
  }
  for (const std::string tangent : {"printed", "consistent"}) {
    figure.tables.push_back(
        {name + "-" + tangent,
         joined({"lyapunov", "--duration", duration, "--tangent", tangent}, settings)});
  }
  figure.plot +=
      "END\n" + axes("number of the exponent", "exponent {/:Italic λ} per sample") +
      "set xrange [0.5:4.5]\nset xtics 1\nset bars 0.5\n"
      "plot @" +
      name +
      "-printed@ using ($1-0.12):2:4 with yerrorbars ls 1 dt 1 pt 7 ps 0.7 "
      "title 'tangent as printed, δ = τ', \\\n"
      "  @" +
      name +
      "-consistent@ using ($1+0.12):2:4 with yerrorbars ls 2 dt 1 pt 5 ps 0.7 "
      "title 'consistent tangent, δ = 0', \\\n"
      "  $published using 1:2 with points pt 2 ps 1.2 lw 1.6 lc rgb '#444444' title 'paper'\n";
  return figure;
}

}  // namespace holdfast::program
