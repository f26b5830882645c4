/// A table of numbers with named columns: the training log in memory and as CSV.
///
/// Numbers are written with the fewest digits that read back as the same bits, independent of the locale, so
/// a log that was read back and written again is the same bytes. A value that is not finite is written as an
/// empty field. Nothing is quoted: column names contain neither commas nor line breaks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mimicx::record {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< [row][column]; NaN where there is no value

  /// Index of a column. @throws std::invalid_argument when there is none of that name.
  std::size_t column(const std::string& name) const;
};

/// The fewest digits that read back as the same number; empty for NaN and infinities.
std::string format_number(double value);

std::string format_csv(const Table& table);
/// @throws DataError naming the file and the line of a row that is too short, too long or not a number.
Table read_csv(const std::filesystem::path& path);
/// The same from its text. @param path  for messages
Table parse_csv(const std::string& text, const std::filesystem::path& path);

}  // namespace mimicx::record
