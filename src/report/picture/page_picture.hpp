#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/figures/figure.hpp"
#include "report/picture/picture_panels.hpp"

namespace holdfast::program {

/// A picture as a page holds it.
struct PagePicture {
  std::string url;  ///< "data:image/svg+xml;charset=utf-8,…"
  std::vector<PicturePanel> panels;
};

/// Draws a figure as pictures/NAME.svg, with its script, and gives the picture that the page shows:
/// the same drawing as long as that is short, else the dots of it, two to a point, if these are
/// shorter. Curves of ten thousand points and clouds of them are so. Throws what draw() throws.
PagePicture page_picture(const Figure& figure, const std::filesystem::path& folder);

/// An SVG text as a URL that holds it (RFC 2397). Its quotes, "#" and "%" are escaped: between
/// double quotes of HTML "&" alone is left to escape.
std::string svg_url(const std::string& svg);

/// The same of the bytes of a PNG.
std::string png_url(const std::string& png);

}  // namespace holdfast::program
