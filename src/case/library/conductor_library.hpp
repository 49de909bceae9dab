#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// The wires of a conductor that have the same or a similar material.
struct LibraryWires {
  int count = 0;
  double stiffness = 0.0;  // sum of E A (N) over the wires, as if straight
  double expansion = 0.0;  // 1/K
};

/// A conductor of data/conductors.toml, which is compiled into the program; SI units.
struct LibraryConductor {
  std::string name, kind;  // "Drake", "ACSR"
  double mass_per_length, diameter, area, rated_strength, youngs_modulus, outer_wire_diameter,
      outer_wire_modulus;
  double minimum_bending_stiffness;  // N m2, each wire bending individually
  double layers;                     // number of layers of aluminium wires; infinity: not listed
  std::string source;
  LibraryWires outer, core;  // core: steel wires under aluminium; outer: all other wires
};

/// All conductors of the library, by kind and then by area.
const std::vector<LibraryConductor>& conductor_library();

/// The conductor with the given name, upper or lower case; null if there is none.
const LibraryConductor* find_conductor(std::string_view name);

/// Conductors with every word of the text in name, kind or source, in upper or lower case.
std::vector<const LibraryConductor*> conductors_with(std::string_view text);

/// The three names most similar to an unknown name: `"Drake", "Crane" or "Brahma"`.
std::string nearest_conductors(std::string_view name);

/// A key whose value conductor.name supplies if the key is not given.
struct LibraryKey {
  std::string_view name;  // "conductor.area"
  double LibraryConductor::*value;
};
const std::array<LibraryKey, 9>& library_keys();
bool is_library_key(std::string_view name);

}  // namespace holdfast::program
