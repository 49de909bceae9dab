#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/core/log_axis.hpp"
#include "text/column.hpp"

namespace holdfast::program {

struct CaseKey;

/// A range, given as MIN:MAX; both finite, min <= max.
struct Range {
  double min = 0.0;
  double max = 0.0;
};

/// An axis over a key, given as KEY=MIN:MAX:COUNT.
struct KeyAxis {
  std::string key;
  Axis axis;
};

/// A grid over two keys; the first key varies slowest.
struct KeyGrid {
  KeyAxis slow, fast;
};

/// Values of a key, given as KEY=MIN:MAX:COUNT, KEY=log:MIN:MAX:COUNT or KEY=VALUE,VALUE,….
struct KeyValues {
  std::string key;
  std::variant<Axis, LogAxis, std::vector<double>> values;
};

/// Time (s, >= 0) and displacement (m) of a kick, given as TIME:DISPLACEMENT.
struct KickOption {
  double time = 0.0;
  double displacement = 0.0;
};

/// Ranges of displacement (m) and velocity (m/s), given as Z1MIN:Z1MAX:V1MIN:V1MAX; min < max.
struct WindowOption {
  Range displacement;
  Range velocity;
};

/// Parses MIN:MAX. `option` is the option's name (`--force`), `text` its value. All parse functions
/// of this header throw WrongInput, one line with the option, the text and the expected form.
Range parse_range(std::string_view option, std::string_view text);
/// Parses MIN:MAX:COUNT, 1 <= COUNT <= 1e9 (1: MIN alone), or one number.
Axis parse_axis(std::string_view option, std::string_view text);
KeyAxis parse_key_axis(std::string_view option, std::string_view text);
/// Checks that an option has two texts KEY=… with different keys. @param example  two such texts
void require_two_keys(const std::string& option, const std::vector<std::string>& texts,
                      const std::string& example);
/// Grid over two keys from two texts KEY=…, each parsed by `parse`; at most `most` cells.
KeyGrid key_grid(const std::string& option, const std::vector<std::string>& texts,
                 const std::string& example, std::int64_t most,
                 const std::function<KeyAxis(const std::string&)>& parse);
/// Parses a form of KeyValues. A list has at least one number; `log:` requires 0 < MIN.
KeyValues parse_key_values(std::string_view option, std::string_view text);
KickOption parse_kick(std::string_view option, std::string_view text);
WindowOption parse_window(std::string_view option, std::string_view text);

/// Parses finite numbers separated by commas, `10,100,1000`; at least one.
std::vector<double> parse_list(std::string_view option, std::string_view text);

/// An axis of a chart or a sweep.
struct GridAxis {
  Column column;
  std::variant<Axis, LogAxis, std::vector<double>> values;

  std::size_t count() const;
  /// Value number `index`, 0 ≤ index < count().
  double at(std::size_t index) const;
};

/// Index of a grid cell along one axis; cells are numbered with the first axis slowest.
std::size_t index_along(const std::vector<GridAxis>& axes, std::size_t axis, std::size_t cell);

/// An axis over a key of the case, with its column in a table; units are written as N.s/m.
GridAxis grid_axis(const CaseKey& key, const KeyValues& axis);
GridAxis grid_axis(const KeyAxis& axis);

}  // namespace holdfast::program
