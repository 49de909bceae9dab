#pragma once

#include <string>

namespace holdfast::program {

/// The label of an axis as plain text, without gnuplot's marks of fonts, indices and blanks that do
/// not break: "displacement {/:Italic z}_1 (mm)" is "displacement z₁ (mm)".
std::string plain_label(const std::string& label);

}  // namespace holdfast::program
