#pragma once

#include <string>
#include <vector>

#include "report/comparison/comparison.hpp"
#include "report/figures/figure.hpp"
#include "report/page/motions.hpp"

namespace holdfast::program {

/// A figure as it came out: its picture as SVG text, or the reason why there is none.
struct DrawnFigure {
  Figure figure;
  std::vector<std::string> commands;  ///< the command line of each table
  std::string svg;
  std::string reason;  ///< empty when there is a picture
};

/// Everything that the page shows.
struct Page {
  std::string title;
  std::string introduction;
  std::vector<std::string> case_arguments;  ///< the options that made the case
  std::string case_text;                    ///< the full case as TOML
  std::string answers;                      ///< HTML: what a designer asks, answered
  std::vector<Comparison> comparisons;      ///< may be empty
  std::vector<MotionRow> motions;
  std::string switching;  ///< HTML: how much the sampled switching matters
  std::vector<DrawnFigure> figures;
};

/// The page as one self-contained HTML text: pictures inside, nothing loaded from elsewhere.
std::string html_of(const Page& page);

/// A figure with its caption, its tables and the commands that make them.
std::string figure_html(const DrawnFigure& drawn);

/// A table that scrolls by itself where it is wider than the page.
/// @param rows  HTML, a <tr> each
std::string html_table(const std::vector<std::string>& headings, const std::string& rows);

/// Text of a number with so many significant digits.
std::string rounded(double value, int digits);

/// Text with &, <, > and quotes escaped.
std::string escaped(const std::string& text);

/// Base64 of RFC 4648.
std::string base64(const std::string& bytes);

}  // namespace holdfast::program
