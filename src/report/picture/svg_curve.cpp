#include "report/picture/svg_curve.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "io/text/double_digits.hpp"

namespace holdfast::program {
namespace {

/// Reads a curve of gnuplot's.
class CurveReader {
 public:
  explicit CurveReader(const std::string& curve)
      : at_(curve.data()), end_(curve.data() + curve.size()) {}

  bool has_more() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\n')) ++at_;
    return at_ != end_;
  }

  /// The letter of a command.
  char letter() { return *at_++; }

  /// "60.45,278.47"
  std::optional<SvgPlace> place() {
    const auto x = hundredths();
    if (!x || at_ == end_ || *at_++ != ',') return std::nullopt;
    const auto y = hundredths();
    if (!y) return std::nullopt;
    return SvgPlace{*x, *y, false};
  }

 private:
  std::optional<long> hundredths() {
    double value = 0.0;
    const auto [behind, error] = read_digits({at_, static_cast<std::size_t>(end_ - at_)}, value);
    if (error != std::errc()) return std::nullopt;
    at_ = behind;
    return std::lround(100.0 * value);
  }

  const char *at_, *end_;
};

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

}  // namespace

std::vector<SvgPlace> places_of_curve(const std::string& curve) {
  std::vector<SvgPlace> places;
  CurveReader reader(curve);
  while (reader.has_more()) {
    const char letter = reader.letter();
    std::optional<SvgPlace> place = reader.place();
    if ((letter != 'M' && letter != 'L') || !place) return {};
    place->begins = letter == 'M';
    places.push_back(*place);
  }
  return places;
}

std::vector<SvgPlace> place_of(const std::string& pair) {
  CurveReader reader(pair);
  const std::optional<SvgPlace> place = reader.place();
  if (!place || reader.has_more()) return {};
  return {*place};
}

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

std::string dots_by_steps(const std::vector<SvgPlace>& places) {
  const std::vector<SvgPlace> shown = at_tenths(places);
  std::string text;
  for (std::size_t k = 0; k < shown.size(); ++k)
    text += (k == 0 ? "M" + pair_of(shown[k].x, shown[k].y)
                    : "m" + step_between(shown[k - 1], shown[k])) +
            "h0";
  return text;
}

}  // namespace holdfast::program
