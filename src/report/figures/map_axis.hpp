#pragma once

#include <string>

#include "io/text/filled.hpp"

namespace holdfast::program {

/// A key of the case along an axis of a map, and how the picture shows it.
struct MapAxis {
  std::string key;
  double min, max;  // in the key's unit, min < max
  bool logarithmic;
  std::string label;
  double scale;  // the picture shows scale times the key's value
};

/// gnuplot's expression for what the picture's axis shows of a value, itself an expression.
std::string shown_on(const MapAxis& axis, const std::string& value);

/// What the texts leave open of an axis: "x axis" of a sweep with 61 values, "x label", "x range",
/// "x tics" and, as "x", the expression for what it shows of a column.
Values values_of(const std::string& letter, const MapAxis& axis, const std::string& column);

/// What an axis calls a key of the case, with the unit in which it shows it: "sampling period τ
/// (ms)"; of another word, that word.
std::string label_of(const std::string& key);

/// So many times an axis of that label shows the key's value.
double scale_of(const std::string& key);

}  // namespace holdfast::program
