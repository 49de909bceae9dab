#include "case/library/conductor_library.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>

#include "holdfast/core/types.hpp"
#include "text/compiled_texts.hpp"
#include "text/names.hpp"
#include "text/text.hpp"

namespace holdfast::program {

extern const std::string_view conductors_text;

namespace {

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return small;
}

/// Throws std::bad_alloc if memory is too short for the parser, which cannot report it itself.
void require_memory_to_parse() {
  constexpr std::size_t enough = 8U << 20U;
  const std::vector<char> memory(enough, ' ');
  if (*std::max_element(memory.begin(), memory.end()) != ' ') throw std::bad_alloc();
}

struct WireMaterial {
  std::string_view name;
  double modulus;    // Pa
  double expansion;  // 1/K; IEC 61597 and IEC 61232
  bool is_steel;
};
constexpr std::array<WireMaterial, 5> wire_materials = {{
    {" steel ", 200e9, 11.5e-6, true},
    {" aluminium ", 69e9, 23e-6, false},
    {" alloy 6201 ", 69e9, 23e-6, false},
    {" clad steel 20 % ", 162e9, 13e-6, true},
    {" clad steel 27 % ", 140e9, 13.4e-6, true},
}};

/// Wires from a text such as "7 steel 3.454 mm, 26 aluminium 4.442 mm", from the core outwards.
void add_wires(LibraryConductor& conductor, const std::string& text) {
  const bool has_aluminium = text.find(" a") != std::string::npos;
  for (const std::string_view part : split(text, ',')) {
    const std::string_view words = trimmed(part);
    const std::size_t blank = words.find(' ');
    for (const WireMaterial& material : wire_materials) {
      if (words.substr(blank, material.name.size()) != material.name) continue;
      const std::string_view size = words.substr(blank + material.name.size());
      const int count = static_cast<int>(parse_number(words.substr(0, blank)).value());
      const double diameter = 1e-3 * parse_number(size.substr(0, size.find(' '))).value();
      LibraryWires& wires = material.is_steel && has_aluminium ? conductor.core : conductor.outer;
      wires.count += count;
      wires.stiffness += count * material.modulus * 0.25 * pi<double> * diameter * diameter;
      wires.expansion = material.expansion;
    }
  }
}

std::vector<LibraryConductor> parsed_library() {
  require_memory_to_parse();
  std::vector<LibraryConductor> library;
  const toml::table parsed = toml::parse(conductors_text);
  for (const toml::node& node : *parsed["conductor"].as_array()) {
    const toml::table& one = *node.as_table();
    const auto number = [&](const char* key) { return one[key].value<double>().value(); };
    library.push_back({text_of(one["name"]),
                       text_of(one["kind"]),
                       number("mass_per_length"),
                       number("diameter"),
                       number("area"),
                       number("rated_strength"),
                       number("youngs_modulus"),
                       number("outer_wire_diameter"),
                       number("outer_wire_modulus"),
                       number("minimum_bending_stiffness"),
                       one["layers"].value_or(std::numeric_limits<double>::infinity()),
                       text_of(one["source"]),
                       {},
                       {}});
    add_wires(library.back(), text_of(one["wires"]));
  }
  return library;
}

bool holds_each(const std::string& text, const std::vector<std::string_view>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

const std::vector<LibraryConductor>& conductor_library() {
  static const std::vector<LibraryConductor> library = parsed_library();
  return library;
}

const LibraryConductor* find_conductor(std::string_view name) {
  const std::string wanted = in_small_letters(trimmed(name));
  if (wanted.empty()) return nullptr;
  for (const LibraryConductor& one : conductor_library())
    if (in_small_letters(one.name) == wanted) return &one;
  return nullptr;
}

std::vector<const LibraryConductor*> conductors_with(std::string_view text) {
  const std::string small = in_small_letters(text);
  const std::vector<std::string_view> words = split(small, ' ');
  std::vector<const LibraryConductor*> found;
  for (const LibraryConductor& one : conductor_library())
    if (holds_each(in_small_letters(one.name + '\n' + one.kind + '\n' + one.source), words))
      found.push_back(&one);
  return found;
}

std::string nearest_conductors(std::string_view name) {
  constexpr std::size_t longest = 40, count = 3;  // no name is longer
  const std::string wanted = in_small_letters(trimmed(name).substr(0, longest));
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const LibraryConductor& one : conductor_library()) {
    const std::string known = in_small_letters(one.name);
    const bool holds = known.find(wanted) != std::string::npos;
    ranked.emplace_back(holds ? 0 : edit_distance(wanted, known), one.name);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    text += k == 0 ? "" : k + 1 < count ? ", " : " or ";
    text += '"' + ranked[k].second + '"';
  }
  return text;
}

const std::array<LibraryKey, 9>& library_keys() {
  static constexpr std::array<LibraryKey, 9> keys = {{
      {"conductor.mass_per_length", &LibraryConductor::mass_per_length},
      {"conductor.area", &LibraryConductor::area},
      {"conductor.youngs_modulus", &LibraryConductor::youngs_modulus},
      {"conductor.bending_stiffness", &LibraryConductor::minimum_bending_stiffness},
      {"conductor.diameter", &LibraryConductor::diameter},
      {"conductor.rated_strength", &LibraryConductor::rated_strength},
      {"conductor.outer_wire_diameter", &LibraryConductor::outer_wire_diameter},
      {"conductor.outer_wire_modulus", &LibraryConductor::outer_wire_modulus},
      {"conductor.layers", &LibraryConductor::layers},
  }};
  return keys;
}

bool is_library_key(std::string_view name) { return find_named(library_keys(), name) != nullptr; }

}  // namespace holdfast::program
