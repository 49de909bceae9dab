#include "report/page/html.hpp"

#include <algorithm>

#include "report/figures/figure.hpp"
#include "text/compiled_texts.hpp"

namespace holdfast::program {

namespace {

/// HTML table that scrolls if it is wider than the page.
/// @param rows  rows as HTML
std::string html_table(const std::vector<std::string>& headings, const std::string& rows) {
  std::string html, all;
  for (const std::string& heading : headings) {
    html += "<th scope=\"col\">" + escaped(heading) + "</th>";
    all += (all.empty() ? "" : ", ") + escaped(heading);
  }
  const std::string name = page_text("table named", {{"headings", all}});
  return page_text("table", {{"name", name}, {"headings", html}, {"rows", rows}});
}

std::string motions_part(const Page& page) {
  if (page.motions.empty()) return "";
  std::string rows;
  for (const MotionRow& row : page.motions) {
    rows +=
        page_text("motion", {{"place", escaped(row.place)},
                             {"motion", escaped(row.motion)},
                             {"verdict", escaped(row.verdict)},
                             {"period", escaped(row.period)},
                             {"multiplier", escaped(row.multiplier)},
                             {"border", escaped(row.border)},
                             {"capture", escaped(row.capture)},
                             {"rests on", escaped(row.rests_on)},
                             {"command", escaped(shell_text(row.arguments, page.case_arguments))}});
  }
  return page_text(
      "motions",
      {{"table", html_table({"figure", "case", "verdict", "period", "largest multiplier",
                             "distance to the nearest change of contact", "radius of attraction"},
                            rows)}});
}

/// Text on the axes of a picture's panels: "displacement z₁ over time t".
std::string axes_text(const std::vector<PicturePanel>& panels) {
  std::string text;
  for (const PicturePanel& panel : panels) {
    if (panel.x.name.empty() || panel.y.name.empty()) continue;
    const std::string axes = page_text("axes of panel", {{"x", panel.x.name}, {"y", panel.y.name}});
    if (text.find(axes) == std::string::npos) text += (text.empty() ? "" : "; ") + axes;
  }
  return text.empty() ? "" : page_text("axes of picture", {{"axes", text}});
}

std::string picture(const DrawnFigure& drawn) {
  if (!drawn.reason.empty()) return page_text("no picture", {{"reason", escaped(drawn.reason)}});
  const PagePicture& shown = drawn.picture;
  return page_text("picture", {{"name", drawn.figure.name},
                               {"title", escaped(drawn.figure.title)},
                               {"axes", escaped(axes_text(shown.panels))},
                               {"height", rounded(drawn.figure.height, 6)},
                               {"panels", escaped(panels_json(shown.panels))},
                               {"source", replaced(shown.url, "&", "&amp;")}});
}

/// Links to the tables and pictures of a figure.
std::string links_to_files(const DrawnFigure& drawn) {
  std::string links;
  for (const TableRequest& table : drawn.figure.tables)
    links += page_text("link to table", {{"name", table.name}});
  return links +
         (drawn.reason.empty() ? page_text("links to picture", {{"name", drawn.figure.name}}) : "");
}

std::string figure_html(const DrawnFigure& drawn) {
  std::string commands;
  for (const std::string& command : drawn.commands) commands += escaped(command) + "\n";
  const bool several = drawn.commands.size() > 1;
  return page_text("figure", {{"name", drawn.figure.name},
                              {"title", escaped(drawn.figure.title)},
                              {"picture", picture(drawn)},
                              {"caption", escaped(drawn.figure.caption)},
                              {"made by", page_text(several ? "made by several" : "made by one")},
                              {"commands", commands},
                              {"files", links_to_files(drawn)}});
}

std::string figures_html(const std::vector<DrawnFigure>& figures) {
  std::string html;
  for (const DrawnFigure& drawn : figures) html += figure_html(drawn);
  return html;
}

/// Foldable HTML list of links to figures.
std::string list_of_figures(const std::vector<DrawnFigure>& figures) {
  std::string links;
  for (const DrawnFigure& drawn : figures)
    links += page_text("link to figure",
                       {{"name", drawn.figure.name}, {"title", escaped(drawn.figure.title)}});
  return page_text("list of figures",
                   {{"count", std::to_string(figures.size())}, {"links", links}});
}

/// HTML of the answers, each with the command that shows its numbers.
std::string answers_part(const Page& page) {
  std::string html;
  for (const Answer& answer : page.answers)
    html += page_text("answer",
                      {{"question", escaped(answer.question)},
                       {"answer", escaped(answer.answer)},
                       {"detail", escaped(answer.detail)},
                       {"command", escaped(shell_text(answer.arguments, page.case_arguments))}});
  return html;
}

/// The only text of a compiled-in file of texts, which has the given name.
std::string only_text(std::string_view file, const char* name) {
  return text_of(toml::parse(file)[name]);
}

}  // namespace

std::string page_text(const std::string& name, const Values& values) {
  static const toml::table texts = toml::parse(page_texts);
  return text_of(texts[name], values);
}

std::string escaped(const std::string& text) {
  std::string result = replaced(text, "&", "&amp;");
  for (const auto& [character, entity] :
       {std::pair{"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}})
    result = replaced(result, character, entity);
  return result;
}

std::string html_of(const Page& page) {
  const auto link_to = [](const std::string& part, bool is_there) {
    return is_there ? page_text("to " + part) : "";
  };
  return page_text(
      "page", {{"head", page_text("head", {{"title", escaped(page.title)},
                                           {"style", only_text(page_style_texts, "style")}})},
               {"title", escaped(page.title)},
               {"introduction", page.introduction},
               {"to explorer", link_to("explorer", page.explored)},
               {"to motions", link_to("motions", !page.motions.empty())},
               {"answers", answers_part(page)},
               {"list of figures", list_of_figures(page.figures)},
               {"figures", figures_html(page.figures)},
               {"motions", motions_part(page)},
               {"case", page_text("case", {{"case", escaped(page.case_text)}})},
               {"foot", page_text("foot", {{"script", only_text(page_script_texts, "script")}})}});
}

}  // namespace holdfast::program
