#include "host/received_table.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace holdfast::program {
namespace {

ReceivedColumn::Kind kind_of(const Column& column) {
  if (column.datatype == "double") return ReceivedColumn::Kind::numbers;
  return column.datatype == "string" ? ReceivedColumn::Kind::words
                                     : ReceivedColumn::Kind::whole_numbers;
}

}  // namespace

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t large = std::uintptr_t{1} << 21;
  const auto first = (reinterpret_cast<std::uintptr_t>(memory) + large - 1) / large * large;
  const auto last = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / large * large;
  // Only advice to the system: a refusal is no error.
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

ReceivedColumn::ReceivedColumn(Column about) : about_(std::move(about)), kind_(kind_of(about_)) {}

void ReceivedColumn::reserve(std::size_t rows) {
  if (kind_ == Kind::numbers) {
    numbers_.reserve(rows);
    prefer_large_pages(numbers_.data(), rows * sizeof(double));
  } else {
    whole_.reserve(rows);
    prefer_large_pages(whole_.data(), rows * sizeof(std::int64_t));
  }
}

void ReceivedColumn::put(std::string_view text) {
  if (kind_ != Kind::words) {
    if (!text.empty()) throw std::logic_error("a text in the column of numbers " + about_.name);
    return put(std::numeric_limits<double>::quiet_NaN());
  }
  // Few words, and often that of the previous row.
  std::size_t number = whole_.empty() ? 0 : static_cast<std::size_t>(whole_.back());
  if (number >= words_.size() || words_[number] != text) {
    number = 0;
    while (number < words_.size() && words_[number] != text) ++number;
    if (number == words_.size()) words_.emplace_back(text);
  }
  whole_.push_back(static_cast<std::int64_t>(number));
}

void ReceivedColumn::put_into_others(double value) {
  const bool whole = value == std::trunc(value) && std::abs(value) < 9.2e18;
  if (kind_ == Kind::words) {
    if (!whole) throw std::logic_error("a number in the column of words " + about_.name);
    whole_.push_back(static_cast<std::int64_t>(value));
    return;
  }
  if (whole) {
    whole_.push_back(static_cast<std::int64_t>(value));
    return;
  }
  // A number that is not whole, as NaN for "none", turns the column into one of numbers.
  numbers_.assign(whole_.begin(), whole_.end());
  whole_.clear();
  kind_ = Kind::numbers;
  numbers_.push_back(value);
}

}  // namespace holdfast::program
