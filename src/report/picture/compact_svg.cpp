#include "report/picture/compact_svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Lines = std::vector<std::string>;

/// A place in a drawing in hundredths of a point.
struct SvgPlace {
  long x = 0, y = 0;
  bool begins = false;  ///< the pen goes there without drawing
};

/// The place in "60.45,278.47"; none where that is no place.
std::optional<SvgPlace> place_of(std::string_view pair) {
  const std::size_t comma = std::min(pair.find(','), pair.size() - 1);
  const auto x = parse_number(pair.substr(0, comma)), y = parse_number(pair.substr(comma + 1));
  if (!x || !y) return std::nullopt;
  return SvgPlace{std::lround(100.0 * *x), std::lround(100.0 * *y)};
}

/// The places of a curve as gnuplot writes it, "M60.45,278.47 L70.20,278.47 …"; none where it has
/// other commands.
std::vector<SvgPlace> places_of_curve(const std::string& curve) {
  std::vector<SvgPlace> places;
  std::istringstream words(curve);
  for (std::string word; words >> word;) {
    std::optional<SvgPlace> place = place_of(std::string_view(word).substr(1));
    if ((word[0] != 'M' && word[0] != 'L') || !place) return {};
    place->begins = word[0] == 'M';
    places.push_back(*place);
  }
  return places;
}

/// 140 is "1.4", −42 is "-.42".
std::string number_of(long hundredths) {
  const long size = std::labs(hundredths), part = size % 100;
  std::string text = hundredths < 0 ? "-" : "";
  if (size >= 100 || size == 0) text += std::to_string(size / 100);
  if (part != 0)
    text += (part < 10 ? ".0" : ".") + std::to_string(part % 10 == 0 ? part / 10 : part);
  return text;
}

std::string pair_of(long x, long y) {
  const std::string second = number_of(y);
  return number_of(x) + (second[0] == '-' ? "" : " ") + second;
}

std::string step_between(const SvgPlace& from, const SvgPlace& to) {
  return pair_of(to.x - from.x, to.y - from.y);
}

/// To the nearest tenth of a point.
std::vector<SvgPlace> at_tenths(std::vector<SvgPlace> places) {
  const auto nearest = [](long value) {
    return 10 * std::lround(0.1 * static_cast<double>(value));
  };
  for (SvgPlace& place : places) {
    place.x = nearest(place.x);
    place.y = nearest(place.y);
  }
  return places;
}

/// A curve through places by steps, which are shorter than places; those of no length are left out.
/// The places of a long curve are rounded to tenths of a point.
std::string curve_by_steps(const std::vector<SvgPlace>& places) {
  constexpr std::size_t long_curve = 500;
  const std::vector<SvgPlace> shown = places.size() < long_curve ? places : at_tenths(places);
  std::string text;
  bool draws = false;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const SvgPlace& place = shown[k];
    if (k == 0 || place.begins) {
      text += "M" + pair_of(place.x, place.y);
      draws = false;
      continue;
    }
    const std::string step = step_between(shown[k - 1], place);
    if (draws && step == "0 0") continue;
    text += (!draws ? "l" : step[0] == '-' ? "" : " ") + step;
    draws = true;
  }
  return text;
}

/// A curve that has a part of no length at each place, in tenths of a point, which ends that are
/// round make a dot of.
std::string dots_by_steps(const std::vector<SvgPlace>& places) {
  const std::vector<SvgPlace> shown = at_tenths(places);
  std::string text;
  for (std::size_t k = 0; k < shown.size(); ++k)
    text += (k == 0 ? "M" + pair_of(shown[k].x, shown[k].y)
                    : "m" + step_between(shown[k - 1], shown[k])) +
            "h0";
  return text;
}

/// The shapes of points are short, and drawn at any size.
std::string shortened_curve(const std::string& curve) {
  constexpr std::size_t longest_shape = 100;
  if (curve.size() <= longest_shape) return curve;
  const std::vector<SvgPlace> places = places_of_curve(curve);
  return places.empty() ? curve : curve_by_steps(places);
}

