#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace holdfast::program {

struct Figure;

/// An axis of a panel: what it is called, and what it shows at its two ends. One without a name has
/// no values to tell.
struct PanelAxis {
  std::string name;  ///< "displacement z₁"
  std::string unit;  ///< "mm", or ""
  double from = 0.0, to = 0.0;
  bool logarithmic = false;
};

/// A panel of a picture: where it lies, in parts of the picture's width and height from its upper
/// left corner, and its axes.
struct PicturePanel {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  PanelAxis x, y, right_axis;
};

/// A script's plots, each with a question behind it that gnuplot answers where somebody wants to
/// know its panels.
std::string with_measured_panels(const std::string& plot);

/// Panels that gnuplot has measured, from its messages. A panel without a label has that of the
/// panel below it or left of it, with which it shares the axis.
std::vector<PicturePanel> measured_panels(const std::string& messages);

/// The other messages.
std::string without_panels(const std::string& messages);

/// The label of an axis as plain text, without gnuplot's marks of fonts, indices and blanks that do
/// not break: "displacement {/:Italic z}_1 (mm)" is "displacement z₁ (mm)".
std::string plain_label(const std::string& label);

/// The panels of a picture as the script of the page reads them: a list of
/// {"box": [left, top, right, bottom], "x": {"name", "unit", "from", "to", "log"}, "y", "right"},
/// in which an axis without a name is left out.
std::string panels_json(const std::vector<PicturePanel>& panels);

/// A picture as a page holds it.
struct PagePicture {
  std::string url;  ///< "data:image/svg+xml;charset=utf-8,…"
  std::vector<PicturePanel> panels;
};

/// Draws a figure as pictures/NAME.svg, with its script, and gives the picture that the page shows:
/// the same drawing as long as that is short, else the dots of it, two to a point, if these are
/// shorter. Curves of ten thousand points and clouds of them are so. Throws what draw() throws.
PagePicture page_picture(const Figure& figure, const std::filesystem::path& folder);

/// An SVG text as a URL that holds it (RFC 2397), long curves of gnuplot's by steps. Its quotes,
/// "#" and "%" are escaped: between double quotes of HTML "&" alone is left to escape.
std::string svg_url(const std::string& svg);

/// Address of a picture by the bytes of its PNG.
std::string png_url(const std::string& png);

}  // namespace holdfast::program
