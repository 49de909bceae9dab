#include "report/page/report.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "case/case_file.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "explorer/explorer_page.hpp"
#include "io/file/output.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "report/figures/figure.hpp"
#include "report/figures/figure_writer.hpp"
#include "report/page/answers.hpp"
#include "report/page/html.hpp"
#include "report/switching/switching_page.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {
namespace {

using Arguments = std::vector<std::string>;
namespace fs = std::filesystem;

bool is_builtin(const Case& the_case) {
  return case_to_toml(the_case) == case_to_toml(load_case({}, {}));
}

/// The unit of the case's displacements.
LengthUnit unit_of(const Case& the_case) {
  const double duration = std::min(20.0, end_of_force(the_case));
  return length_unit_for(amplitude_without_control(the_case, duration));
}

/// "my-line: 21.3 Hz, τ = 5 ms, r₀ = 0.5 mm".
std::string title_of(const JobContext& context, bool builtin) {
  if (builtin) return page_text("title of paper");
  const Case& the_case = context.case_data;
  const std::string stem = fs::path(context.case_source.name).stem().string();
  return (stem.empty() ? "A controlled cable" : stem) + ": " +
         rounded(effective_excitation(the_case).frequency, 4) + " Hz, " + loop_text(the_case);
}

std::string switching_part(const JobContext& context, bool builtin, const FigureWriter& writer) {
  SwitchingPage page = make_switching_page(context, builtin);
  for (DrawnFigure& figure : page.figures) figure = writer.drawn(std::move(figure));
  return html_of(page);
}

/// The explorer of the same case beside the page, where it was built; gives whether it is there.
bool write_explorer(const JobContext& context, const fs::path& folder) {
  if (!can_explore(context.case_data)) return false;
  write_explorer_page(folder / "explorer.html", context.case_data, context.case_source);
  return true;
}

}  // namespace

void write_report(const JobContext& context, const Arguments& case_arguments,
                  const CommandRunner& run) {
  require_loop_keys(context.case_data);
  excitation_of(context.case_data);
  const bool builtin = is_builtin(context.case_data);
  const fs::path folder = *context.output;
  // Refuses loops that are too stiff.
  const FigureWriter writer({folder, case_arguments, run, unit_of(context.case_data)});
  const ReportFolders folders(folder);
  OutputFile file(folder / "report.html");
  const std::vector<Figure> figures = figures_of(context.case_data, builtin);

  Page page;
  page.title = title_of(context, builtin);
  page.explored = write_explorer(context, folder);
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
  write_page(context, file, html_of(page));
}

}  // namespace holdfast::program
