#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "case/axes/grid.hpp"

namespace holdfast::program {

/// "-2.2250738585072014e-308"
constexpr std::size_t longest_number = 24;

/// Writes the digits that CsvWriter writes: the shortest that read back the same; `inf`, `-inf`,
/// `nan`. At most longest_number characters. Returns the place behind them.
char* put_number(char* place, double value);
char* put_number(char* place, std::int64_t value);

/// A number with the comma behind it, to be copied into many lines.
struct CellText {
  std::array<char, 31> characters;
  std::uint8_t size;
};

CellText cell_text(double value);

/// Copies the whole text, of any length, and returns the place behind its comma: a copy of
/// fixed size is two instructions, and what is behind the digits will be written over. There must
/// be room for sizeof(CellText) characters.
inline char* put_text(char* place, const CellText& text) {
  std::memcpy(place, &text, sizeof(text));
  return place + text.size;
}

/// The texts of an axis' values: each is formed once, unless the axis is so long that keeping the
/// texts would cost more memory than it saves time.
class AxisTexts {
 public:
  explicit AxisTexts(const GridAxis& axis);

  CellText at(std::size_t index) const {
    return index < texts_.size() ? texts_[index] : cell_text(axis_.at(index));
  }

 private:
  GridAxis axis_;
  std::vector<CellText> texts_;
};

}  // namespace holdfast::program
