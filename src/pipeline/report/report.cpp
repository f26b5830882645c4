#include "pipeline/report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/units.h"
#include "pipeline/record/json.h"
#include "pipeline/report/report_page.h"

namespace mimicx::pipeline::report {
namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Five digits are more than a curve shows.
record::Json rounded_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, 4.0 - std::floor(std::log10(std::abs(value))));
  const double rounded = std::round(value * scale) / scale;
  return std::isfinite(rounded) ? rounded : value;
}

record::Json numbers(const std::vector<double>& values) {
  record::Json list = record::Json::array();
  for (double v : values) list.push_back(rounded_number(v));
  return list;
}

record::Json to_json(const ReportNeeds& needs) {
  return {{"force", numbers(needs.force)},
          {"acceleration", numbers(needs.acceleration)},
          {"moment", numbers(needs.moment)},
          {"bar", numbers(needs.bar)}};
}

record::Json to_json(const ReportSequence& s) {
  record::Json metrics = {{"columns", s.metric_columns}, {"rows", record::Json::array()}};
  for (const auto& m : s.metrics)
    metrics["rows"].push_back({{"name", m.name}, {"values", numbers(m.values)}});
  record::Json series = record::Json::array();
  for (const auto& c : s.series)
    series.push_back({{"title", c.title}, {"step", c.step}, {"values", numbers(c.values)}});
  record::Json rows = record::Json::array();
  for (const auto& row : s.log.rows) rows.push_back(numbers(row));
  std::vector<double> radii;
  for (const auto& c : s.character.capsule) radii.push_back(c.radius);
  record::Json json = {{"name", s.name},
                       {"status", s.status},
                       {"reason", s.reason},
                       {"fps", s.fps},
                       {"frames", std::max(s.reference.size(), s.simulated.size())},
                       {"radii", numbers(radii)},
                       {"metrics", metrics},
                       {"notes", s.notes},
                       {"series", series},
                       {"log", {{"columns", s.log.columns}, {"rows", rows}}}};
  if (!s.needs.force.empty()) {
    json["needs"] = to_json(s.needs);
    json["needs"]["wrong"] = s.wrong;
    if (!s.help.force.empty()) json["help"] = to_json(s.help);
  }
  json["reference"] =
      s.reference.empty() ? record::Json(nullptr) : record::Json(encode_capsules(s.character, s.reference));
  json["simulated"] =
      s.simulated.empty() ? record::Json(nullptr) : record::Json(encode_capsules(s.character, s.simulated));
  return json;
}

}  // namespace

std::string encode_capsules(const Character& character, const std::vector<BodyPoses>& poses) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(poses.size() * kBodies * 12);
  const auto put = [&bytes](double metres) {
    const double mm = std::clamp(std::round(kMm * metres), -32768.0, 32767.0);
    const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(mm));
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  };
  for (const BodyPoses& pose : poses) {
    for (std::size_t i = 0; i < kBodies; ++i) {
      for (const Vector3d& end_B : {character.capsule[i].a_B, character.capsule[i].b_B}) {
        const Vector3d end_W = pose.p_WB[i] + pose.q_WB[i] * end_B;
        for (int k = 0; k < 3; ++k) put(end_W[k]);
      }
    }
  }
  return base64(bytes);
}

std::string format_report(const std::vector<ReportSequence>& sequences) {
  return format_report(sequences.size(), [&](std::size_t i) { return sequences[i]; });
}

std::string format_report(std::size_t count, const std::function<ReportSequence(std::size_t)>& sequence) {
  std::string text = "{\"sequences\":[";
  for (std::size_t i = 0; i < count; ++i) text.append(i > 0 ? "," : "").append(to_json(sequence(i)).dump());
  text += "]}";
  // A "</script>" in a file name must not end the element that holds the data.
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.replace(at, 2, "<\\/");
  return std::string(kReportPageBefore) + text + std::string(kReportPageAfter);
}

}  // namespace mimicx::pipeline::report
