#include <cstdint>
#include <utility>

#include "host/job_host.hpp"
#include "output/grid/cell_writer.hpp"
#include "output/metadata.hpp"

namespace holdfast::program {
namespace {

class MemoryCells final : public CellWriter {
 public:
  MemoryCells(JobHost& host, const JobContext& context, const GridLayout& layout) : host_(host) {
    table_.origin = origin_text(context, {});
    for (const GridAxis& axis : layout.axes) {
      table_.axes.push_back({axis.column, {}});
      table_.axes.back().values.reserve(axis.count());
      for (std::size_t i = 0; i < axis.count(); ++i)
        table_.axes.back().values.push_back(axis.at(i));
    }
    for (const CellColumn& column : layout.columns) {
      table_.columns.emplace_back(column.column);
      table_.columns.back().reserve(static_cast<std::size_t>(layout.cells()));
      table_.columns.back().set_words(column.words);
    }
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      ReceivedColumn& column = table_.columns[i];
      if (column.kind() == ReceivedColumn::Kind::numbers)
        column.numbers().insert(column.numbers().end(), columns[i], columns[i] + cells);
      else
        for (std::size_t cell = 0; cell < cells; ++cell)
          column.whole_numbers().push_back(static_cast<std::int64_t>(columns[i][cell]));
    }
  }

  void commit() override { host_.tables.push_back(std::move(table_)); }

 private:
  JobHost& host_;
  ReceivedTable table_;
};

}  // namespace

std::unique_ptr<CellWriter> memory_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<MemoryCells>(*JobHost::current(), context, layout);
}

bool is_received(const JobContext& context) {
  return JobHost::current() != nullptr && !context.output;
}

}  // namespace holdfast::program
