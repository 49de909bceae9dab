#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/file/output.hpp"

namespace holdfast::program {

/// A netCDF-4 file that the C library writes into the temporary file of an OutputFile; there only
/// where the program is built with that library.
///
/// Described first, then begin_values(), then written, then close(). Without close() it is closed
/// unfinished when the object goes. Throws OutputError when a call of the library fails.
class NetcdfFile {
 public:
  /// The number by which the library knows a dimension or a variable.
  using Number = int;
  using Shape = std::vector<std::size_t>;

  /// @param output  is_file(), and outlives this object
  explicit NetcdfFile(const OutputFile& output);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  NetcdfFile(NetcdfFile&&) = delete;
  NetcdfFile& operator=(NetcdfFile&&) = delete;

  Number add_dimension(const std::string& name, std::size_t count);
  /// The variable of doubles that tells where along a dimension of that name the cells lie.
  Number add_coordinate(const std::string& name, Number dimension);
  /// A variable of doubles; where none is written there is no number.
  Number add_reals(const std::string& name, const std::vector<Number>& dimensions);
  /// A variable of integers of 64 bits.
  Number add_integers(const std::string& name, const std::vector<Number>& dimensions);
  /// A variable of bytes 0, 1, 2, …; the attributes say what each means.
  /// @param words  without blanks, at most most_flags
  Number add_flags(const std::string& name, const std::vector<Number>& dimensions,
                   const std::vector<std::string>& words);
  static constexpr std::size_t most_flags = 128;
  /// Compressed chunks of that shape; bytes are shuffled before.
  void set_chunks(Number variable, const Shape& shape);
  /// How many bytes of a variable's chunks the library keeps in memory, in place of its usual
  /// megabytes. A chunk that is larger is written at once.
  void set_cache(Number variable, std::size_t bytes);

  /// Of the file as a whole.
  void set_attribute(const std::string& name, const std::string& text);
  void set_attribute(Number variable, const std::string& name, const std::string& text);

  void begin_values();
  /// @param values  doubles, integers of 64 bits, or signed bytes for flags; the last dimension
  ///                fastest
  void write(Number variable, const Shape& start, const Shape& count, const void* values);

  /// All is with the system.
  void close();

 private:
  /// @param none  what stands where nothing is written; null where all is
  Number add_variable(const std::string& name, int type, const std::vector<Number>& dimensions,
                      const double* none = nullptr);
  void check(int status) const;

  std::string shown_;
  int id_ = 0;
  bool open_ = false;
};

/// A unit of the program's columns, `N.s/m`, as UDUNITS likes it: `N s m-1`; "1" for none.
std::string udunits(const std::string& unit);

}  // namespace holdfast::program
