#include "report/report.h"

#include <cmath>
#include <string_view>

#include "core/elementary.h"
#include "record/json.h"
#include "report/motion_encoding.h"
#include "report/report_page.h"

namespace mimicx::report {
namespace {

std::string_view name_of(Who who) {
  constexpr Array<std::string_view, 5> kNames = {"input", "reference", "cleaned", "truth", ""};
  return kNames[static_cast<int>(who)];
}

/// Steps per unit of the numbers in the page.
record::Json rounded_number(double value, double digits) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = pow(10.0, static_cast<int>(digits - 1.0 - std::floor(log10(std::abs(value)))));
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

record::Json to_json(const ReportMotion& motion) {
  record::Json json = {{"who", name_of(motion.who)},
                       {"frames", motion.poses.size()},
                       {"body", motion.body},
                       {"poses", encode_poses(motion.poses)},
                       {"centers", encode_centers(motion.character, motion.poses)}};
  if (!motion.support.empty()) json["support"] = encode_support(motion.support, motion.poses);
  return json;
}

record::Json to_json(const ReportChart& chart) {
  record::Json lines = record::Json::array();
  for (const ReportLine& line : chart.lines) {
    record::Json one = {{"who", name_of(line.who)}, {"name", line.name}, {"values", numbers(line.values)}};
    if (!line.least.empty()) {
      one["least"] = numbers(line.least);
      one["most"] = numbers(line.most);
    }
    lines.push_back(one);
  }
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
  return {{"name", bars.name},
          {"meaning", bars.meaning},
          {"flaw", bars.flaw},
          {"spans", spans},
          {"who", name_of(bars.who)}};
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

/// JSON that may stand in a page: what a file name has of HTML ("</script>", "<!--") must not end the element
/// that holds it, or keep it open. JSON has "<" in texts alone, where "\u003c" is the same letter.
std::string safe_in_html(std::string json) {
  constexpr std::string_view kEscaped = "\\u003c";
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += kEscaped.size())
    json.replace(at, 1, kEscaped);
  return json;
}

}  // namespace

std::string row_json(const ReportRow& row) { return to_json(row).dump(); }

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
  if (!clip.torques.empty()) json["torques"] = encode_torques(clip.torques);
  for (const Plate& p : clip.scene.plates)
    json["plates"].push_back(std::vector<double>{p.centre.x(), p.centre.y(), p.yaw, p.half_extents.x(),
                                                 p.half_extents.y(), p.height});
  if (clip.camera) json["camera"] = record::Json::parse(camera_json(*clip.camera));
  for (const ReportStretch& s : clip.options)
    json["options"].push_back(std::array<int, 3>{s.first, s.last, s.option});
  if (!clip.needs.force.empty()) {
    json["needs"] = to_json(clip.needs);
    json["needs"]["wrong"] = clip.wrong;
    if (!clip.assistance.force.empty()) json["help"] = to_json(clip.assistance);
  }
  return safe_in_html(json.dump());
}

std::string clip_script(const std::string& name, const std::string& json,
                        const std::map<std::string, std::string>& bodies) {
  std::string list;
  for (const auto& [key, body] : bodies) list += (list.empty() ? "\"" : ", \"") + key + "\": " + body;
  return "mimicx_clip(" + safe_in_html(record::Json(name).dump()) + ", " + json + ", {" + list + "});\n";
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
  record::Json all = {{"run", run}, {"metrics", metrics}, {"rows", rows}};
  if (!report.map.empty()) all["map"] = record::Json::parse(report.map);
  std::string page = std::string(kReportPageBefore) + safe_in_html(all.dump());
  const auto add = [&page](const std::string& id, const std::string& json) {
    if (!json.empty()) page += "</script>\n<script type=\"application/json\" id=\"" + id + "\">" + json;
  };
  add("skin", report.skin);
  for (const auto& [key, body] : report.bodies) add("body-" + key, body);
  for (std::size_t k = 0; k < clips.size(); ++k) add("clip-" + std::to_string(k), clips[k]);
  return page + std::string(kReportPageAfter);
}

}  // namespace mimicx::report
