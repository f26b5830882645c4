/// `mimicx evaluate --protocol`: the tables of published protocols (motion/published_protocols.h), file by
/// file.
///
/// Pairs are files of the same name. A truth without a comparable motion has no values. Protocols with a
/// success rate count it as a failure, because otherwise a method that omits hard motions would look better.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/motion_file.h"
#include "motion/published_protocols.h"

namespace mimicx::judge {

struct ProtocolRow {
  std::string name;
  std::string reason;  ///< why it has no values, one line; empty: it has values
  int frames = 0;
  std::vector<motion::MetricValue> values;  ///< per column
};

struct ProtocolTable {
  motion::Protocol protocol = motion::Protocol::kPhc;
  std::string folder;
  std::vector<ProtocolRow> rows;  ///< a row per truth or motion, by name
};

/// @throws DataError for a missing path, and if `motions` holds no motion
ProtocolTable evaluate_protocol(motion::Protocol protocol, const std::filesystem::path& truth,
                                const std::filesystem::path& motions, const import::ReadConfig& read = {});

/// Over the samples of all rows that have values. @param succeeded  only rows that are a success
std::vector<motion::MetricValue> pooled_row(const ProtocolTable& table, bool succeeded = false);

/// A line per motion and the pooled lines; for several tables only the pooled lines. Definitions and sources
/// follow.
std::string format_protocol(const std::vector<ProtocolTable>& tables);
/// {"protocol", "columns": [{name, unit, definition, source}], "folders": [{folder, pooled, succeeded,
/// motions}]}
std::string protocol_json(const std::vector<ProtocolTable>& tables);

}  // namespace mimicx::judge
