#include "case/toml_values.hpp"

#include <algorithm>

namespace holdfast::program {
namespace {

constexpr int most_levels = 16;

/// Scans a TOML text and counts the nesting levels of brackets and keys.
class LevelScanner {
 public:
  explicit LevelScanner(std::string_view text) : text_(text) {}

  std::optional<TomlExcess> excess() {
    while (at_ < text_.size()) {
      step();
      if (brackets_ > most_levels) return found("brackets are");
      if (parts_ > most_levels) return found("a key is");
    }
    return std::nullopt;
  }

 private:
  TomlExcess found(const std::string& what) const {
    return {line_, what + " nested deeper than " + std::to_string(most_levels) + " levels"};
  }

  void step() {
    switch (text_[at_]) {
      case '"':
      case '\'':
        return pass_string();
      case '#':
        at_ = std::min(text_.find('\n', at_), text_.size());
        return;
      case '.':
        ++parts_;
        break;
      case '[':
      case '{':
        ++brackets_;
        parts_ = 1;
        break;
      case ']':
      case '}':
        brackets_ = std::max(0, brackets_ - 1);
        parts_ = 1;
        break;
      case '\n':
        ++line_;
        parts_ = 1;
        break;
      case '=':
      case ',':
        parts_ = 1;
        break;
      default:
        break;
    }
    ++at_;
  }

  /// Skips a string. An unclosed one ends with the line; a multi-line one may end in five quotes.
  void pass_string() {
    const char quote = text_[at_];
    const std::string three(3, quote);
    const bool over_lines = text_.substr(at_, 3) == three;
    at_ += over_lines ? 3 : 1;
    const auto ends = [&] {
      return over_lines ? text_.substr(at_, 3) == three : text_[at_] == quote || text_[at_] == '\n';
    };
    while (at_ < text_.size() && !ends()) {
      if (quote == '"' && text_[at_] == '\\') ++at_;
      if (at_ < text_.size() && text_[at_] == '\n') ++line_;
      ++at_;
    }
    at_ = std::min(at_, text_.size());
    if (!over_lines) {
      if (at_ < text_.size() && text_[at_] == quote) ++at_;
      return;
    }
    at_ = std::min(at_ + 3, text_.size());
    for (int own = 0; own < 2 && at_ < text_.size() && text_[at_] == quote; ++own) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  int brackets_ = 0;
  int parts_ = 1;  // of the current key: 2 for a.b
};

}  // namespace

std::optional<TomlExcess> toml_excess(std::string_view text) { return LevelScanner(text).excess(); }

}  // namespace holdfast::program
