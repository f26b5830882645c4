#include "pipeline/record/manifest.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/containers.h"
#include "core/error.h"
#include "pipeline/record/json.h"
#include "pipeline/record/names.h"
#include "pipeline/record/run_folder.h"

namespace mimicx::pipeline::record {
namespace {

constexpr Array<std::string_view, 7> kEndings = {"none",          "budget",   "threshold", "stall",
                                                 "limit-seconds", "followed", "lost"};

double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json to_json(const NamedValues& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = number(value);
  return json;
}

Json to_json(const FileChecksums& files) {
  Json json = Json::object();
  for (const auto& [name, checksum] : files) json[to_utf8(name)] = checksum;
  return json;
}

NamedValues named_values(const Json& json) {
  NamedValues values;
  for (const auto& [name, value] : json.items()) values.emplace_back(name, number(value));
  return values;
}

Json to_json(const SequenceEntry& e) {
  return {{"name", to_utf8(e.name)},
          {"input", to_utf8(e.input)},
          {"input_checksum", e.input_checksum},
          {"output", e.output.empty() ? Json(nullptr) : Json(to_utf8(e.output))},
          {"status", e.ok ? "ok" : "failed"},
          {"reason", e.reason},
          {"method", e.method},
          {"ending", kEndings[static_cast<int>(e.ending)]},
          {"frames", e.frames},
          {"fps", e.fps},
          {"seed", e.seed},
          {"samples", e.samples},
          {"reward_before", number(e.reward_before)},
          {"reward_after", number(e.reward_after)},
          {"arrangement", e.arrangement},
          {"plan", to_json(e.plan)},
          {"fit", to_json(e.fit)},
          {"input_metrics", to_json(e.input_metrics)},
          {"metrics_before", to_json(e.metrics_before)},
          {"ok_before", e.ok_before},
          {"metrics", to_json(e.metrics)},
          {"audit", to_json(e.audit)},
          {"preparation", to_json(e.preparation)},
          {"feasibility", to_json(e.feasibility)},
          {"decisions", e.decisions},
          {"notes", e.notes},
          {"files", to_json(e.files)}};
}

Ending ending_of(const std::string& name) {
  const auto found = std::find(kEndings.begin(), kEndings.end(), name);
  return static_cast<Ending>(found - kEndings.begin());
}

SequenceEntry entry_of(const Json& json) {
  SequenceEntry e;
  e.name = from_utf8(json.at("name").get<std::string>());
  e.input = from_utf8(json.at("input").get<std::string>());
  e.input_checksum = json.at("input_checksum").get<std::string>();
  if (!json.at("output").is_null()) e.output = from_utf8(json.at("output").get<std::string>());
  e.ok = json.at("status") == "ok";
  e.reason = json.at("reason").get<std::string>();
  e.method = json.value("method", "").get<std::string>();
  e.ending = ending_of(json.at("ending").get<std::string>());
  e.frames = json.at("frames");
  e.fps = json.at("fps");
  e.seed = json.at("seed");
  e.samples = json.at("samples");
  e.reward_before = number(json.at("reward_before"));
  e.reward_after = number(json.at("reward_after"));
  e.arrangement = json.at("arrangement").get<std::vector<std::array<int, 2>>>();
  if (json.contains("plan")) e.plan = named_values(json.at("plan"));
  e.fit = named_values(json.at("fit"));
  e.metrics_before = named_values(json.at("metrics_before"));
  e.ok_before = json.at("ok_before");
  e.input_metrics = named_values(json.at("input_metrics"));
  e.metrics = named_values(json.at("metrics"));
  if (json.contains("audit")) e.audit = named_values(json.at("audit"));  // older manifests have none
  e.preparation = named_values(json.at("preparation"));
  if (json.contains("feasibility")) e.feasibility = named_values(json.at("feasibility"));  // as above
  e.decisions = json.value("decisions", Json::array()).get<std::vector<std::string>>();
  e.notes = json.at("notes").get<std::vector<std::string>>();
  if (json.contains("files"))  // as above
    for (const auto& [name, checksum] : json.at("files").items())
      e.files.emplace_back(from_utf8(name), checksum.get<std::string>());
  return e;
}

bool same(const NamedValues& a, const NamedValues& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

bool Manifest::same_settings(const Manifest& other) const {
  return version == other.version && target == other.target && seed == other.seed &&
         samples == other.samples && method == other.method && options == other.options &&
         reading == other.reading && same(settings, other.settings);
}

const SequenceEntry* Manifest::find(const std::string& input) const {
  const auto found =
      std::find_if(sequences.begin(), sequences.end(), [&](const auto& e) { return e.input == input; });
  return found == sequences.end() ? nullptr : &*found;
}

void Manifest::put(const SequenceEntry& entry) {
  for (auto& e : sequences) {
    if (e.input != entry.input) continue;
    e = entry;
    return;
  }
  sequences.push_back(entry);
}

std::string format_manifest(const Manifest& manifest) {
  Json json = {{"run",
                {{"version", manifest.version},
                 {"target", manifest.target},
                 {"seed", manifest.seed},
                 {"samples", manifest.samples},
                 {"method", manifest.method},
                 {"options", manifest.options},
                 {"reading", to_utf8(manifest.reading)},
                 {"settings", to_json(manifest.settings)}}},
               {"sequences", Json::array()}};
  for (const auto& e : manifest.sequences) json["sequences"].push_back(to_json(e));
  return json.dump(1) + "\n";
}

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    const Json& run = json.at("run");
    Manifest manifest;
    manifest.version = run.at("version").get<std::string>();
    manifest.target = run.at("target").get<std::string>();
    manifest.seed = run.at("seed");
    manifest.samples = run.at("samples");
    manifest.method = run.value("method", "").get<std::string>();
    manifest.options = run.at("options").get<std::string>();
    manifest.reading = from_utf8(run.value("reading", "").get<std::string>());
    manifest.settings = named_values(run.at("settings"));
    for (const Json& e : json.at("sequences").elements()) manifest.sequences.push_back(entry_of(e));
    return manifest;
  } catch (const JsonError& error) {
    throw DataError(path.string(), "", "the manifest of a run", error.what());
  }
}

}  // namespace mimicx::pipeline::record
