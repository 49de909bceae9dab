#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.hpp"

namespace holdfast::program {

/// Requests large memory pages from the system for memory that is to be written: the first access
/// to many small pages takes as long as a fast kernel. Without effect if the system has no large
/// pages, or the memory is small.
void prefer_large_pages(void* memory, std::size_t bytes);

/// A column of a table in memory. By the datatype its cells are
///  - numbers (datatype "double"),
///  - whole numbers (datatype "integer" or "boolean"), or
///  - words (datatype "string"), each stored once: a cell is the index of its word.
class ReceivedColumn {
 public:
  enum class Kind { numbers, whole_numbers, words };

  explicit ReceivedColumn(Column about);

  /// Reserves memory for `rows` rows.
  void reserve(std::size_t rows);

  const Column& about() const { return about_; }
  Kind kind() const { return kind_; }
  std::size_t rows() const { return kind_ == Kind::numbers ? numbers_.size() : whole_.size(); }

  /// Appends a number; zero loses its sign.
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
  /// Appends a text; in a column of numbers "" is NaN, and other text throws std::logic_error.
  void put(std::string_view text);

  /// Sets the words of a column whose cells are appended as indices, as in a grid.
  void set_words(std::vector<std::string> words) { words_ = std::move(words); }

  std::vector<double>& numbers() { return numbers_; }
  /// The cells as whole numbers, or as indices of words.
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

/// The table of a job in memory, instead of CSV.
struct ReceivedTable {
  std::vector<ReceivedAxis> axes;  // axes of a grid, the first slowest; else none
  std::vector<ReceivedColumn> columns;
  std::string origin;  // JSON: version, job, options, case and, where few, the trusted digits
};

}  // namespace holdfast::program
