#include "sweep/tiles/tile_plan_file.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "io/text/checksum.hpp"
#include "io/text/text.hpp"

namespace holdfast::program {
namespace {

using Entries = decltype(TilePlan::entries);

constexpr std::string_view first_line = "holdfast tiles, format 1\n";
constexpr std::string_view tiles_ending = " tiles\n";
constexpr std::string_view equals = " = ";
constexpr std::string_view checksum_word = "checksum ";

/// The text on one line, with one more character that does not stand for itself.
std::string escaped(std::string_view text, char special) {
  std::string line;
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    const bool plain = code >= 0x20 && code != 0x7F && character != '\\' && character != special;
    line += plain ? std::string(1, character) : "\\x" + hexadecimal(code, 2);
  }
  return line;
}

std::string escaped_name(std::string_view name) { return escaped(name, '='); }
std::string escaped_text(std::string_view text) { return escaped(text, '\\'); }

/// The reverse of escaped(). Whether the line was written so is left to a comparison.
std::string unescaped(std::string_view line) {
  constexpr std::size_t length = 4;  // of \x5c
  std::string text;
  while (!line.empty()) {
    int code = 0;
    const bool escape = line.front() == '\\' && line.size() >= length;
    if (escape) std::from_chars(line.data() + 2, line.data() + length, code, 16);
    text += escape ? static_cast<char>(static_cast<unsigned char>(code)) : line.front();
    line.remove_prefix(escape ? length : 1);
  }
  return text;
}

std::string text_before_checksum(const TilePlan& plan) {
  std::string text = std::string(first_line) + std::to_string(plan.tiles);
  text += tiles_ending;
  for (const auto& [name, value] : plan.entries) {
    text += escaped_name(name);
    text += equals;
    text += escaped_text(value) + "\n";
  }
  return text;
}

/// The lines as a plan, whatever they are; nothing where a line or the number of tiles is none.
std::optional<TilePlan> read_lines(std::string_view text) {
  if (!begins_as_tile_plan(text)) return std::nullopt;
  std::vector<std::string_view> lines = split(text.substr(first_line.size()), '\n');
  if (lines.size() < 3) return std::nullopt;  // tiles, checksum, and what follows the last end
  TilePlan plan;
  const std::string_view tiles = lines.front();
  const auto number = std::from_chars(tiles.data(), tiles.data() + tiles.size(), plan.tiles);
  if (number.ec != std::errc()) return std::nullopt;
  for (std::size_t i = 1; i + 2 < lines.size(); ++i) {
    const std::size_t end = lines[i].find(equals);
    if (end == std::string_view::npos) return std::nullopt;
    plan.entries.emplace(unescaped(lines[i].substr(0, end)),
                         unescaped(lines[i].substr(end + equals.size())));
  }
  return plan;
}

/// The text of that name in the words of a message.
std::string shown(const Entries& entries, const std::string& name) {
  const auto entry = entries.find(name);
  if (entry == entries.end()) return "not given";
  return entry->second.empty() ? "empty" : escaped_text(entry->second);
}

}  // namespace

std::uint64_t tile_plan_identity(const TilePlan& plan) {
  return checksum(text_before_checksum(plan));
}

std::string tile_plan_text(const TilePlan& plan) {
  const std::string text = text_before_checksum(plan);
  return text + std::string(checksum_word) + hexadecimal(checksum(text), 16) + "\n";
}

bool begins_as_tile_plan(std::string_view text) {
  return text.substr(0, first_line.size()) == first_line;
}

std::optional<TilePlan> parse_tile_plan(std::string_view text) {
  std::optional<TilePlan> plan = read_lines(text);
  // Every plan has one text, so that whatever is wrong with this one shows here.
  if (!plan || tile_plan_text(*plan) != text) return std::nullopt;
  return plan;
}

std::string tile_plan_differences(const TilePlan& before, const TilePlan& now) {
  Entries all = before.entries;
  all.insert(now.entries.begin(), now.entries.end());
  std::string differences;
  const auto add = [&](const std::string& name, const std::string& was, const std::string& is) {
    differences += (differences.empty() ? "" : "; ") + name + " was " + was + ", is " + is;
  };
  for (const auto& entry : all) {
    const std::string& name = entry.first;
    const auto was = before.entries.find(name), is = now.entries.find(name);
    const bool in_both = was != before.entries.end() && is != now.entries.end();
    if (in_both && was->second == is->second) continue;
    add(escaped_text(name), shown(before.entries, name), shown(now.entries, name));
  }
  if (before.tiles != now.tiles) {
    add("the number of tiles", std::to_string(before.tiles), std::to_string(now.tiles));
  }
  return differences;
}

}  // namespace holdfast::program
