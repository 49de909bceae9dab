#include "io/grid/netcdf_file.hpp"

#include <utility>

#include "io/text/filled.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>

#include "io/grid/netcdf_library.hpp"
#include "process/child.hpp"
#include "process/errors.hpp"
#include "process/system_words.hpp"

// The library's function of that name, which is not linked but loaded.
#define NETCDF(function) netcdf_function<decltype(function)>(#function)
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

static_assert(NetcdfFile::whole_file == NC_GLOBAL, "the library's number for all of a file");

constexpr int unknown_error = 255;

/// The system's last error number as an exit code.
int code_of_error() { return errno > 0 && errno < unknown_error ? errno : unknown_error; }

extern "C" void holdfast_on_crash(int) { _exit(code_of_error()); }

/// The library has one word for whatever the system says to HDF5; the system's own says more.
std::string words_for(int status, int error) {
  const bool machine = error == ENOSPC || error == EDQUOT || error == EIO || error == EFBIG;
  return machine ? system_words(error) : NETCDF(nc_strerror)(status);
}

int type_of(NetcdfFile::Type type) {
  if (type == NetcdfFile::Type::real) return NC_DOUBLE;
  return type == NetcdfFile::Type::integer ? NC_INT64 : NC_BYTE;
}

}  // namespace

NetcdfFile::NetcdfFile(const OutputFile& output) : shown_(output.target().string()) {
  if (!output.is_file())
    throw WrongInput("cannot write " + shown_ + ": netCDF needs a regular file");
  // Absolute, since a name with a colon could pass for a URL.
  path_ = std::filesystem::absolute(output.temporary()).string();
  check(NETCDF(nc_create)(path_.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
}

void NetcdfFile::check(int status) const {
  if (status == NC_NOERR) return;
  throw OutputError("cannot write " + shown_ + ": " + words_for(status, errno));
}

NetcdfFile::Number NetcdfFile::add_dimension(const std::string& name, std::size_t count) const {
  Number number = 0;
  check(NETCDF(nc_def_dim)(id_, cf_name(name).c_str(), count, &number));
  return number;
}

NetcdfFile::Number NetcdfFile::add_variable(const std::string& name, Type type,
                                            const std::vector<Number>& dimensions,
                                            bool may_miss) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Number number = 0;
  check(NETCDF(nc_def_var)(id_, cf_name(name).c_str(), type_of(type),
                           static_cast<int>(dimensions.size()), dimensions.data(), &number));
  check(NETCDF(nc_def_var_fill)(id_, number, may_miss ? NC_FILL : NC_NOFILL,
                                may_miss ? &none : nullptr));
  return number;
}

void NetcdfFile::set_chunks(Number variable, const Shape& chunk) const {
  constexpr int shuffle = 1, deflate = 1, level = 1;
  check(NETCDF(nc_def_var_chunking)(id_, variable, NC_CHUNKED, chunk.data()));
  check(NETCDF(nc_def_var_deflate)(id_, variable, shuffle, deflate, level));
  // With any preference for whole chunks HDF5 never lets go of those that stick out of the grid.
  constexpr float preference_for_whole_chunks = 0.0F;
  constexpr std::size_t slots = 101;
  const std::size_t values =
      std::accumulate(chunk.begin(), chunk.end(), std::size_t{1}, std::multiplies<>());
  check(NETCDF(nc_set_var_chunk_cache)(id_, variable, values * sizeof(double), slots,
                                       preference_for_whole_chunks));
}

void NetcdfFile::set_attribute(Number variable, const char* name, const std::string& text) const {
  check(NETCDF(nc_put_att_text)(id_, variable, name, text.size(), text.data()));
}

void NetcdfFile::set_attribute(Number variable, const char* name,
                               const std::vector<signed char>& bytes) const {
  check(NETCDF(nc_put_att_schar)(id_, variable, name, NC_BYTE, bytes.size(), bytes.data()));
}

void NetcdfFile::begin_values() const { check(NETCDF(nc_enddef)(id_)); }

void NetcdfFile::write(Number variable, const Shape& start, const Shape& count,
                       const void* values) const {
  check(NETCDF(nc_put_vara)(id_, variable, start.data(), count.data(), values));
}

bool NetcdfFile::close_and_read(const std::vector<Number>& variables, const Shape& last) const {
  int again = 0, found = 0;
  bool good = NETCDF(nc_close)(id_) == NC_NOERR &&
              NETCDF(nc_open)(path_.c_str(), NC_NOWRITE, &again) == NC_NOERR &&
              NETCDF(nc_inq_nvars)(again, &found) == NC_NOERR;
  for (const Number variable : variables) {
    double value = 0.0;
    good = good && variable < found &&
           NETCDF(nc_get_var1_double)(again, variable, last.data(), &value) == NC_NOERR;
  }
  return good;
}

void NetcdfFile::finish(const std::vector<Number>& variables, const Shape& last) const {
  check(NETCDF(nc_sync)(id_));
  const int code = run_in_child([&] {
    for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT}) std::signal(fatal, holdfast_on_crash);
    errno = 0;
    return close_and_read(variables, last) ? 0 : code_of_error();
  });
  if (code == 0) return;
  const bool said = code > 0 && code != unknown_error;
  throw OutputError("cannot write " + shown_ + ": " +
                    (said ? system_words(code) : "the netCDF library could not finish it"));
}

#endif

}  // namespace holdfast::program
