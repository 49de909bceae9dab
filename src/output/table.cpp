#include "output/table.hpp"

#include <algorithm>
#include <cmath>

#include "host/job_host.hpp"
#include "output/grid/cell_writer.hpp"
#include "output/metadata.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

/// The output path. Throws WrongInput for a name of a netCDF file or a store, since this class
/// writes CSV.
const std::optional<std::filesystem::path>& csv_target(
    const std::optional<std::filesystem::path>& path) {
  if (is_netcdf_name(path) || is_store_name(path)) {
    throw WrongInput("--output " + path->string() +
                     ": only stability, response, basins and sweep write netCDF and Zarr stores; "
                     "give a name that ends in .csv");
  }
  return path;
}

}  // namespace

Table::Table(const JobContext& context, const std::vector<Column>& columns)
    : output_(csv_target(context.output)),
      writer_(output_, columns),
      context_(context),
      columns_(columns) {
  if (is_received(context)) {
    for (const Column& column : columns) received_.emplace_back(column);
    writer_.give_to(received_);
  }
  if (output_.is_file()) metadata_ = std::make_unique<OutputFile>(metadata_path(output_.target()));
}

void Table::expect(std::int64_t rows) {
  for (ReceivedColumn& column : received_) column.reserve(static_cast<std::size_t>(rows));
}

std::uint64_t Table::nans(std::size_t column) {
  if (received_.empty()) return writer_.nans()[column];
  const std::vector<double>& numbers = received_[column].numbers();
  return static_cast<std::uint64_t>(std::count_if(numbers.begin(), numbers.end(),
                                                  [](double value) { return std::isnan(value); }));
}

void Table::require_numbers() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].may_be_nan() || nans(i) == 0) continue;
    const std::string said = columns_[i].name + " is nan in " + std::to_string(nans(i)) + " of " +
                             std::to_string(writer_.rows()) +
                             " rows, where differences of two sizes disagree: the answer jumps or "
                             "bends there";
    if (4 * nans(i) > writer_.rows()) throw NoAnswer(said);
    report_warning(said, context_.quiet);
  }
}

void Table::commit() {
  if (!received_.empty()) {
    JobHost::current()->tables.push_back(
        {{}, std::move(received_), origin_text(context_, trusted_)});
    return;
  }
  writer_.flush();
  if (!metadata_) {
    output_.commit();
    return;
  }
  const std::string name = output_.target().filename().string();
  metadata_->write(
      json_text(table_metadata(context_, columns_, name, trusted_, output_.written())));
  commit_together(output_, *metadata_);
}

void require_text_meant(const JobContext& context, std::int64_t count, const std::string& what,
                        const std::string& instead) {
  const bool received = is_received(context);
  const std::int64_t most = received ? 200'000'000 : 10'000'000;
  if (count > most && !context.yes)
    throw WrongInput(
        std::to_string(count) + " " + what +
        (received ? " would take gigabytes of memory: " : " would make a table of gigabytes: ") +
        instead + "; give --yes to " + (received ? "compute them anyway" : "write them as text"));
}

void tell_trust(const JobContext& context, Table& table, const TrustedDigits& trusted) {
  table.trust(trusted);
  report_warning(trust_warning(trusted), context.quiet);
}

}  // namespace holdfast::program
