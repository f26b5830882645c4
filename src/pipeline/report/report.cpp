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

/// Whole numbers in base64 digits, the highest first: two are 12 bits, three 18.
class Digits {
 public:
  /// The nearest whole number, moved up by half of the range; what is too large is the largest there is.
  void put(double value, int digits) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const double half = std::ldexp(1.0, 6 * digits - 1);
    const auto number = static_cast<std::uint32_t>(std::clamp(std::round(value), -half, half - 1.0) + half);
    for (int k = digits - 1; k >= 0; --k) text_ += kDigits[number >> (6 * k) & 63];
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};
constexpr int kFar = 3, kNear = 2;  ///< digits of what is within 131 m, and within 2 m of the pelvis

std::string_view name_of(Who who) {
  constexpr Array<std::string_view, 5> kNames = {"input", "reference", "cleaned", "truth", ""};
  return kNames[static_cast<int>(who)];
}

/// As many digits as are looked at.
record::Json rounded_number(double value, double digits) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, digits - 1.0 - std::floor(std::log10(std::abs(value))));
  const double rounded = std::round(value * scale) / scale;
  return std::isfinite(rounded) ? rounded : value;
}

constexpr double kOfCurves = 4.0, kOfNumbers = 6.0;

template <class Values>
record::Json numbers(const Values& values, double digits = kOfCurves) {
  record::Json list = record::Json::array();
  for (double v : values) list.push_back(rounded_number(v, digits));
  return list;
}

record::Json to_json(const Words& words) {
  return {{"words", words.words}, {"unit", words.unit}, {"meaning", words.meaning}};
}

record::Json to_json(const ReportNeeds& needs) {
  return {{"force", numbers(needs.force)},
          {"acceleration", numbers(needs.acceleration)},
          {"moment", numbers(needs.moment)},
          {"bar", numbers(needs.bar)}};
}

/// Centres of mass of every frame in mm, [frame][3].
std::string encode_centers(const ReportMotion& motion) {
  Digits digits;
  for (const BodyPoses& pose : motion.poses) {
    const Vector3d center = center_of_mass(motion.character, pose);
    for (int k = 0; k < 3; ++k) digits.put(kMm * center[k], kFar);
  }
  return digits.text();
}

record::Json to_json(const ReportMotion& motion) {
  std::vector<double> radii;
  for (const auto& c : motion.character.capsule) radii.push_back(c.radius);
  return {{"who", name_of(motion.who)},
          {"frames", motion.poses.size()},
          {"radii", numbers(radii)},
          {"ends", encode_capsules(motion.character, motion.poses)},
          {"centers", encode_centers(motion)}};
}

record::Json to_json(const ReportChart& chart) {
  record::Json lines = record::Json::array();
  for (const ReportLine& line : chart.lines)
    lines.push_back({{"who", name_of(line.who)}, {"name", line.name}, {"values", numbers(line.values)}});
  record::Json json = {{"title", to_json(chart.words)}, {"lines", lines}};
  if (chart.step > 0.0) {
    json["step"] = chart.step;
    json["start"] = chart.start;
  } else {
    json["x"] = numbers(chart.x, kOfNumbers);
  }
  return json;
}

record::Json to_json(const ReportBars& bars) {
  record::Json spans = record::Json::array();
  for (const Span& span : bars.spans) spans.push_back(std::array<int, 2>{span.first, span.last});
  return {{"name", bars.name}, {"meaning", bars.meaning}, {"flaw", bars.flaw}, {"spans", spans}};
}

record::Json to_json(const ReportRow& row) {
  record::Json values = record::Json::array();
  for (const auto& three : row.values) values.push_back(numbers(three, kOfNumbers));
  return {{"name", row.name},
          {"ok", row.ok},
          {"reason", row.reason},
          {"made_by", row.made_by},
          {"frames", row.frames},
          {"seconds", rounded_number(row.seconds, kOfNumbers)},
          {"reward", rounded_number(row.reward, kOfNumbers)},
          {"values", values},
          {"embedded", row.embedded}};
}

/// A "</script>" in a file name must not end the element that holds the data.
std::string without_ends(std::string text) {
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

std::string encode_capsules(const Character& character, const std::vector<BodyPoses>& poses) {
  Digits digits;
  for (const BodyPoses& pose : poses) {
    const Vector3d pelvis = (kMm * pose.p_WB[kPelvis]).array().round();
    for (int k = 0; k < 3; ++k) digits.put(pelvis[k], kFar);
    for (int i = 0; i < kBodies; ++i)
      for (const Vector3d& end_B : {character.capsule[i].a_B, character.capsule[i].b_B}) {
        const Vector3d end_W = pose.p_WB[i] + pose.q_WB[i] * end_B;
        for (int k = 0; k < 3; ++k) digits.put(kMm * end_W[k] - pelvis[k], kNear);
      }
  }
  return digits.text();
}

std::string encode_ground(const std::vector<GroundForces>& ground) {
  Digits digits;
  for (const GroundForces& frame : ground)
    for (const GroundForce& arrow : frame) {
      for (int k = 0; k < 2; ++k) digits.put(kMm * arrow.point[k], kFar);
      for (int k = 0; k < 3; ++k) digits.put(arrow.force[k], kFar);
    }
  return digits.text();
}

std::string clip_json(const ReportClip& clip) {
  record::Json json = {{"fps", clip.fps}, {"weight", rounded_number(clip.weight, kOfNumbers)}};
  const auto list = [&json](const char* name, const auto& all) {
    json[name] = record::Json::array();
    for (const auto& one : all) json[name].push_back(to_json(one));
  };
  list("motions", clip.motions);
  list("bars", clip.bars);
  list("charts", clip.charts);
  list("training", clip.training);
  json["notes"] = clip.notes;
  json["facts"] = record::Json::array();
  for (const ReportFact& fact : clip.facts) {
    record::Json one = to_json(fact.words);
    one["group"] = fact.group;
    one["value"] = rounded_number(fact.value, kOfNumbers);
    json["facts"].push_back(one);
  }
  if (!clip.ground.empty()) json["ground"] = encode_ground(clip.ground);
  if (!clip.needs.force.empty()) {
    json["needs"] = to_json(clip.needs);
    json["needs"]["wrong"] = clip.wrong;
    if (!clip.help.force.empty()) json["help"] = to_json(clip.help);
  }
  return without_ends(json.dump());
}

std::string clip_script(const std::string& name, const std::string& json) {
  return "mimicx_clip(" + without_ends(record::Json(name).dump()) + ", " + json + ");\n";
}

std::string format_report(const Report& report, const std::vector<std::string>& clips) {
  record::Json run = record::Json::array(), metrics = record::Json::array(), rows = record::Json::array();
  for (const auto& [name, value] : report.run) run.push_back({{"name", name}, {"value", value}});
  for (const ReportMetric& metric : report.metrics) {
    record::Json one = to_json(metric.words);
    one["key"] = metric.key;
    one["group"] = metric.group;
    metrics.push_back(one);
  }
  for (const ReportRow& row : report.rows) rows.push_back(to_json(row));
  const record::Json all = {{"run", run}, {"metrics", metrics}, {"rows", rows}};
  std::string page = std::string(kReportPageBefore) + without_ends(all.dump());
  for (std::size_t k = 0; k < clips.size(); ++k)
    if (!clips[k].empty())
      page +=
          "</script>\n<script type=\"application/json\" id=\"clip-" + std::to_string(k) + "\">" + clips[k];
  return page + std::string(kReportPageAfter);
}

}  // namespace mimicx::pipeline::report
