#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/text/csv.hpp"

namespace holdfast::program {

/// Lines of a CSV table that are formed as text in place and handed over many at a time.
///
///     char* place = put_text(lines.place(), text);   // each cell with a comma behind it
///     lines.end_line(place);
///     lines.hand_over();                              // after the last
///
/// Throws what CsvWriter::rows_of_text() throws.
class CsvLines {
 public:
  /// @param writer  outlives this object
  /// @param longest_line  characters that a line may take, and those copied beyond its end
  CsvLines(CsvWriter& writer, std::size_t longest_line);

  /// Where the next line begins.
  char* place() { return buffer_.data() + used_; }

  /// @param end  behind the comma of the line's last cell
  void end_line(char* end) {
    end[-1] = '\r';  // in the place of the last comma
    *end++ = '\n';
    used_ = static_cast<std::size_t>(end - buffer_.data());
    ++lines_;
    if (used_ >= buffer_size_) hand_over();
  }

  void hand_over();

 private:
  static constexpr std::size_t buffer_size_ = std::size_t{1} << 18;

  CsvWriter& writer_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::uint64_t lines_ = 0;  // in the buffer
};

}  // namespace holdfast::program
