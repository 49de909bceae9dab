#include "report/page/html.hpp"

#include <algorithm>

#include "io/text/compiled_texts.hpp"
#include "report/page/command_line.hpp"

namespace holdfast::program {

namespace {

std::string comparison_part(const std::vector<Comparison>& comparisons) {
  if (comparisons.empty()) return "";
  std::string rows;
  for (const Comparison& row : comparisons)
    rows += page_text("comparison row", {{"quantity", escaped(row.quantity)},
                                         {"paper", escaped(row.paper)},
                                         {"ours", escaped(row.ours)},
                                         {"reading", escaped(row.reading)},
                                         {"verdict", row.agrees ? "agrees" : "differs"},
                                         {"why", row.why.empty() ? "" : ": " + escaped(row.why)}});
  const auto agreeing = std::count_if(comparisons.begin(), comparisons.end(),
                                      [](const Comparison& row) { return row.agrees; });
  return page_text(
      "comparison",
      {{"agreeing", std::to_string(agreeing)},
       {"all", std::to_string(comparisons.size())},
       {"table", html_table({"quantity", "paper", "ours", "reading", "verdict"}, rows)}});
}

std::string motions_part(const Page& page) {
  if (page.motions.empty()) return "";
  std::string rows;
  for (const MotionRow& row : page.motions) {
    const std::string beside = page_text("beside rest", {{"neighbour", escaped(row.neighbour)}});
    rows +=
        page_text("motion", {{"place", escaped(row.place)},
                             {"motion", escaped(row.motion)},
                             {"verdict", escaped(row.verdict)},
                             {"period", escaped(row.period)},
                             {"multiplier", escaped(row.multiplier)},
                             {"border", escaped(row.border)},
                             {"capture", escaped(row.capture)},
                             {"precision", escaped(row.precision)},
                             {"beside", row.neighbour.empty() ? "" : beside},
                             {"rests on", escaped(row.rests_on)},
                             {"command", escaped(shell_text(row.arguments, page.case_arguments))}});
  }
  return page_text(
      "motions", {{"table", html_table({"figure", "case", "verdict", "period", "largest multiplier",
                                        "nearest change of contact", "radius of capture",
                                        "extended precision"},
                                       rows)}});
}

/// Of RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr const char* alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t present = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < present ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= present ? alphabet[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return result;
}

std::string picture(const DrawnFigure& drawn) {
  if (!drawn.reason.empty()) return page_text("no picture", {{"reason", escaped(drawn.reason)}});
  return page_text("picture", {{"title", escaped(drawn.figure.title)},
                               {"caption", escaped(drawn.figure.caption)},
                               {"svg", base64(drawn.svg)}});
}

std::string figure_html(const DrawnFigure& drawn) {
  std::string tables, commands;
  for (const TableRequest& table : drawn.figure.tables)
    tables += page_text("link to table", {{"name", table.name}});
  for (const std::string& command : drawn.commands) commands += escaped(command) + "\n";
  return page_text("figure", {{"name", drawn.figure.name},
                              {"title", escaped(drawn.figure.title)},
                              {"picture", picture(drawn)},
                              {"caption", escaped(drawn.figure.caption)},
                              {"tables", tables},
                              {"commands", commands}});
}

}  // namespace

std::string page_text(const std::string& name, const Values& values) {
  static const toml::table texts = toml::parse(page_texts);
  return text_of(texts[name], values);
}

std::string figures_html(const std::vector<DrawnFigure>& figures) {
  std::string html;
  for (const DrawnFigure& drawn : figures) html += figure_html(drawn);
  return html;
}

std::string answers_html(const std::vector<Answer>& answers,
                         const std::vector<std::string>& case_arguments) {
  std::string html;
  for (const Answer& answer : answers)
    html +=
        page_text("answer", {{"question", escaped(answer.question)},
                             {"answer", escaped(answer.answer)},
                             {"detail", escaped(answer.detail)},
                             {"command", escaped(shell_text(answer.arguments, case_arguments))}});
  return html;
}

std::string html_row(const std::vector<std::string>& cells) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
  return html + "</tr>\n";
}

std::string html_table(const std::vector<std::string>& headings, const std::string& rows) {
  std::string html;
  for (const std::string& heading : headings) html += "<th>" + escaped(heading) + "</th>";
  return page_text("table", {{"headings", html}, {"rows", rows}});
}

std::string escaped(const std::string& text) {
  std::string result = replaced(text, "&", "&amp;");
  for (const auto& [character, entity] :
       {std::pair{"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}})
    result = replaced(result, character, entity);
  return result;
}

std::string html_of(const Page& page) {
  return page_text("page",
                   {{"head", page_text("head", {{"title", escaped(page.title)}})},
                    {"title", escaped(page.title)},
                    {"introduction", page.introduction},
                    {"to motions", page.motions.empty() ? "" : page_text("to motions")},
                    {"to comparison", page.comparisons.empty() ? "" : page_text("to comparison")},
                    {"answers", answers_html(page.answers, page.case_arguments)},
                    {"figures", figures_html(page.figures)},
                    {"motions", motions_part(page)},
                    {"switching", page.switching},
                    {"comparison", comparison_part(page.comparisons)},
                    {"case", escaped(page.case_text)}});
}

}  // namespace holdfast::program
