#include "report/span/span_page.hpp"

#include <cmath>
#include <filesystem>

#include "case/case_file.hpp"
#include "case/model/span/span_of_case.hpp"
#include "io/file/output.hpp"
#include "jobs/span/span_words.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "report/figures/figure_writer.hpp"
#include "report/page/html.hpp"
#include "report/span/span_answers.hpp"
#include "report/span/span_figures.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// "my-line: a span of 300 m in its wind".
std::string title_of(const JobContext& context) {
  const std::string stem = fs::path(context.case_source.name).stem().string();
  return page_text("title of span", {{"case", stem.empty() ? "The built-in case" : stem},
                                     {"span", rounded(context.case_data.conductor.span, 4)}});
}

std::string introduction_of(const Case& the_case) {
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

void write_span_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                       const CommandRunner& run) {
  const fs::path folder = *context.output;
  const FigureWriter writer({folder, case_arguments, run});
  const ReportFolders folders(folder);
  OutputFile file(folder / "report.html");
  const std::vector<Figure> figures = span_figures(context.case_data);
  Progress progress(figures.size() + 1, "report", progress_wanted(context));
  std::vector<DrawnFigure> drawn;
  for (const Figure& figure : figures) {
    throw_if_interrupted();
    drawn.push_back(writer.make(figure));
    progress.advance();
  }
  const std::vector<Answer> answers = span_answers(context);
  progress.advance();
  write_page(context, file,
             page_text("span page", {{"head", page_head(title_of(context))},
                                     {"title", escaped(title_of(context))},
                                     {"introduction", introduction_of(context.case_data)},
                                     {"answers", answers_html(answers, case_arguments)},
                                     {"list of figures", list_of_figures(drawn)},
                                     {"figures", figures_html(drawn)},
                                     {"case", case_html(case_to_toml(context.case_data))},
                                     {"foot", page_foot()}}));
}

}  // namespace holdfast::program
