#include "report/picture/picture_panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The bytes encoded in base 64 (RFC 4648).
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

/// A number of tenths as a short decimal: 14 is "1.4", −4 is "-.4".
std::string of_tenths(long tenths) {
  const long size = std::labs(tenths);
  const std::string whole = size < 10 && size != 0 ? "" : std::to_string(size / 10);
  return (tenths < 0 ? "-" : "") + whole + (size % 10 == 0 ? "" : "." + std::to_string(size % 10));
}

/// A curve "M60.45,278.47 L70.20,278.47 …" with relative steps of tenths of a point; others as is.
std::string by_steps(const std::string& curve) {
  std::istringstream words(curve);
  std::string text;
  long x = 0, y = 0;
  bool drawn = false;  // a curve of no length may be a dot
  for (std::string word; words >> word;) {
    const std::size_t comma = std::min(word.find(','), word.size());
    const auto right = parse_number(std::string_view(word).substr(1, comma - 1));
    const auto down = parse_number(std::string_view(word).substr(std::min(comma + 1, word.size())));
    if ((word[0] != 'M' && word[0] != 'L') || !right || !down) return curve;
    const long to_x = std::lround(10.0 * *right), to_y = std::lround(10.0 * *down);
    const bool draws = word[0] == 'L';
    const long by_x = draws ? to_x - x : to_x, by_y = draws ? to_y - y : to_y;
    if (draws && drawn && by_x == 0 && by_y == 0) continue;
    text += (draws ? "l" : "M") + of_tenths(by_x) + (by_y < 0 ? "" : " ") + of_tenths(by_y);
    drawn = draws;
    x = to_x;
    y = to_y;
  }
  return text;
}

/// The SVG text without indents, with a short name of the colour blue and with long curves written
/// by relative steps; short curves, the shapes of points, remain since they may be scaled.
std::string shortened(const std::string& svg) {
  constexpr std::size_t longest_shape = 100;
  const std::string before = " d='";
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = svg.find(before); at != std::string::npos; at = svg.find(before, done)) {
    const std::size_t begin = at + before.size(), end = std::min(svg.find('\'', begin), svg.size());
    const std::string curve = svg.substr(begin, end - begin);
    text +=
        svg.substr(done, begin - done) + (curve.size() > longest_shape ? by_steps(curve) : curve);
    done = end;
  }
  return replaced(replaced(text + svg.substr(done), "\t", ""), "rgb(  0, 114, 178)", "#0072b2");
}

}  // namespace

std::string svg_url(const std::string& svg) {
  std::string text = shortened(svg);
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
  PagePicture vector{svg_url(drawing.bytes), drawing.panels};
  if (vector.url.size() <= short_enough) return vector;
  const Drawing dots = draw(figure, folder, ".png", false);
  PagePicture raster{png_url(dots.bytes), dots.panels};
  return raster.url.size() < vector.url.size() ? raster : vector;
}

}  // namespace holdfast::program
