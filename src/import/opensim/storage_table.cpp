#include "import/opensim/storage_table.h"

#include <algorithm>

#include "import/text_input.h"

namespace mimicx::import {
namespace {

constexpr std::size_t kMostColumns = 4096;

}  // namespace

std::optional<std::size_t> StorageTable::find(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

StorageTable parse_storage(std::string_view text, const std::string& path) {
  TextInput input(text, path);
  StorageTable table;
  for (std::string_view word = input.word(); word != "endheader"; word = input.word())
    if (word.empty()) input.fail("the line 'endheader' of an OpenSim storage file", word);
  for (std::string_view word = input.word(); !word.empty(); word = input.word_on_line())
    table.columns.emplace_back(word);
  if (table.columns.empty() || !equal_but_for_case(table.columns.front(), "time"))
    input.fail("names of columns, the first of which is 'time'",
               table.columns.empty() ? std::string_view() : table.columns.front());
  if (table.columns.size() > kMostColumns)
    input.fail_with("at most 4096 columns", std::to_string(table.columns.size()));
  while (!input.peek().empty()) {
    std::vector<double> row = {input.number("a time")};
    while (row.size() < table.columns.size()) {
      const std::string_view word = input.word_on_line();
      double value = 0.0;
      if (!parse_number(word, value)) input.fail("a number per column", word);
      row.push_back(value);
    }
    if (const std::string_view more = input.word_on_line(); !more.empty())
      input.fail("the end of the row", more);
    if (!table.rows.empty() && !(row[0] > table.rows.back()[0]))
      input.fail_with("times that increase", printable(std::to_string(row[0])));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace mimicx::import
