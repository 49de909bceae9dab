#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.hpp"
#include "report/page/answers.hpp"
#include "report/picture/picture_panels.hpp"

namespace holdfast::program {

/// Figure with its picture, or with the reason why there is none.
struct DrawnFigure {
  Figure figure;
  std::vector<std::string> commands;  ///< the command line of each table
  PagePicture picture;
  std::string reason;  ///< reason why there is no picture, else empty
};

/// Everything that the page shows.
struct Page {
  std::string title;
  std::string introduction;
  std::vector<std::string> case_arguments;  ///< the options that made the case
  std::string case_text;                    ///< the full case as TOML
  bool explored = false;                    ///< whether explorer.html lies beside the page
  std::vector<Answer> answers;              ///< questions of a designer, answered
  std::vector<MotionRow> motions;
  std::vector<DrawnFigure> figures;
};

/// Page as one self-contained HTML text: pictures are embedded, nothing is loaded.
std::string html_of(const Page& page);

/// Text of texts/page.toml by its name, with values for its @KEY@.
std::string page_text(const std::string& name, const Values& values = {});

/// Text with &, <, > and quotes escaped.
std::string escaped(const std::string& text);

}  // namespace holdfast::program
