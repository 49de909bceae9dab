#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/require.hpp"
#include "io/text/csv.hpp"
#include "io/text/record_file.hpp"
#include "process/errors.hpp"

namespace {

using namespace holdfast::program;
using holdfast::fuzz::require;

/// All in quotes: nothing in them separates or begins a comment.
std::string line_of(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    line += line.empty() ? "\"" : ",\"";
    for (const char character : cell) line += character == '"' ? "\"\"" : std::string(1, character);
    line += '"';
  }
  return line + "\r\n";
}

std::vector<std::vector<std::string>> rows_of(const CsvTable& table) {
  std::vector<std::vector<std::string>> rows = {table.names()};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> cells;
    cells.reserve(table.names().size());
    for (const std::string& name : table.names()) cells.push_back(table.text(row, name));
    rows.push_back(std::move(cells));
  }
  return rows;
}

/// Behind a byte order mark, so that one at the beginning of the first name stays.
std::string written(const std::vector<std::vector<std::string>>& rows) {
  std::string text = "\xEF\xBB\xBF";
  for (const std::vector<std::string>& row : rows) text += line_of(row);
  return text;
}

void require_one_line(const WrongInput& refusal) {
  require(std::string(refusal.what()).find('\n') == std::string::npos, "a refusal is one line");
}

void read_as_table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  try {
    const CsvTable table = parse_csv(text, "fuzz.csv");
    rows = rows_of(table);
    for (const std::string& name : table.names()) table.numbers(name);
  } catch (const WrongInput& refusal) {
    require_one_line(refusal);
  }
  if (!rows.empty())
    require(rows_of(parse_csv(written(rows), "again.csv")) == rows,
            "a table that was written reads as the same table");
}

void read_as_decay(const std::string& text) {
  try {
    const auto record = read_decay_text(text, "fuzz.csv");
    require(record.times.size() == record.displacements.size(), "every instant has a displacement");
    require(record.displacements.front() != 0.0, "a decay begins displaced");
  } catch (const WrongInput& refusal) {
    require_one_line(refusal);
  }
}

}  // namespace

/// Any text as a table and as a decay record.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_as_table(text);
  read_as_decay(text);
  return 0;
}
