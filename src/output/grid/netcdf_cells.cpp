#include "output/grid/cell_writer.hpp"
#include "output/grid/netcdf_library.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <limits>
#include <numeric>

#include "io/file/output.hpp"
#include "output/grid/chunk_grid.hpp"
#include "output/grid/grid_attributes.hpp"
#include "process/child.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

// Address of a function of the netCDF library, which is loaded at run time and not linked.
#define NETCDF(function) netcdf_function<decltype(function)>(#function)
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Shape = std::vector<std::size_t>;

constexpr int unknown_error = 255;

/// The system's last error number as an exit code.
int code_of_error() { return errno > 0 && errno < unknown_error ? errno : unknown_error; }

extern "C" void holdfast_on_crash(int) { _exit(code_of_error()); }

/// Error message: the system's for a fault of the machine, which is more precise, or the library's.
std::string words_for(int status, int error) {
  const bool machine = error == ENOSPC || error == EDQUOT || error == EIO || error == EFBIG;
  return machine ? system_words(error) : NETCDF(nc_strerror)(status);
}

int type_of(const CellColumn& column) {
  if (!column.words.empty()) return NC_BYTE;
  return column.column.datatype == "integer" ? NC_INT64 : NC_DOUBLE;
}

ChunkGrid chunks_of(const GridLayout& layout) {
  ChunkGrid grid;
  for (const GridAxis& axis : layout.axes) grid.shape.push_back(axis.count());
  grid.chunk = chunk_shape(grid.shape, values_in_chunk);
  return grid;
}

/// Writer of a netCDF file with a temporary name: first its dimensions and attributes, then values.
class NetcdfCells final : public CellWriter {
 public:
  NetcdfCells(const JobContext& context, const GridLayout& layout)
      : output_(context.output),
        shown_(output_.target().string()),
        grid_(chunks_of(layout)),
        waiting_(grid_, layout.columns.size()) {
    if (!output_.is_file())
      throw WrongInput("cannot write " + shown_ +
                       ": netCDF needs a regular file; give another name");
    // Absolute, since a name with a colon could pass for a URL.
    path_ = std::filesystem::absolute(output_.temporary()).string();
    check(NETCDF(nc_create)(path_.c_str(), NC_NETCDF4 | NC_CLOBBER, &file_));
    describe(NC_GLOBAL, origin_attributes(context));
    std::vector<int> dimensions, coordinates;
    for (const GridAxis& axis : layout.axes)
      check(NETCDF(nc_def_dim)(file_, cf_name(axis.column.name).c_str(), axis.count(),
                               &dimensions.emplace_back()));
    for (const GridAxis& axis : layout.axes) {
      // A coordinate has no missing values (CF 2.5.1).
      coordinates.push_back(
          add_variable(axis.column, NC_DOUBLE, {dimensions[coordinates.size()]}, false));
      describe(coordinates.back(), axis_attributes(axis.column));
    }
    for (const CellColumn& column : layout.columns) add_column(column, dimensions);
    check(NETCDF(nc_enddef)(file_));
    for (std::size_t k = 0; k < coordinates.size(); ++k)
      write_coordinate(coordinates[k], layout.axes[k]);
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    waiting_.append(cells, columns, [&](std::int64_t chunk, const auto& values) {
      throw_if_interrupted();
      const std::vector<std::int64_t> place = grid_.place(chunk);
      Shape start(place.size()), count(place.size());
      for (std::size_t axis = 0; axis < place.size(); ++axis) {
        start[axis] = static_cast<std::size_t>(place[axis]) * grid_.chunk[axis];
        count[axis] = std::min(grid_.chunk[axis], grid_.shape[axis] - start[axis]);
      }
      for (std::size_t k = 0; k < variables_.size(); ++k)
        write(variables_[k], start, count, values[k].data());
    });
  }

  void commit() override {
    finish();
    output_.commit();
  }

 private:
  void check(int status) const {
    if (status == NC_NOERR) return;
    throw OutputError("cannot write " + shown_ + ": " + words_for(status, errno));
  }

  void describe(int variable, const Attributes& attributes) const {
    for (const auto& [name, text] : attributes)
      check(NETCDF(nc_put_att_text)(file_, variable, name.c_str(), text.size(), text.data()));
  }

