#include "import/opensim/storage_table.h"

#include <algorithm>

#include "core/number_text.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

constexpr std::size_t kMostColumns = 4096;

/// What the header says of the size of the table; none where it does not.
struct SaidSize {
  std::optional<double> rows, columns;
};

/// The number behind a key of the header; none where there is no number. The rest of the key's line is read.
std::optional<double> number_behind(std::string_view word, std::string_view key, TextInput& input) {
  std::string rest(word.substr(key.size()));
  for (std::string_view more = input.word_on_line(); !more.empty(); more = input.word_on_line()) rest += more;
  double number = 0.0;
  const std::string_view digits = std::string_view(rest).substr(rest.starts_with('=') ? 1 : 0);
  return parse_number(digits, number) ? std::optional(number) : std::nullopt;
}

/// Reads a word of the header: "nRows=751", "nRows = 751", "datarows 751".
void read_said(std::string_view word, TextInput& input, SaidSize& said) {
  const std::string_view key = word.substr(0, word.find('='));
  if (equal_but_for_case(key, "nRows") || equal_but_for_case(key, "datarows"))
    said.rows = number_behind(word, key, input);
  else if (equal_but_for_case(key, "nColumns") || equal_but_for_case(key, "datacolumns"))
    said.columns = number_behind(word, key, input);
}

void expect_said(const std::optional<double>& said, std::size_t found, const std::string& what,
                 const TextInput& input) {
  if (said && *said != static_cast<double>(found))
    input.fail_with(text_of(*said) + ' ' + what + ", as the header says", std::to_string(found));
}

}  // namespace

std::optional<std::size_t> StorageTable::find(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

StorageTable parse_storage(std::string_view text, const std::string& path) {
  TextInput input(text, path);
  StorageTable table;
  SaidSize said;
  for (std::string_view word = input.word(); word != "endheader"; word = input.word()) {
    if (word.empty()) input.fail("the line 'endheader' of an OpenSim storage file", word);
    read_said(word, input, said);
  }
  for (std::string_view word = input.word(); !word.empty(); word = input.word_on_line())
    table.columns.emplace_back(word);
  if (table.columns.empty() || !equal_but_for_case(table.columns.front(), "time"))
    input.fail("names of columns, the first of which is 'time'",
               table.columns.empty() ? std::string_view() : table.columns.front());
  if (table.columns.size() > kMostColumns)
    input.fail_with("at most 4096 columns", std::to_string(table.columns.size()));
  expect_said(said.columns, table.columns.size(), "columns", input);
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
  expect_said(said.rows, table.rows.size(), "rows", input);
  return table;
}

}  // namespace mimicx::import