/// Every curve in the drawing by steps.
std::string with_short_curves(const std::string& svg) {
  const std::string before = " d='";
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = svg.find(before); at != std::string::npos; at = svg.find(before, done)) {
    const std::size_t begin = at + before.size(), end = svg.find('\'', begin);
    if (end == std::string::npos) break;
    text += svg.substr(done, begin - done) + shortened_curve(svg.substr(begin, end - begin));
    done = end;
  }
  return text + svg.substr(done);
}

/// The text without what stands from a beginning to the next end.
std::string without(std::string text, const std::string& beginning, const std::string& ending) {
  for (std::size_t at = text.find(beginning); at != std::string::npos;
       at = text.find(beginning, at)) {
    const std::size_t end = text.find(ending, at);
    if (end == std::string::npos) return text;
    text.erase(at, end + ending.size() - at);
  }
  return text;
}

/// Without indents, blank lines and groups of nothing.
Lines lines_of(const std::string& svg) {
  Lines lines;
  for (const std::string_view part : split(svg, '\n')) {
    const std::string line(trimmed(part));
    const bool ends_nothing = line == "</g>" && !lines.empty() &&
                              begins_with(lines.back(), "<g ") &&
                              lines.back().find('>') + 1 == lines.back().size();
    if (ends_nothing)
      lines.pop_back();
    else if (!line.empty())
      lines.push_back(line);
  }
  return lines;
}

/// A filled circle: where it is, how large, and its colour.
struct Dot {
  std::optional<SvgPlace> place;  ///< none where the line draws something else
  std::string scale, colour;
};

/// The text behind a part, up to the next end.
std::string between(const std::string& line, const std::string& part, const std::string& end) {
  const std::size_t at = line.find(part);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + part.size();
  return line.substr(begin, line.find(end, begin) - begin);
}

/// "<use xlink:href='#gpPt6' transform='translate(219.88,156.12) scale(0.88)' color='…'/>"
Dot dot_of(const std::string& line) {
  if (!begins_with(line, "<use xlink:href='#gpPt6' transform='translate(")) return {};
  return {place_of(between(line, "translate(", ")")), between(line, "scale(", ")"),
          between(line, "color='", "'")};
}

bool alike(const Dot& one, const Dot& other) {
  return one.scale == other.scale && one.colour == other.colour;
}

/// The dots as one curve whose ends are round and as wide as the dots.
std::string drawn_dots(const Dot& dot, const std::vector<SvgPlace>& places) {
  constexpr double diameter = 2.205;  // of gnuplot's shape, of radius 1 and with an edge
  const double width = diameter * parse_number(dot.scale).value_or(0.0);
  return "<path fill='none' stroke='" + dot.colour + "' stroke-linecap='round' stroke-width='" +
         format_rounded(width) + "' d='" + dots_by_steps(places) + "'/>";
}

/// Dots that are alike and follow each other as one curve.
Lines with_joined_dots(const Lines& lines) {
  Lines joined;
  for (auto line = lines.begin(); line != lines.end();) {
    const Dot first = dot_of(*line);
    std::vector<SvgPlace> places;
    const auto begin = line;
    for (Dot dot = first; dot.place && alike(dot, first);
         dot = ++line == lines.end() ? Dot{} : dot_of(*line))
      places.push_back(*dot.place);
    constexpr std::size_t cloud = 8;
    if (places.size() >= cloud)
      joined.push_back(drawn_dots(first, places));
    else if (line == begin)
      joined.push_back(*line++);
    else
      joined.insert(joined.end(), begin, line);
  }
  return joined;
}

}  // namespace

std::string compact_svg(const std::string& svg) {
  const std::string drawing = without(without(svg, "<title>", "</title>"), "<desc>", "</desc>");
  const std::string short_curves = with_short_curves(without(drawing, "<?xml", "?>"));
  std::string text;
  for (const std::string& line : with_joined_dots(lines_of(short_curves))) text += line + "\n";
  return text;
}

}  // namespace holdfast::program
