#include "report/figures/figure.hpp"
#include "report/figures/figure_text.hpp"

namespace holdfast::program {

Figure statics_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& force) {
  Figure figure{name, title, caption, {}, "", 360.0};
  figure.tables = {{name, {"statics", "--force", force}}};
  figure.plot = axes("force beyond the absorber's weight (N)", "displacement (mm)") + "plot @" +
                name +
                "@ using 1:($4*1e3) with lines ls 4 title 'spring k_1', \\\n"
                "  '' using 1:($3*1e3) with lines ls 2 title 'Eq. 1', \\\n"
                "  '' using 1:($2*1e3) with lines ls 1 title 'exact', \\\n"
                "  '' every 4 using 1:($5*1e3) with points pt 6 ps 0.8 lc rgb '#222222' "
                "title 'finite elements'\n";
  return figure;
}

Figure peaks_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& force, const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 360.0};
  figure.tables = {{name, joined({"peaks", "--force", force}, settings)}};
  figure.plot = axes("force removed (N)", "first peak (mm)") +
                "set y2label 'discrepancy (%)'\nset y2range [0:25]\nset y2tics 5 nomirror\n"
                "set border 11\nset yrange [0:*]\n"
                "plot @" +
                name +
                "@ using 1:(-$2*1e3) with points pt 6 ps 0.8 lc rgb '#222222' "
                "title 'finite elements', \\\n"
                "  '' using 1:(-$3*1e3) with lines ls 1 title 'two masses', \\\n"
                "  '' using 1:($4*100) axes x1y2 with lines ls 2 title 'discrepancy (right)'\n";
  return figure;
}

Figure decay_figure(const std::string& name, const std::string& title, const std::string& caption,
                    const std::string& force, const std::string& duration) {
  Figure figure{name, title, caption, {}, "", 320.0};
  figure.tables = {
      {name, {"decay", "--force", force, "--duration", duration, "--equal-displacement"}}};
  figure.plot = axes("time {/:Italic t} (s)", "displacement (mm)") + "plot @" + name +
                "@ using 1:($2*1e3) with lines ls 1 title 'finite elements', \\\n"
                "  '' using 1:($3*1e3) with lines ls 2 title 'two masses'\n";
  return figure;
}

}  // namespace holdfast::program
