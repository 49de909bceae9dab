#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/core/log_axis.hpp"
#include "text/column.hpp"

namespace holdfast::program {

struct CaseKey;

/// MIN:MAX, finite, min <= max.
struct Range {
  double min = 0.0;
  double max = 0.0;
};

/// KEY=MIN:MAX:COUNT.
struct KeyAxis {
  std::string key;
  Axis axis;
};

/// KEY=MIN:MAX:COUNT, KEY=log:MIN:MAX:COUNT or KEY=VALUE,VALUE,….
struct KeyValues {
  std::string key;
  std::variant<Axis, LogAxis, std::vector<double>> values;
};

/// TIME:DISPLACEMENT of a kick, s and m; time >= 0.
struct KickOption {
  double time = 0.0;
  double displacement = 0.0;
};

/// Z1MIN:Z1MAX:V1MIN:V1MAX, m and m/s, min < max in both.
struct WindowOption {
  Range displacement;
  Range velocity;
};

/// Each reads the text given to an option (`--force`); throws WrongInput, one line that names the
/// option, the text and the form expected.
Range parse_range(std::string_view option, std::string_view text);
/// MIN:MAX:COUNT, 1 <= count <= 1e9, a count of 1 being min alone; or one number.
Axis parse_axis(std::string_view option, std::string_view text);
KeyAxis parse_key_axis(std::string_view option, std::string_view text);
/// A list has at least one number; `log:` wants 0 < MIN.
KeyValues parse_key_values(std::string_view option, std::string_view text);
KickOption parse_kick(std::string_view option, std::string_view text);
WindowOption parse_window(std::string_view option, std::string_view text);

/// Numbers between commas, `10,100,1000`; at least one, finite.
std::vector<double> parse_list(std::string_view option, std::string_view text);

/// An axis of a chart or a sweep.
struct GridAxis {
  Column column;
  std::variant<Axis, LogAxis, std::vector<double>> values;

  std::size_t count() const;
  /// Value number `index`, 0 ≤ index < count().
  double at(std::size_t index) const;
};

/// The index along one axis of a cell of their product, cells being numbered with the first axis
/// slowest.
std::size_t index_along(const std::vector<GridAxis>& axes, std::size_t axis, std::size_t cell);

/// An axis over a key of the case, as a table names and describes it; units as N.s/m.
GridAxis grid_axis(const CaseKey& key, const KeyValues& axis);
GridAxis grid_axis(const KeyAxis& axis);

}  // namespace holdfast::program
