#include "io/grid/netcdf_dataset.hpp"

#include <algorithm>
#include <utility>

#ifdef HOLDFAST_HAS_NETCDF
#include "case/case_file.hpp"
#include "io/file/metadata.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

NetcdfFile::Shape chunk_shape(const NetcdfFile::Shape& shape, std::size_t longest_line) {
  NetcdfFile::Shape chunk(shape.size(), 1);
  if (shape.empty()) return chunk;
  chunk.back() = std::min(shape.back(), longest_line);
  std::size_t values = std::max(shape.back(), std::size_t{1});
  for (std::size_t axis = shape.size() - 1; axis-- > 0 && values < values_in_block;) {
    chunk[axis] = std::min(shape[axis], values_in_block / values);
    values *= shape[axis];
  }
  return chunk;
}

#ifdef HOLDFAST_HAS_NETCDF

namespace {

/// The options as a JSON object, as in the metadata beside a CSV file.
std::string options_text(const JobContext& context) {
  const auto options = table_metadata(context, {}, "")["notes"][0]["holdfast"]["options"];
  return options.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

NetcdfFile::Shape shape_of(const std::vector<GridAxis>& axes) {
  NetcdfFile::Shape shape;
  for (const GridAxis& axis : axes) shape.push_back(axis.count());
  return shape;
}

const OutputFile& require_file(const OutputFile& output) {
  if (!output.is_file())
    throw WrongInput("cannot write " + output.target().string() + ": netCDF needs a regular file");
  return output;
}

}  // namespace

NetcdfDataset::NetcdfDataset(const JobContext& context, std::vector<GridAxis> axes)
    : axes_(std::move(axes)),
      shape_(shape_of(axes_)),
      output_(context.output),
      file_(require_file(output_)) {
  describe_origin(context);
  for (const GridAxis& axis : axes_)
    dimensions_.push_back(file_.add_dimension(axis.column.name, axis.count()));
  for (const GridAxis& axis : axes_) add_coordinate(axis);
}

void NetcdfDataset::describe_origin(const JobContext& context) {
  file_.set_attribute("Conventions", "CF-1.10");
  file_.set_attribute("title", "holdfast " + context.job);
  file_.set_attribute("source", std::string("holdfast ") + HOLDFAST_VERSION);
  file_.set_attribute("options", options_text(context));
  if (context.on_packs)
    file_.set_attribute("instructions", std::string(name_of(context.instructions)));
  file_.set_attribute("case", case_to_toml(context.case_data));
}

void NetcdfDataset::set_long_name(Number variable, const Column& column) {
  if (!column.description.empty()) file_.set_attribute(variable, "long_name", column.description);
}

void NetcdfDataset::set_units(Number variable, const Column& column) {
  file_.set_attribute(variable, "units", udunits(column.unit));
}

void NetcdfDataset::add_coordinate(const GridAxis& axis) {
  const Number dimension = dimensions_[coordinates_.size()];
  coordinates_.push_back(file_.add_coordinate(axis.column.name, dimension));
  set_long_name(coordinates_.back(), axis.column);
  set_units(coordinates_.back(), axis.column);
}

NetcdfDataset::Number NetcdfDataset::described(Number variable, const Column& column,
                                               const Shape& chunk) {
  set_units(variable, column);
  set_long_name(variable, column);
  file_.set_chunks(variable, chunk);
  return variable;
}

NetcdfDataset::Number NetcdfDataset::add_reals(const Column& column, const Shape& chunk) {
  return described(file_.add_reals(column.name, dimensions_), column, chunk);
}

NetcdfDataset::Number NetcdfDataset::add_integers(const Column& column, const Shape& chunk) {
  return described(file_.add_integers(column.name, dimensions_), column, chunk);
}

NetcdfDataset::Number NetcdfDataset::add_flags(const Column& column,
                                               const std::vector<std::string>& words,
                                               const Shape& chunk) {
  const Number variable = file_.add_flags(column.name, dimensions_, words);
  set_long_name(variable, column);
  file_.set_chunks(variable, chunk);
  return variable;
}

void NetcdfDataset::begin_values() {
  file_.begin_values();
  for (std::size_t i = 0; i < axes_.size(); ++i) write_coordinate(coordinates_[i], axes_[i]);
}

void NetcdfDataset::write_coordinate(Number variable, const GridAxis& axis) {
  std::vector<double> part;
  for (std::size_t start = 0; start < axis.count(); start += part.size()) {
    part.resize(std::min(axis.count() - start, values_in_block));
    throw_if_interrupted();
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = axis.at(start + i);
    file_.write(variable, {start}, {part.size()}, part.data());
  }
}

void NetcdfDataset::commit() {
  file_.close();
  output_.commit();
}

#endif

}  // namespace holdfast::program
