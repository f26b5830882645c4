/// OpenSim's storage files (.mot, .sto): a table of numbers over time.
///
/// A name, lines such as "nRows=751" ("datarows 751" of SIMM), the line "endheader", a row of column names
/// beginning with "time", and rows of numbers. Format: OpenSim, "Storage (.sto) Files" of its User's Guide.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mimicx::import {

struct StorageTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< [row][column]; the first column is the time, s

  /// Index of a column; none if no column has that name.
  std::optional<std::size_t> find(std::string_view name) const;
};

/// @param path  for messages
/// @throws DataError for a text that is none, a row of another length, times that do not increase, and other
/// numbers of rows or columns than the header says
StorageTable parse_storage(std::string_view text, const std::string& path);

}  // namespace mimicx::import
