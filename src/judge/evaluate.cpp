#include "judge/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/number_text.h"
#include "files/inputs.h"
#include "import/world_transform.h"
#include "judge/force_metrics.h"
#include "judge/scores.h"
#include "record/json.h"
#include "record/run_folder.h"

namespace mimicx::judge {
namespace {

motion::MotionSamples samples_of(const motion::Clip& clip) { return samples_at(clip, clip.fps); }

/// A motion that does not say on what ground it stands, stands where the other one does. The grounds may
/// differ: a fit moves its scene with it, and scenes that are found are near the true ones.
void share_scene(motion::Clip& a, motion::Clip& b) {
  if (a.scene.flat()) a.scene = b.scene;
  if (b.scene.flat()) b.scene = a.scene;
}

/// Reading moves motions that begin far from the origin there, by multiples of 100 m (import/motion_file.h).
/// Both are put where the truth was moved to. The motions of a run were moved by such a multiple before they
/// were written: one that begins within `kNear` of the truth but for a multiple is moved by it.
void meet(motion::Clip& clip, const motion::Clip& known) {
  constexpr double kNear = 10.0;  // m
  if (clip.trans.empty() || known.trans.empty()) return;
  const Vector3d read = known.place - clip.place;
  if (!read.isZero(0.0)) import::shift_world(read, clip);
  if (!clip.place.isZero(0.0)) return;  // far from the origin in its file: no run wrote it
  Vector3d apart = clip.trans.front() - known.trans.front();
  apart.z() = 0.0;
  const Vector3d shift = import::kMove * Vector3d((apart / import::kMove).array().round());
  if (!shift.isZero(0.0) && (apart - shift).norm() < kNear) import::shift_world(-shift, clip);
}

/// A motion and its truth on their scenes. @throws DataError
std::pair<motion::Clip, motion::Clip> read_clips(const Pair& pair, const import::ReadConfig& read) {
  import::ReadConfig judged = read;
  judged.forces_keep_body = true;  // mass, height and shape are for the truth
  motion::Clip clip = import::read_motion(pair.motion, judged);
  if (pair.truth.empty())
    throw DataError(pair.motion.string(), "", "the truth of " + pair.motion.stem().string(), "no file");
  motion::Clip known = import::read_motion(pair.truth, read);
  meet(clip, known);
  share_scene(clip, known);
  return {std::move(clip), std::move(known)};
}

EvaluatedMotion evaluate_file(const std::string& name, const Pair& files, const import::ReadConfig& read) {
  EvaluatedMotion result;
  result.name = name;
  try {
    const auto [clip, known] = read_clips(files, read);
    result.told = import::notable_decisions(files.motion.string(), clip);
    for (std::string& line : import::notable_decisions(files.truth.string(), known))
      result.told.push_back(std::move(line));
    const motion::MotionSamples evaluated = samples_at(clip, motion::kMetricRate),
                                truth = samples_at(known, motion::kMetricRate);
    result.frames = evaluated.frames();
    result.metrics = motion::evaluate_motion(evaluated, &truth);
    judge_clip(clip, result.metrics);
    result.ok = true;
  } catch (const std::exception& error) {
    result.reason = error.what();
  }
  return result;
}

std::string metric_cell(double value) {
  return std::isfinite(value) ? formatted(" %9.2f", value) : "         -";
}

std::string titles() {
  std::string text;
  for (const auto& d : motion::metric_definitions()) text += formatted(" %9s", d.name);
  return text;
}

record::Json file_json(const EvaluatedMotion& m) {
  record::Json json = {
      {"name", m.name}, {"status", m.ok ? "ok" : "failed"}, {"reason", m.reason}, {"frames", m.frames}};
  for (const auto& d : motion::metric_definitions())
    json["metrics"][d.name] = {{"value", record::number((m.metrics.*d.value).value)},
                               {"count", (m.metrics.*d.value).count}};
  return json;
}

}  // namespace

std::map<std::string, std::filesystem::path> named_motions(const std::filesystem::path& path) {
  std::vector<files::MotionInput> inputs = files::find_motions({path.string()});
  for (files::MotionInput& input : inputs)
    if (input.name.ends_with(".clean")) input.name.resize(input.name.size() - 6);
  const std::vector<std::string> names = files::unique_names(inputs);
  std::map<std::string, std::filesystem::path> named;
  for (std::size_t k = 0; k < inputs.size(); ++k) named[names[k]] = inputs[k].path;
  return named;
}

namespace {

/// A truth belongs to the motion of its file name, "walk.bvh", or else of its name, "walk".
void add_truths(const std::map<std::string, std::filesystem::path>& truths,
                std::map<std::string, Pair>& pairs) {
  const auto file_name = [](const std::string& name, const std::filesystem::path& path) {
    return (std::filesystem::path(name).parent_path() / path.filename()).string();
  };
  std::map<std::string, std::string> motions;  // names by file names
  for (const auto& [name, pair] : pairs) motions[file_name(name, pair.motion)] = name;
  std::map<std::string, std::filesystem::path> others;
  for (const auto& [name, path] : truths)
    if (const auto same = motions.find(file_name(name, path)); same != motions.end())
      pairs[same->second].truth = path;
    else
      others[name] = path;
  for (const auto& [name, path] : others)
    pairs[pairs[name].truth.empty() ? name : file_name(name, path)].truth = path;
}

}  // namespace

std::map<std::string, Pair> paired(const std::filesystem::path& truth, const std::filesystem::path& motions) {
  std::map<std::string, Pair> pairs;
  for (const auto& [name, path] : named_motions(motions)) pairs[name].motion = path;
  const bool two_files = !std::filesystem::is_directory(truth) && !std::filesystem::is_directory(motions);
  if (two_files)
    pairs.begin()->second.truth = truth;
  else
    add_truths(named_motions(truth), pairs);
  std::erase_if(pairs, [](const auto& pair) {
    return pair.second.truth.empty() && record::RunFolder::is_part_name(pair.first);
  });
  return pairs;
}

PairedMotion read_pair(const Pair& pair, const import::ReadConfig& read) {
  const auto [clip, known] = read_clips(pair, read);
  return {samples_of(clip), samples_of(known)};
}

Evaluation evaluate_folders(const std::filesystem::path& truth, const std::filesystem::path& motions,
                            const import::ReadConfig& read) {
  Evaluation evaluation;
  for (const auto& [name, pair] : paired(truth, motions))
    if (pair.motion.empty())
      evaluation.unmatched.push_back(name);
    else
      evaluation.motions.push_back(evaluate_file(name, pair, read));
  return evaluation;
}

double mean_of(const Evaluation& evaluation, const motion::MetricDefinition& metric) {
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

namespace {

/// Names of the truths that have no motion in any of the folders.
std::vector<std::string> without_motions(const std::filesystem::path& truth,
                                         const std::vector<std::string>& folders) {
  std::map<std::filesystem::path, std::vector<std::string>> lacks;  // by truth: its name in those without it
  for (const std::string& folder : folders)
    for (const auto& [name, pair] : paired(truth, folder))
      if (pair.motion.empty()) lacks[pair.truth].push_back(name);
  std::vector<std::string> names;
  for (const auto& [path, lacking] : lacks)
    if (lacking.size() == folders.size()) names.push_back(lacking.front());
  return names;
}

}  // namespace

Comparison compare_folders(const std::filesystem::path& truth, const std::vector<std::string>& folders,
                           const import::ReadConfig& read) {
  Comparison comparison;
  std::map<std::string, std::size_t> evaluated;  // in how many folders
  for (const std::string& folder : folders) {
    comparison.labels.push_back(folder);
    comparison.evaluations.push_back(evaluate_folders(truth, folder, read));
    for (const EvaluatedMotion& m : comparison.evaluations.back().motions) {
      evaluated[m.name] += m.ok ? 1 : 0;
      if (!m.ok) comparison.failures.push_back(folder + "/" + m.name + ": " + m.reason);
    }
  }
  for (Evaluation& evaluation : comparison.evaluations)
    std::erase_if(evaluation.motions, [&](const auto& m) { return evaluated.at(m.name) < folders.size(); });
  for (const auto& [name, count] : evaluated) comparison.left_out += count < folders.size() ? 1 : 0;
  comparison.unmatched = without_motions(truth, folders);
  comparison.left_out += static_cast<int>(comparison.unmatched.size());
  return comparison;
}

std::string format_comparison(const Comparison& comparison) {
  std::size_t width = 0;
  for (const std::string& label : comparison.labels) width = std::max(width, label.size());
  std::string text = padded("", width) + titles();
  for (std::size_t k = 0; k < comparison.labels.size(); ++k) {
    text += '\n' + padded(comparison.labels[k], width);
    for (const auto& d : motion::metric_definitions())
      text += metric_cell(mean_of(comparison.evaluations[k], d));
  }
  text += "\nmeans over " + std::to_string(comparison.evaluations.front().motions.size()) + " motions";
  if (comparison.left_out > 0)
    text += "; " + std::to_string(comparison.left_out) + " that not every folder has are left out";
  return text + '\n';
}

std::string comparison_json(const Comparison& comparison) {
  record::Json json = {
      {"rows", record::Json::array()}, {"motions", record::Json::array()}, {"left_out", comparison.left_out}};
  for (std::size_t k = 0; k < comparison.labels.size(); ++k) {
    record::Json mean = record::Json::object();
    for (const auto& d : motion::metric_definitions())
      mean[d.name] = record::number(mean_of(comparison.evaluations[k], d));
    json["rows"].push_back({{"folder", comparison.labels[k]}, {"mean", mean}});
  }
  for (const EvaluatedMotion& m : comparison.evaluations.front().motions) json["motions"].push_back(m.name);
  json["unmatched"] = comparison.unmatched;
  for (const auto& d : motion::metric_definitions())
    json["definitions"][d.name] = {{"unit", d.unit}, {"definition", d.definition}};
  return record::document(json);
}

std::string format_evaluation(const Evaluation& evaluation) {
  std::size_t width = 4;
  for (const auto& m : evaluation.motions) width = std::max(width, m.name.size());
  std::string text = padded("", width) + titles();
  for (const auto& m : evaluation.motions) {
    text += '\n' + padded(m.name, width);
    if (!m.ok) text += "  " + m.reason;
    for (const auto& d : motion::metric_definitions())
      if (m.ok) text += metric_cell((m.metrics.*d.value).value);
  }
  text += '\n' + padded("mean", width);
  for (const auto& d : motion::metric_definitions()) text += metric_cell(mean_of(evaluation, d));
  return text + '\n';
}

std::string evaluation_json(const Evaluation& evaluation) {
  record::Json json = {{"motions", record::Json::array()},
                       {"mean", record::Json::object()},
                       {"definitions", record::Json::object()}};
  for (const auto& m : evaluation.motions) json["motions"].push_back(file_json(m));
  for (const auto& d : motion::metric_definitions()) {
    json["mean"][d.name] = record::number(mean_of(evaluation, d));
    json["definitions"][d.name] = {{"unit", d.unit}, {"definition", d.definition}};
  }
  json["unmatched"] = evaluation.unmatched;
  return record::document(json);
}

}  // namespace mimicx::judge
