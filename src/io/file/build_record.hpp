#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A library that this program was built with.
struct Dependency {
  std::string name;
  std::string version;  ///< "3.4.0"; of what is loaded when the program runs, that it was built for
  std::string licence;  ///< SPDX expression
};

/// Packages that this program was built with, in alphabetical order; what an optional package would
/// have added is left out where it was missing.
std::vector<Dependency> dependencies();

/// Compiler and instruction set, "GCC 12.2.0, x86-64".
std::string compiler_text();

/// Text of `--version`: the version on the first line, then the compiler, the instruction set that
/// is taken on this processor with those that could be, and the dependencies.
std::string version_text();

/// The software bill of materials: CycloneDX 1.5 as JSON. The same for the same build: it has
/// neither a date nor a serial number.
std::string bill_of_materials();

}  // namespace holdfast::program
