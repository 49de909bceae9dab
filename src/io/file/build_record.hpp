#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A library that this program was built with.
struct Dependency {
  std::string name;
  std::string version;  ///< "3.4.0": the version at build time
  std::string licence;  ///< SPDX expression
};

/// Libraries that this program was built with, alphabetically; without missing optional ones.
std::vector<Dependency> dependencies();

/// Compiler, and AVX2 or AVX-512 if compiled for it: "GCC 12.2.0", "GCC 12.2.0, AVX2".
std::string compiler_text();

/// Text of `--version`: the version on the first line, then the compiler, the instruction set in
/// use with all sets available on this processor, and the libraries.
std::string version_text();

/// The software bill of materials, CycloneDX 1.5 as JSON. It has neither a date nor a serial
/// number: equal builds give equal texts.
std::string bill_of_materials();

}  // namespace holdfast::program
