#include "report/page/report.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "case/case_file.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "explorer/explorer_page.hpp"
#include "io/file/output.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "jobs/span/span_words.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "report/figures/figure.hpp"
#include "report/page/answers.hpp"
#include "report/page/html.hpp"
#include "store/work_store.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Arguments = std::vector<std::string>;
namespace fs = std::filesystem;

/// Folder of a report with data/ and pictures/. Folders created here are removed if they are still
/// empty, as after an interruption.
class ReportFolders {
 public:
  /// Throws WrongInput where a folder cannot be made.
  explicit ReportFolders(const fs::path& folder) {
    for (const fs::path& wanted : {folder / "data", folder / "pictures"}) {
      fs::path made;
      for (const fs::path& part : fs::absolute(wanted)) {
        made /= part;
        std::error_code failure;
        if (fs::create_directory(made, failure)) made_.push_back(made);
        if (failure) throw WrongInput("--output " + folder.string() + ": " + failure.message());
      }
    }
  }
  ~ReportFolders() {
    for (auto made = made_.rbegin(); made != made_.rend(); ++made) rmdir(made->c_str());
  }
  ReportFolders(const ReportFolders&) = delete;
  ReportFolders& operator=(const ReportFolders&) = delete;

 private:
  std::vector<fs::path> made_;
};

/// Report under construction. Its tables are written by command lines of the program.
class ReportWork {
 public:
  /// Begins a report. @param unit  unit of small lengths
  ReportWork(const JobContext& context, const Arguments& case_arguments, const CommandRunner& run,
             LengthUnit unit)
      : context_(context), run_(run), unit_(unit), folders_(*context.output) {
    page.case_arguments = case_arguments;
    page.case_text = case_to_toml(context.case_data);
  }

  /// Makes a figure: writes its tables and its picture, or records why there is no picture.
  DrawnFigure make(const Figure& figure) const {
    DrawnFigure drawn{figure, {}, {}, ""};
    for (const TableRequest& table : figure.tables)
      drawn.commands.push_back(shell_text(table.arguments, page.case_arguments) +
                               " --output data/" + table.name + ".csv");
    try {
      for (const TableRequest& table : figure.tables) write_table(table);
    } catch (const NoAnswer& reason) {
      drawn.reason = reason.what();
    } catch (const WrongInput& reason) {
      drawn.reason = reason.what();
    }
    return with_picture(std::move(drawn));
  }

  void add_figures(const std::vector<Figure>& figures, Progress& progress) {
    for (const Figure& figure : figures) {
      throw_if_interrupted();
      page.figures.push_back(make(figure));
      progress.advance();
    }
  }

  /// Writes the page; reports its path and any missing pictures.
  void finish() {
    file_.write(html_of(page));
    file_.commit();
    if (!context_.quiet) {
      OutputFile output(std::nullopt);
      output.write("Report: " + (fs::path(*context_.output) / "report.html").string() + "\n");
      output.commit();
    }
    if (!gnuplot_available())
      report_error("the report has no pictures: install gnuplot (Debian package gnuplot-nox)");
  }

  Page page;

 private:
  DrawnFigure with_picture(DrawnFigure drawn) const {
    if (!drawn.reason.empty()) return drawn;
    if (!can_draw_) {
      drawn.reason = "gnuplot is not installed (Debian package gnuplot-nox)";
      return drawn;
    }
    drawn.figure.length_unit = unit_;
    drawn.picture = page_picture(drawn.figure, *context_.output);
    return drawn;
  }

  void write_table(const TableRequest& table) const {
    const std::string file = (*context_.output / "data" / (table.name + ".csv")).string();
    // A sweep that was interrupted has left its chunks; this report may be one of another case.
    remove_left_work_store(file + ".zarr");
    Arguments arguments = command_of(table.arguments, page.case_arguments);
    arguments.insert(arguments.end(), {"--quiet", "--output", file});
    run_(arguments);
  }

  const JobContext& context_;
  const CommandRunner& run_;
  LengthUnit unit_;
  bool can_draw_ = gnuplot_available();
  ReportFolders folders_;
  OutputFile file_{*context_.output / "report.html"};
};

/// Unit for the displacements of a case, from the steady motion without control.
LengthUnit unit_of(const JobContext& context) {
  const Case& the_case = context.case_data;
  const double duration = std::min(20.0, end_of_force(the_case));
  const MovingLoop alone = motion_without_control(the_case, duration);
  return length_unit_for(metrics_of({alone}, duration, context.instructions).front().steady_peak);
}

std::string name_of_case(const JobContext& context, const char* builtin) {
  const std::string stem = fs::path(context.case_source.name).stem().string();
  return stem.empty() ? builtin : stem;
}

/// Title of a report on a control loop: "my-line: 21.3 Hz, τ = 5 ms, r₀ = 0.5 mm".
std::string title_of_loop(const JobContext& context) {
  return name_of_case(context, "A controlled cable") + ": " +
         rounded(effective_excitation(context.case_data).frequency, 4) + " Hz, " +
         loop_text(context.case_data);
}

/// Title of a report on a span: "my-line: a span of 300 m in the wind".
std::string title_of_span(const JobContext& context) {
  return page_text("title of span", {{"case", name_of_case(context, "The built-in case")},
                                     {"span", rounded(context.case_data.conductor.span, 4)}});
}

std::string introduction_of_span(const Case& the_case) {
  const Axis axis = aeolian_frequencies(the_case);
  const double diameter = the_case.conductor.diameter;
  std::string speeds;
  if (std::isfinite(diameter))
    speeds = page_text("speeds of span",
                       {{"calmest", rounded(axis.min * diameter / strouhal_of(the_case), 2)},
                        {"strongest", rounded(axis.max * diameter / strouhal_of(the_case), 2)}});
  return page_text(
      "introduction of span",
      {{"lowest", rounded(axis.min, 3)}, {"highest", rounded(axis.max, 3)}, {"speeds", speeds}});
}

}  // namespace

void write_report(const JobContext& context, const Arguments& case_arguments,
                  const CommandRunner& run) {
  const Case& the_case = context.case_data;
  require_loop_keys(the_case);
  excitation_of(the_case);
  const bool builtin = case_to_toml(the_case) == case_to_toml(load_case({}, {}));
  ReportWork work(context, case_arguments, run, unit_of(context));
  const std::vector<Figure> figures = figures_of(the_case, builtin);

  Page& page = work.page;
  page.title = builtin ? page_text("title of paper") : title_of_loop(context);
  page.explored = can_explore(the_case);
  if (page.explored)
    write_explorer_page(*context.output / "explorer.html", the_case, context.case_source);
  page.introduction = page_text(builtin ? "introduction of paper" : "introduction of case");
  page.motions =
      builtin ? paper_motions(the_case) : std::vector<MotionRow>{motion_of_the_case(the_case)};
  Progress progress(figures.size() + 1, "report", progress_wanted(context));
  answer(context, [&](const Answer& known) { page.answers.push_back(known); });
  progress.advance();
  work.add_figures(figures, progress);
  work.finish();
}

void write_span_report(const JobContext& context, const Arguments& case_arguments,
                       const CommandRunner& run) {
  ReportWork work(context, case_arguments, run, {});
  const std::vector<Figure> figures = span_figures(context.case_data);
  work.page.title = title_of_span(context);
  work.page.introduction = introduction_of_span(context.case_data);
  Progress progress(figures.size() + 1, "report", progress_wanted(context));
  work.add_figures(figures, progress);
  span_answers(context, [&](const Answer& known) { work.page.answers.push_back(known); });
  progress.advance();
  work.finish();
}

}  // namespace holdfast::program
