#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// Wires of a conductor that are of one material, or of alike ones.
struct LibraryWires {
  int count = 0;
  double stiffness = 0.0;  // sum of E A (N), each as a straight wire
  double expansion = 0.0;  // 1/K
};

/// A conductor of data/conductors.toml, which is compiled in; SI units.
struct LibraryConductor {
  std::string name, kind;  // "Drake", "ACSR"
  double mass_per_length, diameter, area, rated_strength, youngs_modulus, outer_wire_diameter,
      outer_wire_modulus;
  double minimum_bending_stiffness;  // each wire bends by itself
  double layers;                     // of aluminium wires; infinity: none
  std::string source;
  LibraryWires outer, core;  // a core of steel under aluminium; else all wires are outer ones
};

/// All of them, by kind and then by area.
const std::vector<LibraryConductor>& conductor_library();

/// The one of that name, in capitals or not; null where there is none.
const LibraryConductor* find_conductor(std::string_view name);

/// Conductors whose name, kind or source has every word of the text, in capitals or not.
std::vector<const LibraryConductor*> conductors_with(std::string_view text);

/// The three names most like one that is not known: `"Drake", "Crane" or "Brahma"`.
std::string nearest_conductors(std::string_view name);

/// A key that conductor.name stands for where nobody gives it.
struct LibraryKey {
  std::string_view name;  // "conductor.area"
  double LibraryConductor::*value;
};
const std::array<LibraryKey, 9>& library_keys();
bool is_library_key(std::string_view name);

}  // namespace holdfast::program
