#include "io/text/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace holdfast::program {
namespace {

constexpr std::size_t most_texts = std::size_t{1} << 16;
static_assert(sizeof(CellText) == 32);

}  // namespace

char* put_number(char* place, double value) {
  if (!std::isnan(value)) return std::to_chars(place, place + longest_number, value).ptr;
  std::memcpy(place, "nan", 3);  // to_chars would tell the sign of a NaN
  return place + 3;
}

char* put_number(char* place, std::int64_t value) {
  return std::to_chars(place, place + longest_number, value).ptr;
}

CellText cell_text(double value) {
  CellText text{};
  char* end = put_number(text.characters.data(), value);
  *end++ = ',';
  text.size = static_cast<std::uint8_t>(end - text.characters.data());
  return text;
}

AxisTexts::AxisTexts(const GridAxis& axis)
    : axis_(axis), texts_(std::min(axis.count(), most_texts)) {
  for (std::size_t i = 0; i < texts_.size(); ++i) texts_[i] = cell_text(axis_.at(i));
}

}  // namespace holdfast::program
