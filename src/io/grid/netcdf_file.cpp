#include "io/grid/netcdf_file.hpp"

#include <algorithm>
#include <string_view>

#include "io/text/text.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf.h>

#include <cerrno>
#include <limits>
#include <numeric>
#include <system_error>

#include "io/grid/netcdf_library.hpp"
#include "process/errors.hpp"

// The library's function of that name, which is not linked but loaded.
#define NETCDF(function) netcdf_function<decltype(function)>(#function)
#endif

namespace holdfast::program {

std::string udunits(const std::string& unit) {
  std::string text;
  bool divided = false;
  for (const std::string_view quotient : split(unit, '/')) {
    for (const std::string_view factor : split(quotient, '.')) {
      if (factor.empty() || factor == "1") continue;
      const bool has_power = factor.find_first_of("0123456789") != std::string_view::npos;
      const std::size_t letters = std::min(factor.find_first_of("0123456789"), factor.size());
      text += (text.empty() ? "" : " ") + std::string(factor.substr(0, letters));
      if (divided) text += '-';
      if (has_power) text += factor.substr(letters);
      if (divided && !has_power) text += '1';
    }
    divided = true;
  }
  return text.empty() ? "1" : text;
}

#ifdef HOLDFAST_HAS_NETCDF

namespace {

/// The library has one word for whatever the system says to HDF5; the system's own says more.
std::string words_for(int status, int error) {
  const bool machine = error == ENOSPC || error == EDQUOT || error == EIO || error == EFBIG;
  if (machine) return std::generic_category().message(error);
  return NETCDF(nc_strerror)(status);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

NetcdfFile::NetcdfFile(const OutputFile& output) : shown_(output.target().string()) {
  // Absolute, since a name with a colon could pass for a URL.
  const std::string path = std::filesystem::absolute(output.temporary()).string();
  check(NETCDF(nc_create)(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
  open_ = true;
}

NetcdfFile::~NetcdfFile() {
  if (open_) NETCDF(nc_close)(id_);
}

void NetcdfFile::check(int status) const {
  if (status == NC_NOERR) return;
  throw OutputError("cannot write " + shown_ + ": " + words_for(status, errno));
}

NetcdfFile::Number NetcdfFile::add_dimension(const std::string& name, std::size_t count) {
  Number number = 0;
  check(NETCDF(nc_def_dim)(id_, name.c_str(), count, &number));
  return number;
}

NetcdfFile::Number NetcdfFile::add_variable(const std::string& name, int type,
                                            const std::vector<Number>& dimensions,
                                            const double* none) {
  Number number = 0;
  check(NETCDF(nc_def_var)(id_, name.c_str(), type, static_cast<int>(dimensions.size()),
                           dimensions.data(), &number));
  check(NETCDF(nc_def_var_fill)(id_, number, none != nullptr ? NC_FILL : NC_NOFILL, none));
  return number;
}

NetcdfFile::Number NetcdfFile::add_coordinate(const std::string& name, Number dimension) {
  return add_variable(name, NC_DOUBLE, {dimension});  // misses no value (CF 2.5.1)
}

NetcdfFile::Number NetcdfFile::add_reals(const std::string& name,
                                         const std::vector<Number>& dimensions) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  return add_variable(name, NC_DOUBLE, dimensions, &none);
}

NetcdfFile::Number NetcdfFile::add_integers(const std::string& name,
                                            const std::vector<Number>& dimensions) {
  return add_variable(name, NC_INT64, dimensions);
}

NetcdfFile::Number NetcdfFile::add_flags(const std::string& name,
                                         const std::vector<Number>& dimensions,
                                         const std::vector<std::string>& words) {
  const Number number = add_variable(name, NC_BYTE, dimensions);
  std::vector<signed char> values(words.size());
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  check(
      NETCDF(nc_put_att_schar)(id_, number, "flag_values", NC_BYTE, values.size(), values.data()));
  set_attribute(number, "flag_meanings", joined(words));
  return number;
}

void NetcdfFile::set_chunks(Number variable, const Shape& shape) {
  constexpr int shuffle = 1, deflate = 1, level = 1;
  check(NETCDF(nc_def_var_chunking)(id_, variable, NC_CHUNKED, shape.data()));
  check(NETCDF(nc_def_var_deflate)(id_, variable, shuffle, deflate, level));
}

void NetcdfFile::set_cache(Number variable, std::size_t bytes) {
  constexpr std::size_t slots = 101;
  // With any preference for whole chunks HDF5 never lets go of those that stick out of the grid.
  constexpr float preference_for_whole_chunks = 0.0F;
  check(NETCDF(nc_set_var_chunk_cache)(id_, variable, bytes, slots, preference_for_whole_chunks));
}

void NetcdfFile::set_attribute(const std::string& name, const std::string& text) {
  set_attribute(NC_GLOBAL, name, text);
}

void NetcdfFile::set_attribute(Number variable, const std::string& name, const std::string& text) {
  check(NETCDF(nc_put_att_text)(id_, variable, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::begin_values() { check(NETCDF(nc_enddef)(id_)); }

void NetcdfFile::write(Number variable, const Shape& start, const Shape& count,
                       const void* values) {
  check(NETCDF(nc_put_vara)(id_, variable, start.data(), count.data(), values));
}

void NetcdfFile::close() {
  open_ = false;
  check(NETCDF(nc_close)(id_));
}

#endif

}  // namespace holdfast::program
