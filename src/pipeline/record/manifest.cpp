#include "pipeline/record/manifest.h"

#include <algorithm>

#include "core/error.h"
#include "core/file.h"
#include "pipeline/record/names.h"
#include "pipeline/record/sequence_json.h"

namespace mimicx::pipeline::record {
namespace {

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
