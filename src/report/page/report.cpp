#include "report/page/report.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "case/case_file.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "io/file/input.hpp"
#include "io/file/output.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "report/figures/figure.hpp"
#include "report/figures/gnuplot.hpp"
#include "report/page/answers.hpp"
#include "report/page/command_line.hpp"
#include "report/page/html.hpp"
#include "report/switching/switching_page.hpp"
#include "report/switching/switching_study.hpp"
#include "sweep/tiles/work_folder.hpp"

namespace holdfast::program {
namespace {

using Arguments = std::vector<std::string>;
namespace fs = std::filesystem;

bool is_builtin(const Case& the_case) {
  return case_to_toml(the_case) == case_to_toml(load_case({}, {}));
}

void make_folders(const fs::path& folder) {
  for (const char* part : {"data", "pictures"}) {
    std::error_code failure;
    fs::create_directories(folder / part, failure);
    if (failure) throw WrongInput("--output " + folder.string() + ": " + failure.message());
  }
}

/// The unit of the case's displacements.
LengthUnit unit_of(const Case& the_case) {
  const double duration = std::min(20.0, end_of_force(the_case));
  return length_unit_for(amplitude_without_control(the_case, duration));
}

class ReportWriter {
 public:
  ReportWriter(const JobContext& context, Arguments case_arguments, const CommandRunner& run)
      : folder_(*context.output),
        case_arguments_(std::move(case_arguments)),
        run_(run),
        length_unit_(unit_of(context.case_data)),
        can_draw_(gnuplot_available()) {}

  DrawnFigure make(const Figure& figure) const {
    DrawnFigure drawn{figure, {}, "", ""};
    for (const TableRequest& table : figure.tables) {
      drawn.commands.push_back(shell_text(table.arguments, case_arguments_) + " --output data/" +
                               table.name + ".csv");
    }
    drawn.reason = write_tables(figure);
    return drawn.reason.empty() ? with_picture(std::move(drawn)) : drawn;
  }

  /// A figure whose tables the report has written itself, unless there is a reason not to.
  DrawnFigure drawn(DrawnFigure own) const {
    own.commands = {shell_text({"report"}, case_arguments_) + " --output ."};
    return own.reason.empty() ? with_picture(std::move(own)) : own;
  }

 private:
  DrawnFigure with_picture(DrawnFigure drawn) const {
    if (!can_draw_) {
      drawn.reason = "gnuplot is not installed (Debian package gnuplot-nox)";
      return drawn;
    }
    drawn.figure.length_unit = length_unit_;
    draw(drawn.figure, folder_);
    drawn.svg = read_input(folder_ / "pictures" / (drawn.figure.name + ".svg"));
    return drawn;
  }

  /// @return why the case has no such tables, as where its record ends too soon; else nothing
  std::string write_tables(const Figure& figure) const {
    try {
      for (const TableRequest& table : figure.tables) write_table(table);
    } catch (const NoAnswer& reason) {
      return reason.what();
    } catch (const WrongInput& reason) {
      return reason.what();
    }
    return "";
  }

  void write_table(const TableRequest& table) const {
    const std::string file = (folder_ / "data" / (table.name + ".csv")).string();
    // A sweep that was interrupted has left its tiles; this report may be one of another case.
    remove_work_folder(file + ".tiles");
    Arguments arguments = command_of(table.arguments, case_arguments_);
    arguments.insert(arguments.end(), {"--quiet", "--output", file});
    run_(arguments);
  }

  fs::path folder_;
  Arguments case_arguments_;
  const CommandRunner& run_;
  LengthUnit length_unit_;
  bool can_draw_;
};

/// "my-line: 21.3 Hz, τ = 5 ms, r₀ = 0.5 mm".
std::string title_of(const JobContext& context, bool builtin) {
  if (builtin) return page_text("title of paper");
  const Case& the_case = context.case_data;
  const std::string stem = fs::path(context.case_source.name).stem().string();
  return (stem.empty() ? "A controlled cable" : stem) + ": " +
         rounded(effective_excitation(the_case).frequency, 4) + " Hz, " + loop_text(the_case);
}

std::string switching_part(const JobContext& context, bool builtin, const ReportWriter& writer) {
  SwitchingPage page = make_switching_page(context, builtin);
  for (DrawnFigure& figure : page.figures) figure = writer.drawn(std::move(figure));
  return html_of(page);
}

void say_where(const fs::path& page) {
  OutputFile output(std::nullopt);
  output.write("Report: " + page.string() + "\n");
  output.commit();
}

}  // namespace

void write_report(const JobContext& context, const Arguments& case_arguments,
                  const CommandRunner& run) {
  require_absorber(context.case_data);
  const bool builtin = is_builtin(context.case_data);
  const fs::path folder = *context.output;
  const ReportWriter writer(context, case_arguments, run);  // refuses loops that are too stiff
  make_folders(folder);
  OutputFile file(folder / "report.html");
  const std::vector<Figure> figures = figures_of(context.case_data, builtin);

  Page page;
  page.title = title_of(context, builtin);
  page.introduction = page_text(builtin ? "introduction of paper" : "introduction of case");
  page.case_arguments = case_arguments;
  page.case_text = case_to_toml(context.case_data);
  if (builtin) page.comparisons = compare_with_paper();
  page.motions = builtin ? paper_motions(context.case_data)
                         : std::vector<MotionRow>{motion_of_the_case(context.case_data)};
  Progress progress(figures.size() + 2, "report", progress_wanted(context));
  page.answers = answers_of(context);
  progress.advance();
  // The study of switching is of two masses, which it runs by the thousand.
  if (!is_modal(context.case_data)) page.switching = switching_part(context, builtin, writer);
  progress.advance();
  for (const Figure& figure : figures) {
    throw_if_interrupted();
    page.figures.push_back(writer.make(figure));
    progress.advance();
  }
  file.write(html_of(page));
  file.commit();
  if (!context.quiet) say_where(folder / "report.html");
  if (!gnuplot_available())
    report_error("the report has no pictures: install gnuplot (Debian package gnuplot-nox)");
}

}  // namespace holdfast::program