  /// Defines a variable. @param may_miss  whether values that are not written are NaN
  int add_variable(const Column& column, int type, const std::vector<int>& dimensions,
                   bool may_miss) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    int number = 0;
    check(NETCDF(nc_def_var)(file_, cf_name(column.name).c_str(), type,
                             static_cast<int>(dimensions.size()), dimensions.data(), &number));
    check(NETCDF(nc_def_var_fill)(file_, number, may_miss ? NC_FILL : NC_NOFILL,
                                  may_miss ? &none : nullptr));
    return number;
  }

  void add_column(const CellColumn& column, const std::vector<int>& dimensions) {
    const int type = type_of(column);
    const int variable = add_variable(column.column, type, dimensions, type == NC_DOUBLE);
    if (type == NC_BYTE) {
      std::vector<signed char> numbers(column.words.size());
      std::iota(numbers.begin(), numbers.end(), static_cast<signed char>(0));
      check(NETCDF(nc_put_att_schar)(file_, variable, "flag_values", NC_BYTE, numbers.size(),
                                     numbers.data()));
    }
    describe(variable, column_attributes(column));
    set_chunks(variable);
    variables_.push_back(variable);
  }

  /// Sets chunks, and compression with shuffled bytes. Cells come in order, so the cache keeps one
  /// chunk in place of the library's usual megabytes.
  void set_chunks(int variable) const {
    constexpr int shuffle = 1, deflate = 1, level = 1;
    check(NETCDF(nc_def_var_chunking)(file_, variable, NC_CHUNKED, grid_.chunk.data()));
    check(NETCDF(nc_def_var_deflate)(file_, variable, shuffle, deflate, level));
    // With any preference for whole chunks, HDF5 never releases chunks that extend beyond the grid.
    constexpr float preference_for_whole_chunks = 0.0F;
    constexpr std::size_t slots = 101;
    const auto bytes = static_cast<std::size_t>(grid_.cells_of_file()) * sizeof(double);
    check(
        NETCDF(nc_set_var_chunk_cache)(file_, variable, bytes, slots, preference_for_whole_chunks));
  }

  void write(int variable, const Shape& start, const Shape& count, const double* values) const {
    check(NETCDF(nc_put_vara_double)(file_, variable, start.data(), count.data(), values));
  }

  void write_coordinate(int variable, const GridAxis& axis) const {
    std::vector<double> part;
    for (std::size_t start = 0; start < axis.count(); start += part.size()) {
      part.resize(std::min(axis.count() - start, values_in_chunk));
      throw_if_interrupted();
      for (std::size_t i = 0; i < part.size(); ++i) part[i] = axis.at(start + i);
      write(variable, {start}, {part.size()}, part.data());
    }
  }

  /// Writes all, closes the file and reads the last value of each variable again. The library
  /// crashes when it closes a file that it cannot write; therefore a child process closes it. In
  /// this process the file stays open, as it does without commit().
  void finish() const {
    check(NETCDF(nc_sync)(file_));
    const int code = run_in_child([&] {
      for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT}) std::signal(fatal, holdfast_on_crash);
      errno = 0;
      return close_and_read() ? 0 : code_of_error();
    });
    if (code == 0) return;
    const bool said = code > 0 && code != unknown_error;
    throw OutputError("cannot write " + shown_ + ": " +
                      (said ? system_words(code) : "the netCDF library could not close the file"));
  }

  bool close_and_read() const {
    Shape last = grid_.shape;
    for (std::size_t& index : last) --index;
    int again = 0, found = 0;
    bool good = NETCDF(nc_close)(file_) == NC_NOERR &&
                NETCDF(nc_open)(path_.c_str(), NC_NOWRITE, &again) == NC_NOERR &&
                NETCDF(nc_inq_nvars)(again, &found) == NC_NOERR;
    for (const int variable : variables_) {
      double value = 0.0;
      good = good && variable < found &&
             NETCDF(nc_get_var1_double)(again, variable, last.data(), &value) == NC_NOERR;
    }
    return good;
  }

  OutputFile output_;
  std::string shown_, path_;
  int file_ = 0;
  ChunkGrid grid_;
  WaitingCells waiting_;
  std::vector<int> variables_;  // of the columns
};

}  // namespace

std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<NetcdfCells>(context, layout);
}

#else

std::unique_ptr<CellWriter> netcdf_cells(const JobContext&, const GridLayout&) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
