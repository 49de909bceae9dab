#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace holdfast::program {

struct Figure;

/// Axis of a panel: name, and values at its two ends. An axis without a name shows no values.
struct PanelAxis {
  std::string name;  ///< name of the quantity: "displacement z₁"
  std::string unit;  ///< unit: "mm", or ""
  double from = 0.0, to = 0.0;
  bool logarithmic = false;
};

/// Panel of a picture: its edges, as fractions of the picture's width and height from the upper
/// left corner, and its axes.
struct PicturePanel {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  PanelAxis x, y, right_axis;
};

/// gnuplot commands with, after each plot, a command that prints the panel's place and axes.
std::string with_measured_panels(const std::string& plot);

/// Panels measured by gnuplot, from its messages. A panel without a label gets the label of the
/// panel below or to the left, with which it shares the axis.
std::vector<PicturePanel> measured_panels(const std::string& messages);

/// Messages of gnuplot without the lines that with_measured_panels() makes it print.
std::string without_panels(const std::string& messages);

/// Label of an axis as plain text, without gnuplot's marks for fonts, indices and non-breaking
/// blanks: "displacement {/:Italic z}_1 (mm)" is "displacement z₁ (mm)".
std::string plain_label(const std::string& label);

/// JSON text of a picture's panels for the script of the page: a list of {"box": [left, top, right,
/// bottom], "x": {"name", "unit", "from", "to", "log"}, "y", "right"}, in which an axis without a
/// name is left out.
std::string panels_json(const std::vector<PicturePanel>& panels);

/// Picture as embedded in a page.
struct PagePicture {
  std::string url;  ///< data URL: "data:image/svg+xml;charset=utf-8,…"
  std::vector<PicturePanel> panels;
};

/// Draws a figure as pictures/NAME.svg, with its script, and returns the picture to be embedded:
/// the SVG if it is short, else a PNG with two pixels per point if that is shorter, as for curves
/// of ten thousand points. Throws what draw() throws.
PagePicture page_picture(const Figure& figure, const std::filesystem::path& folder);

/// SVG text as a data URL (RFC 2397), with gnuplot's long curves written by relative steps. Quotes,
/// "#" and "%" are escaped; inside double quotes of HTML only "&" is left to escape.
std::string svg_url(const std::string& svg);

/// Data URL of a PNG picture, from its bytes.
std::string png_url(const std::string& png);

}  // namespace holdfast::program
