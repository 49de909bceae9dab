#pragma once

#include <netcdf.h>

#include "output/grid/netcdf_library.hpp"
#include "support/testing.hpp"

// The library's function of that name.
#define HOLDFAST_NETCDF(function) program::netcdf_function<decltype(function)>(#function)

namespace holdfast::tests {

/// A variable of a netCDF file, read by the library that others read it with; without a name, the
/// file itself.
class NetcdfVariable {
 public:
  explicit NetcdfVariable(const std::filesystem::path& file, const std::string& name = "") {
    expect(HOLDFAST_NETCDF(nc_open)(file.c_str(), NC_NOWRITE, &file_));
    if (name.empty()) return;
    EXPECT_EQ(HOLDFAST_NETCDF(nc_inq_varid)(file_, name.c_str(), &number_), NC_NOERR) << name;
  }
  ~NetcdfVariable() { HOLDFAST_NETCDF(nc_close)(file_); }
  NetcdfVariable(const NetcdfVariable&) = delete;
  NetcdfVariable& operator=(const NetcdfVariable&) = delete;
  NetcdfVariable(NetcdfVariable&&) = delete;
  NetcdfVariable& operator=(NetcdfVariable&&) = delete;

  int format() const {
    int format = 0;
    expect(HOLDFAST_NETCDF(nc_inq_format)(file_, &format));
    return format;
  }

  int type() const {
    nc_type type = NC_NAT;
    expect(HOLDFAST_NETCDF(nc_inq_vartype)(file_, number_, &type));
    return type;
  }

  /// Names and lengths, the slowest first.
  std::vector<std::pair<std::string, std::size_t>> dimensions() const {
    int count = 0;
    std::array<int, NC_MAX_VAR_DIMS> numbers{};
    expect(HOLDFAST_NETCDF(nc_inq_varndims)(file_, number_, &count));
    expect(HOLDFAST_NETCDF(nc_inq_vardimid)(file_, number_, numbers.data()));
    std::vector<std::pair<std::string, std::size_t>> found;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      std::array<char, NC_MAX_NAME + 1> name{};
      std::size_t length = 0;
      expect(HOLDFAST_NETCDF(nc_inq_dim)(file_, numbers[i], name.data(), &length));
      found.emplace_back(name.data(), length);
    }
    return found;
  }

  bool has(const std::string& attribute) const {
    std::size_t length = 0;
    return HOLDFAST_NETCDF(nc_inq_attlen)(file_, number_, attribute.c_str(), &length) == NC_NOERR;
  }

  /// An attribute that is a text.
  std::string text(const std::string& name) const {
    std::string text(length_of(name), ' ');
    expect(HOLDFAST_NETCDF(nc_get_att_text)(file_, number_, name.c_str(), text.data()));
    return text;
  }

  /// One of numbers of any type.
  std::vector<double> numbers(const std::string& name) const {
    std::vector<double> found(length_of(name));
    expect(HOLDFAST_NETCDF(nc_get_att_double)(file_, number_, name.c_str(), found.data()));
    return found;
  }

  std::vector<std::size_t> chunk() const {
    int storage = 0;
    std::vector<std::size_t> shape(dimensions().size());
    expect(HOLDFAST_NETCDF(nc_inq_var_chunking)(file_, number_, &storage, shape.data()));
    EXPECT_EQ(storage, NC_CHUNKED);
    return shape;
  }

  bool is_compressed() const {
    int shuffle = 0, deflate = 0, level = 0;
    expect(HOLDFAST_NETCDF(nc_inq_var_deflate)(file_, number_, &shuffle, &deflate, &level));
    return deflate != 0;
  }

  /// Of a variable of any type; each of its numbers is a double.
  std::vector<double> values() const {
    std::size_t count = 1;
    for (const auto& dimension : dimensions()) count *= dimension.second;
    std::vector<double> found(count);
    expect(HOLDFAST_NETCDF(nc_get_var_double)(file_, number_, found.data()));
    return found;
  }

  /// Flags in words.
  std::vector<std::string> words() const {
    std::istringstream meanings(text("flag_meanings"));
    const std::vector<std::string> known{std::istream_iterator<std::string>(meanings), {}};
    std::vector<std::string> found;
    for (const double flag : values()) found.push_back(known.at(static_cast<std::size_t>(flag)));
    return found;
  }

 private:
  static void expect(int code) { EXPECT_EQ(code, NC_NOERR); }

  std::size_t length_of(const std::string& attribute) const {
    std::size_t length = 0;
    EXPECT_EQ(HOLDFAST_NETCDF(nc_inq_attlen)(file_, number_, attribute.c_str(), &length), NC_NOERR)
        << attribute;
    return length;
  }

  int file_ = 0;
  int number_ = NC_GLOBAL;
};

}  // namespace holdfast::tests
