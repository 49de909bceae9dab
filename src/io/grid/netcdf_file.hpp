#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/file/output.hpp"
#include "io/grid/grid_attributes.hpp"

namespace holdfast::program {

/// A netCDF-4 file while it is written into the temporary file of an OutputFile: dimensions,
/// variables and attributes first, values behind begin_values(). Names are such as CF wants them
/// (2.3): a dot becomes an underscore.
///
/// Throws NoAnswer where the library is missing, WrongInput where the output is no named file,
/// OutputError in the system's or the library's words where a call fails.
class NetcdfFile {
 public:
  using Shape = std::vector<std::size_t>;
  /// By which the library knows a dimension or a variable.
  using Number = int;
  enum class Type { real, integer, byte };  ///< doubles, 64 bits, 8 bits
  static constexpr Number whole_file = -1;  ///< for attributes

  explicit NetcdfFile(const OutputFile& output);

  Number add_dimension(const std::string& name, std::size_t count) const;

  /// @param may_miss  its values are NaN where nothing is written
  Number add_variable(const std::string& name, Type type, const std::vector<Number>& dimensions,
                      bool may_miss) const;

  /// Compressed chunks of that shape; bytes are shuffled before. Cells come in order: the chunk at
  /// hand is all that is kept in memory, in place of the library's usual megabytes.
  void set_chunks(Number variable, const Shape& chunk) const;

  void set_attribute(Number variable, const char* name, const std::string& text) const;
  void set_attribute(Number variable, const char* name,
                     const std::vector<signed char>& bytes) const;

  void begin_values() const;

  /// @param values  of the variable's type, the last dimension fastest
  void write(Number variable, const Shape& start, const Shape& count, const void* values) const;

  /// Hands all to the system, closes the file and reads the end of some variables again. The
  /// library crashes while it closes a file that it cannot write, hence a copy of this process
  /// closes it; to this one the file stays open, as it does where finish() is not called.
  /// @param last  indices of the last value of each of the variables
  void finish(const std::vector<Number>& variables, const Shape& last) const;

 private:
  void check(int status) const;
  bool close_and_read(const std::vector<Number>& variables, const Shape& last) const;

  std::string shown_, path_;
  int id_ = 0;
};

}  // namespace holdfast::program
