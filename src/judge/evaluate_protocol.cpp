#include "judge/evaluate_protocol.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/number_text.h"
#include "judge/evaluate.h"
#include "record/json.h"

namespace mimicx::judge {
namespace {

/// Whether the protocol's first column is a success rate.
bool has_success(motion::Protocol protocol) { return protocol == motion::Protocol::kPhc; }

ProtocolRow row_of(motion::Protocol protocol, const std::string& name, const Pair& files,
                   const import::ReadConfig& read) {
  ProtocolRow row;
  row.name = name;
  row.values.resize(motion::protocol_columns(protocol).size());
  try {
    if (files.motion.empty()) throw DataError(files.truth.string(), "", "a motion for this truth", "none");
    const PairedMotion pair = read_pair(files, read);
    row.frames = pair.evaluated.frames();
    row.values = motion::evaluate_by(protocol, pair.evaluated, pair.truth);
  } catch (const std::exception& error) {
    row.reason = error.what();
    if (has_success(protocol)) row.values[0] = {0.0, 1};
  }
  return row;
}

std::string cells(const std::vector<motion::MetricValue>& values) {
  std::string line;
  for (const motion::MetricValue& v : values)
    line += std::isfinite(v.value) ? formatted(" %11.2f", v.value) : "           -";
  return line;
}

/// The pooled lines of a table.
std::string pooled_lines(const ProtocolTable& table, const std::string& label, std::size_t width) {
  std::string text = padded(label, width) + cells(pooled_row(table)) + '\n';
  if (has_success(table.protocol))
    text += padded(label + ", successes", width) + cells(pooled_row(table, true)) + '\n';
  return text;
}

record::Json table_json(const std::vector<motion::ProtocolColumn>& columns,
                        const std::vector<motion::MetricValue>& values) {
  record::Json json = record::Json::object();
  for (std::size_t k = 0; k < columns.size(); ++k)
    json[columns[k].name] = {{"value", record::number(values[k].value)}, {"count", values[k].count}};
  return json;
}

}  // namespace

ProtocolTable evaluate_protocol(motion::Protocol protocol, const std::filesystem::path& truth,
                                const std::filesystem::path& motions, const import::ReadConfig& read) {
  ProtocolTable table;
  table.protocol = protocol;
  table.folder = motions.string();
  for (const auto& [name, pair] : paired(truth, motions))
    table.rows.push_back(row_of(protocol, name, pair, read));
  return table;
}

std::vector<motion::MetricValue> pooled_row(const ProtocolTable& table, bool succeeded) {
  std::vector<motion::MetricValue> row;
  for (std::size_t k = 0; k < motion::protocol_columns(table.protocol).size(); ++k) {
    std::vector<motion::MetricValue> values;
    for (const ProtocolRow& motion : table.rows)
      if (!succeeded || motion.values.front().value > 0.0) values.push_back(motion.values[k]);
    row.push_back(motion::pooled(values));
  }
  return row;
}

std::string format_protocol(const std::vector<ProtocolTable>& tables) {
  const std::string tail = ", successes";
  std::size_t width = tail.size() + 6;
  for (const ProtocolTable& table : tables) {
    if (tables.size() > 1) width = std::max(width, table.folder.size() + tail.size());
    for (const ProtocolRow& row : table.rows) width = std::max(width, row.name.size());
  }
  const auto& columns = motion::protocol_columns(tables.front().protocol);
  std::string names = padded("", width), units = names;
  for (const motion::ProtocolColumn& column : columns) {
    names += formatted(" %11s", column.name);
    units += formatted(" %11s", column.unit);
  }
  std::string text = names + '\n' + units + '\n';
  for (const ProtocolTable& table : tables) {
    if (tables.size() == 1)
      for (const ProtocolRow& row : table.rows)
        text += padded(row.name, width) + (row.reason.empty() ? cells(row.values) : "  " + row.reason) + '\n';
    text += pooled_lines(table, tables.size() == 1 ? "pooled" : table.folder, width);
  }
  for (const motion::ProtocolColumn& column : columns)
    text +=
        padded(column.name, 12) + column.definition + "\n" + padded("", 12) + "after " + column.source + '\n';
  return text;
}

std::string protocol_json(const std::vector<ProtocolTable>& tables) {
  const motion::Protocol protocol = tables.front().protocol;
  const auto& columns = motion::protocol_columns(protocol);
  record::Json json = {{"protocol", motion::protocol_names()[static_cast<std::size_t>(protocol)]},
                       {"columns", record::Json::array()},
                       {"folders", record::Json::array()}};
  for (const motion::ProtocolColumn& column : columns)
    json["columns"].push_back({{"name", column.name},
                               {"unit", column.unit},
                               {"definition", column.definition},
                               {"source", column.source}});
  for (const ProtocolTable& table : tables) {
    record::Json folder = {{"folder", table.folder}, {"pooled", table_json(columns, pooled_row(table))}};
    if (has_success(protocol)) folder["succeeded"] = table_json(columns, pooled_row(table, true));
    folder["motions"] = record::Json::array();
    for (const ProtocolRow& row : table.rows)
      folder["motions"].push_back({{"name", row.name},
                                   {"reason", row.reason},
                                   {"frames", row.frames},
                                   {"values", table_json(columns, row.values)}});
    json["folders"].push_back(folder);
  }
  return record::document(json);
}

}  // namespace mimicx::judge
