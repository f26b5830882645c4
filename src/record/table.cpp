#include "record/table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/file.h"
#include "core/number_text.h"

namespace mimicx::record {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

}  // namespace

std::size_t Table::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::invalid_argument("Table: no column '" + name + "'");
  return static_cast<std::size_t>(found - columns.begin());
}

std::string format_number(double value) {
  if (!std::isfinite(value)) return {};
  return text_of(value);
}

std::string format_csv(const Table& table) {
  std::string text;
  const auto add = [&text](std::size_t i, const std::string& field) {
    if (i > 0) text += ',';
    text += field;
  };
  for (std::size_t i = 0; i < table.columns.size(); ++i) add(i, table.columns[i]);
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) add(i, format_number(row[i]));
    text += '\n';
  }
  return text;
}

Table read_csv(const std::filesystem::path& path) { return parse_csv(read_file(path), path); }

Table parse_csv(const std::string& text, const std::filesystem::path& path) {
  std::istringstream lines(text);
  std::string line;
  Table table;
  if (!std::getline(lines, line)) throw DataError(path.string(), "line 1", "column names", "nothing");
  table.columns = split(line);
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::string place = "line " + std::to_string(number);
    const auto fields = split(line);
    if (fields.size() != table.columns.size())
      throw DataError(path.string(), place, std::to_string(table.columns.size()) + " fields",
                      std::to_string(fields.size()));
    std::vector<double> row;
    for (const auto& field : fields) {
      const std::optional<double> value = number_from(field);
      if (!value && !field.empty()) throw DataError(path.string(), place, "a number", "'" + field + "'");
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace mimicx::record
