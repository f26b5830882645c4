#include "pipeline/evaluate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "motion/reference.h"

namespace mimicx {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> npz_names(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw DataError(folder.string(), "", "a folder", "none");
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    if (file.path().extension() == ".npz") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

MotionSamples samples_of(const Clip& clip) {
  return sample_motion(make_character(clip.usable_betas()), poses_of(clip), clip.fps);
}

EvaluatedMotion evaluate_file(const std::filesystem::path& truth, const std::filesystem::path& motion) {
  EvaluatedMotion result;
  result.name = motion.stem().string();
  try {
    if (!std::filesystem::exists(truth))
      throw DataError(truth.string(), "", "the truth of " + result.name, "no file");
    const MotionSamples p = samples_of(read_clip(motion)), g = samples_of(read_clip(truth));
    result.frames = p.frames();
    result.metrics = evaluate_motion(p, &g);
    result.ok = true;
  } catch (const std::exception& error) {
    result.reason = error.what();
  }
  return result;
}

std::string cell(double value) {
  char text[32];
  std::snprintf(text, sizeof text, " %9.2f", value);
  return std::isfinite(value) ? text : "         -";
}

std::string padded(const std::string& name, std::size_t width) {
  return name + std::string(width > name.size() ? width - name.size() : 0, ' ');
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const EvaluatedMotion& m) {
  Json json = {
      {"name", m.name}, {"status", m.ok ? "ok" : "failed"}, {"reason", m.reason}, {"frames", m.frames}};
  for (const auto& d : metric_definitions())
    json["metrics"][d.name] = {{"value", number((m.metrics.*d.value).value)},
                               {"count", (m.metrics.*d.value).count}};
  return json;
}

}  // namespace

Evaluation evaluate_folders(const std::filesystem::path& truth, const std::filesystem::path& motions) {
  Evaluation evaluation;
  const std::vector<std::string> names = npz_names(motions);
  if (names.empty()) throw DataError(motions.string(), "", "motions (.npz)", "none");
  for (const auto& name : npz_names(truth))
    if (!std::binary_search(names.begin(), names.end(), name)) evaluation.unmatched.push_back(name);
  for (const auto& name : names)
    evaluation.motions.push_back(evaluate_file(truth / (name + ".npz"), motions / (name + ".npz")));
  return evaluation;
}

double mean_of(const Evaluation& evaluation, const MetricDefinition& metric) {
  double sum = 0.0;
  int count = 0;
  for (const auto& m : evaluation.motions) {
    const double value = (m.metrics.*metric.value).value;
    if (!m.ok || !std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

std::string format_evaluation(const Evaluation& evaluation) {
  std::size_t width = 4;
  for (const auto& m : evaluation.motions) width = std::max(width, m.name.size());
  std::string text = padded("", width);
  for (const auto& d : metric_definitions()) {
    char title[32];
    std::snprintf(title, sizeof title, " %9s", d.name);
    text += title;
  }
  for (const auto& m : evaluation.motions) {
    text += '\n' + padded(m.name, width);
    if (!m.ok) text += "  " + m.reason;
    for (const auto& d : metric_definitions())
      if (m.ok) text += cell((m.metrics.*d.value).value);
  }
  text += '\n' + padded("mean", width);
  for (const auto& d : metric_definitions()) text += cell(mean_of(evaluation, d));
  return text + '\n';
}

std::string evaluation_json(const Evaluation& evaluation) {
  Json json = {{"motions", Json::array()}, {"mean", Json::object()}, {"definitions", Json::object()}};
  for (const auto& m : evaluation.motions) json["motions"].push_back(to_json(m));
  for (const auto& d : metric_definitions()) {
    json["mean"][d.name] = number(mean_of(evaluation, d));
    json["definitions"][d.name] = {{"unit", d.unit}, {"definition", d.definition}};
  }
  json["unmatched"] = evaluation.unmatched;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mimicx
