#include "io/text/csv_lines.hpp"

#include <string_view>

namespace holdfast::program {

CsvLines::CsvLines(CsvWriter& writer, std::size_t longest_line)
    : writer_(writer), buffer_(buffer_size_ + longest_line) {}

void CsvLines::hand_over() {
  writer_.rows_of_text(std::string_view(buffer_.data(), used_), lines_);
  used_ = 0;
  lines_ = 0;
}

}  // namespace holdfast::program
