#include "report/page/html.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/page/command_line.hpp"

namespace holdfast::program {
namespace {

constexpr const char* page_style = R"(
:root { color-scheme: light dark; --ink: #1d2329; --soft: #5a646e; --paper: #ffffff; --line: #d8dee4;
        --good: #00664a; --bad: #a33b00; --code: #f4f6f8;
        --link: #0b5cad; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e8ec; --soft: #a7b0b9; --paper: #15191d; --line: #343c44; --good: #58c9a3;
          --bad: #ffa36b; --code: #20262c; --link: #8ec2ff; } }
a { color: var(--link); }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { margin-top: 2.5rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 0.9rem; }
th, td { text-align: left; vertical-align: top; padding: 0.35rem 0.6rem; border-bottom: 1px solid var(--line); }
td.agrees { color: var(--good); font-weight: 600; white-space: nowrap; } td.differs { color: var(--bad); }
tr.motion td { border-bottom: 0; padding-bottom: 0; } td.verdict { font-weight: 600; white-space: nowrap; }
tr.basis td { color: var(--soft); font-size: 0.85rem; } tr.basis p { margin: 0 0 0.2rem; }
figure { margin: 2.5rem 0; break-inside: avoid; }
figure img { width: 100%; max-width: 46rem; height: auto; background: #fff; border-radius: 4px; }
figcaption { color: var(--soft); font-size: 0.95rem; }
h3 { margin: 0 0 0.4rem; font-size: 1.1rem; }
pre, code { font: 0.82rem/1.45 ui-monospace, monospace; } pre { background: var(--code); padding: 0.7rem;
  overflow-x: auto; border-radius: 4px; }
details { margin: 0.4rem 0; } summary { cursor: pointer; color: var(--soft); font-size: 0.9rem; }
nav { display: flex; flex-wrap: wrap; gap: 0.3rem 1.2rem; margin: 1rem 0; } nav a { color: var(--link); }
.answer { border-left: 3px solid var(--line); padding: 0.1rem 0 0.1rem 1rem; margin: 1.2rem 0;
  break-inside: avoid; }
.answer .said { font-size: 1.15rem; font-weight: 600; margin: 0.2rem 0; }
.answer .why { color: var(--soft); font-size: 0.92rem; margin: 0.2rem 0; }
.none { border: 1px dashed var(--line); padding: 1rem; color: var(--bad); }
@media print { body { max-width: none; margin: 0; } details, nav { display: none; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; } .scroll { overflow: visible; }
  h2, h3 { break-after: avoid; } table { font-size: 0.75rem; } tr { break-inside: avoid; }
  figure { margin: 1.2rem 0; } figure img { max-width: 36rem; } }
)";

std::string comparison_row(const Comparison& row) {
  const std::string verdict = row.agrees ? "agrees" : "differs";
  const std::string reason = row.why.empty() ? "" : ": " + row.why;
  return "<tr><td>" + escaped(row.quantity) + "</td><td>" + escaped(row.paper) + "</td><td>" +
         escaped(row.ours) + "</td><td>" + escaped(row.reading) + "</td><td class=\"" + verdict +
         "\">" + verdict + escaped(reason) + "</td></tr>\n";
}

std::string comparison_table(const std::vector<Comparison>& comparisons) {
  if (comparisons.empty()) return "";
  const auto agreeing = std::count_if(comparisons.begin(), comparisons.end(),
                                      [](const Comparison& row) { return row.agrees; });
  const std::string html =
      "<h2 id=\"comparison\">The paper and this program</h2>\n<p>" + std::to_string(agreeing) +
      " of " + std::to_string(comparisons.size()) +
      " comparisons agree within what the paper's print allows. Every value in the column "
      "<em>ours</em> was computed for this page; the reading says how the paper was "
      "understood.</p>\n";
  std::string rows;
  for (const Comparison& row : comparisons) rows += comparison_row(row);
  return html + html_table({"quantity", "paper", "ours", "reading", "verdict"}, rows);
}

/// Two rows of the table: the numbers, and below them what they rest on.
std::string motion_rows(const MotionRow& row, const std::string& command) {
  std::string html = "<tr class=\"motion\">";
  for (const std::string* cell : {&row.place, &row.motion, &row.verdict, &row.period,
                                  &row.multiplier, &row.border, &row.capture, &row.precision}) {
    html += (cell == &row.verdict ? "<td class=\"verdict\">" : "<td>") + escaped(*cell) + "</td>";
  }
  html += "</tr>\n<tr class=\"basis\"><td></td><td colspan=\"7\">";
  if (!row.neighbour.empty())
    html += "<p>Beside the motion from rest: <strong>" + escaped(row.neighbour) + "</strong>.</p>";
  return html + "<p>" + escaped(row.rests_on) + "</p><code>" + escaped(command) +
         "</code></td></tr>\n";
}

constexpr const char* motions_text =
    "<p>A motion whose contacts repeat solves one linear system. Where the solution reproduces its "
    "own contacts, attracts its neighbours and touches no switching surface, the motion is "
    "certified: it has exactly this period, however irregular it looks. <em>Multiplier</em>: what "
    "is left of a small deviation after one period. <em>Change of contact</em>: how far the orbit "
    "stays from the nearest end of a gap (mm) and the nearest reversal (mm/s) that would switch "
    "another way. <em>Capture</em>: every motion so near to the orbit, at the same phase of the "
    "forcing, tends to it; smallest and largest radius along the orbit. <em>Extended "
    "precision</em>: the same orbit computed in <code>long double</code>, and by how much its "
    "displacements differ. A <em>coincidence</em> is a sample that falls on the same phase of the "
    "forcing.</p>\n";

std::string motions_table(const Page& page) {
  if (page.motions.empty()) return "";
  std::string rows;
  for (const MotionRow& motion : page.motions)
    rows += motion_rows(motion, shell_text(motion.arguments, page.case_arguments));
  return std::string("<h2 id=\"motions\">What the motion is</h2>\n") + motions_text +
         html_table({"figure", "case", "verdict", "period", "largest multiplier",
                     "nearest change of contact", "radius of capture", "extended precision"},
                    rows);
}

std::string contents_of(const Page& page) {
  std::string html = "<nav><a href=\"#answers\">The answers</a> <a href=\"#figures\">Figures</a>";
  if (!page.motions.empty()) html += " <a href=\"#motions\">What the motion is</a>";
  html += " <a href=\"#switching\">Between the samples</a>";
  if (!page.comparisons.empty()) html += " <a href=\"#comparison\">Paper and program</a>";
  return html + " <a href=\"#case\">The case</a></nav>\n";
}

std::string picture(const DrawnFigure& drawn) {
  if (!drawn.reason.empty())
    return "<p class=\"none\">No picture: " + escaped(drawn.reason) + "</p>\n";
  return "<img alt=\"" + escaped(drawn.figure.title + ". " + drawn.figure.caption) +
         "\" src=\"data:image/svg+xml;base64," + base64(drawn.svg) + "\">\n";
}

}  // namespace

std::string figure_html(const DrawnFigure& drawn) {
  std::string html = "<figure id=\"" + drawn.figure.name + "\">\n<h3>" +
                     escaped(drawn.figure.title) + "</h3>\n" + picture(drawn) + "<figcaption>" +
                     escaped(drawn.figure.caption) + "</figcaption>\n" +
                     "<details><summary>Tables and the commands that make them</summary>\n<ul>\n";
  for (const TableRequest& table : drawn.figure.tables) {
    html += "<li><a href=\"data/" + table.name + ".csv\">data/" + table.name + ".csv</a></li>\n";
  }
  html += "</ul>\n<pre>";
  for (const std::string& command : drawn.commands) html += escaped(command) + "\n";
  return html + "</pre></details>\n</figure>\n";
}

std::string html_table(const std::vector<std::string>& headings, const std::string& rows) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const std::string& heading : headings) html += "<th>" + escaped(heading) + "</th>";
  return html + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return replaced(text, "-", "−");
}

std::string escaped(const std::string& text) {
  std::string result = replaced(text, "&", "&amp;");
  for (const auto& [character, entity] :
       {std::pair{"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}})
    result = replaced(result, character, entity);
  return result;
}

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

std::string html_of(const Page& page) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(page.title) + "</title>\n<style>" + page_style + "</style>\n</head>\n<body>\n<h1>" +
      escaped(page.title) + "</h1>\n<p>" + page.introduction + "</p>\n";
  html += contents_of(page);
  html += page.answers;
  html += "<h2 id=\"figures\">Figures</h2>\n";
  for (const DrawnFigure& drawn : page.figures) html += figure_html(drawn);
  html += motions_table(page);
  html += page.switching;
  html += comparison_table(page.comparisons);
  html += "<h2 id=\"case\">The case</h2>\n<pre>" + escaped(page.case_text) +
          "</pre>\n</body>\n</html>\n";
  return html;
}

}  // namespace holdfast::program
