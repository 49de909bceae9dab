#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.hpp"

namespace holdfast::program {

/// Asks the system to back memory that is about to be written by large pages, of which there are
/// few to be had one after the other: the first touch of megabytes costs as much as a fast kernel
/// does. Without effect where there are none, or the memory is small.
void prefer_large_pages(void* memory, std::size_t bytes);

/// A column of a table in memory. By what the job puts into it, it holds
///  - numbers (datatype "double"),
///  - whole numbers (datatype "integer" or "boolean"), or
///  - words (datatype "string"), each kept once: a cell is the number of its word.
class ReceivedColumn {
 public:
  enum class Kind { numbers, whole_numbers, words };

  explicit ReceivedColumn(Column about);

  /// Asks for the memory of so many rows at once.
  void reserve(std::size_t rows);

  const Column& about() const { return about_; }
  Kind kind() const { return kind_; }
  std::size_t rows() const { return kind_ == Kind::numbers ? numbers_.size() : whole_.size(); }

  /// 0 without a sign.
  void put(double value) {
    if (kind_ == Kind::numbers)
      numbers_.push_back(value + 0.0);
    else
      put_into_others(value);
  }
  void put(std::int64_t value) {
    if (kind_ == Kind::whole_numbers)
      whole_.push_back(value);
    else
      put(static_cast<double>(value));
  }
  /// Where the column is one of numbers: an empty text is NaN there, and any other an error.
  void put(std::string_view text);

  /// Words of cells that are given by them, as those of a grid are.
  void set_words(std::vector<std::string> words) { words_ = std::move(words); }

  std::vector<double>& numbers() { return numbers_; }
  /// Whole numbers, or those of the words.
  std::vector<std::int64_t>& whole_numbers() { return whole_; }
  const std::vector<std::string>& words() const { return words_; }

 private:
  void put_into_others(double value);

  Column about_;
  Kind kind_;
  std::vector<double> numbers_;
  std::vector<std::int64_t> whole_;
  std::vector<std::string> words_;
};

/// An axis of a table over a grid.
struct ReceivedAxis {
  Column about;
  std::vector<double> values;
};

/// The table of a job in memory, in place of its text.
struct ReceivedTable {
  std::vector<ReceivedAxis> axes;  // of a grid, the first slowest; else none
  std::vector<ReceivedColumn> columns;
  std::string origin;  // JSON: version, job, options, case and, where few, the trusted digits
};

}  // namespace holdfast::program
