#include "table.hpp"

#include <system_error>

#include "errors.hpp"
#include "metadata.hpp"

namespace holdfast::program {
namespace {

/// A name that promises netCDF would lie about what stands in the file. Charts and sweeps keep the
/// promise elsewhere.
const std::optional<std::filesystem::path>& csv_target(
    const std::optional<std::filesystem::path>& path) {
  if (is_netcdf_name(path)) {
    throw WrongInput("--output " + path->string() +
                     ": only stability, response, basins and sweep write netCDF; give a name that "
                     "ends in .csv");
  }
  return path;
}

}  // namespace

Table::Table(const JobContext& context, const std::vector<Column>& columns)
    : output_(csv_target(context.output)), writer_(output_, columns) {
  if (!output_.is_file()) return;
  const std::filesystem::path& target = output_.target();
  metadata_ = std::make_unique<OutputFile>(metadata_path(target));
  metadata_->write(json_text(table_metadata(context, columns, target.filename().string())));
}

void Table::commit() {
  writer_.flush();
  output_.finish();
  if (!metadata_) {
    output_.commit();
    return;
  }
  // The table last: whoever sees it finds its metadata.
  metadata_->commit();
  try {
    output_.commit();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(metadata_->target(), ignored);
    throw;
  }
}

}  // namespace holdfast::program
