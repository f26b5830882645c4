#include "report/clip_script_file.h"

#include <fstream>
#include <string>

#include "core/file.h"
#include "record/json.h"
#include "record/sequence_entry.h"
#include "report/report_bodies.h"

namespace mimicx::report {
namespace {

using record::Json;

/// A checksum of everything that the row and the clip depend on.
std::string made_of(const record::SequenceEntry& entry, const std::vector<ReportMetric>& metrics) {
  std::string all = std::string(MIMICX_VERSION) + '\n' + record::to_json(entry).dump();
  for (const ReportMetric& metric : metrics) all += '\n' + metric.key;
  return record::checksum(all);
}

/// Whether the file is complete: the call is closed.
bool is_whole(std::ifstream& file) {
  const std::string expected = "});\n";
  std::string end(expected.size(), ' ');
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == expected;
}

std::string values_in_line(const ReportRow& row) {
  Json values = Json::array();
  for (const auto& three : row.values) {
    Json one = Json::array();
    for (const double value : three) one.push_back(record::number(value));
    values.push_back(one);
  }
  return values.dump();
}

/// @throws JsonError for any other line
void take_values(const std::string& line, ReportRow& row) {
  const Json values = Json::parse(line);
  if (values.elements().size() != row.values.size())
    throw record::JsonError("not the values of these metrics");
  for (std::size_t k = 0; k < row.values.size(); ++k) {
    const std::vector<Json>& three = values.at(k).elements();
    if (three.size() != row.values[k].size()) throw record::JsonError("not three values");
    for (std::size_t i = 0; i < three.size(); ++i) row.values[k][i] = record::number_or_nan(three[i]);
  }
}

}  // namespace

ReportRow write_clip_script(const record::RunFolder& folder, const record::SequenceEntry& entry,
                            const std::vector<ReportMetric>& metrics, const TruthReader& read_truth) {
  ReportedClip made = report_clip(folder, entry, metrics, read_truth);
  ReportBodies bodies;
  for (ReportMotion& motion : made.clip.motions) motion.body = bodies.take(motion.character);
  const std::string origin =
      read_truth ? std::string("with a truth") : made_of(entry, metrics) + ' ' + values_in_line(made.row);
  const std::filesystem::path file = folder.report_clip(entry.name);
  make_folder(file.parent_path());
  write_file_atomically(
      file, "// " + origin + '\n' + clip_script(entry.name, clip_json(made.clip), bodies.texts()));
  made.row.embedded = false;
  return made.row;
}

std::optional<ReportRow> kept_clip_script(const record::RunFolder& folder, const record::SequenceEntry& entry,
                                          const std::vector<ReportMetric>& metrics) {
  std::ifstream file(folder.report_clip(entry.name), std::ios::binary);
  const std::string expected = "// " + made_of(entry, metrics) + ' ';
  std::string line;
  if (!std::getline(file, line) || !line.starts_with(expected) || !is_whole(file)) return std::nullopt;
  try {
    ReportRow row = report_row(entry, metrics);
    take_values(line.substr(expected.size()), row);
    row.embedded = false;
    return row;
  } catch (const record::JsonError&) {
    return std::nullopt;
  }
}

}  // namespace mimicx::report
