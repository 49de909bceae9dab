#include "report/picture/page_picture.hpp"

#include <algorithm>
#include <cstddef>

#include "report/figures/gnuplot.hpp"
#include "report/picture/compact_svg.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

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

}  // namespace

std::string svg_url(const std::string& svg) {
  std::string text = svg;
  // A URL has no line ends; browsers leave them out.
  for (const auto& [character, escape] :
       {std::pair{"%", "%25"}, {"#", "%23"}, {"\"", "%22"}, {"\n", " "}})
    text = replaced(text, character, escape);
  return "data:image/svg+xml;charset=utf-8," + text;
}

std::string png_url(const std::string& png) { return "data:image/png;base64," + base64(png); }

PagePicture page_picture(const Figure& figure, const std::filesystem::path& folder) {
  constexpr std::size_t short_enough = 60000;
  const Drawing drawing = draw(figure, folder);
  PagePicture vector{svg_url(compact_svg(drawing.bytes)), drawing.panels};
  if (vector.url.size() <= short_enough) return vector;
  const Drawing dots = draw(figure, folder, ".png", false);
  PagePicture raster{png_url(dots.bytes), dots.panels};
  return raster.url.size() < vector.url.size() ? raster : vector;
}

}  // namespace holdfast::program
