#include "jobs/columns.hpp"

#include "jobs/job_texts.hpp"

namespace holdfast::program {

extern const std::string_view jobs_texts;

const toml::table& job_texts() {
  static const toml::table parsed = toml::parse(jobs_texts);
  return parsed;
}

std::vector<std::string> words_of(const toml::array* texts) {
  std::vector<std::string> words;
  if (texts != nullptr)
    for (const toml::node& text : *texts) words.push_back(text_of(text));
  return words;
}

std::vector<CellColumn> cell_columns_of(const std::string& table, const Values& values) {
  std::vector<CellColumn> columns;
  for (const toml::node& node : *job_texts()["columns"][table].as_array()) {
    const toml::array& row = *node.as_array();
    columns.push_back(
        {{text_of(row[0], values), text_of(row[1], values), text_of(row[2], values)}});
    if (row.size() > 3) columns.back().column.datatype = text_of(row[3], values);
    if (row.size() > 4)
      for (const toml::node& word : *row[4].as_array())
        columns.back().words.push_back(text_of(word));
  }
  return columns;
}

std::vector<Column> columns_of(const std::string& table, const Values& values) {
  std::vector<Column> columns;
  for (const CellColumn& column : cell_columns_of(table, values)) columns.push_back(column.column);
  return columns;
}

}  // namespace holdfast::program
