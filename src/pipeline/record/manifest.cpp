#include "pipeline/record/manifest.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/file.h"
#include "pipeline/record/names.h"
#include "pipeline/record/sequence_json.h"
#include "pipeline/record/table.h"

namespace mimicx::pipeline::record {
namespace {

/// Every setting by its name, as text.
std::vector<std::pair<std::string, std::string>> texts_of(const Manifest& m) {
  std::vector<std::pair<std::string, std::string>> texts = {{"version", m.version},
                                                            {"instruction set", m.target},
                                                            {"method", m.method},
                                                            {"seed", std::to_string(m.seed)},
                                                            {"samples", std::to_string(m.samples)},
                                                            {"options", m.options},
                                                            {"reading", m.reading}};
  for (const auto& [name, value] : m.settings) texts.emplace_back(name, format_number(value));
  return texts;
}

}  // namespace

std::vector<std::string> Manifest::differences(const Manifest& there, bool but_samples) const {
  std::vector<std::string> found;
  std::map<std::string, std::string> others;
  for (const auto& [name, text] : texts_of(there)) others[name] = text;
  const auto shown = [](const std::string& text) { return text.empty() ? std::string("none") : text; };
  for (const auto& [name, text] : texts_of(*this)) {
    const std::string other = others.contains(name) ? others.at(name) : "not set";
    if (other != text && !(but_samples && name == "samples"))
      found.push_back(name + " is " + shown(other) + " there, " + shown(text) + " here");
    others.erase(name);
  }
  for (const auto& [name, text] : others)
    found.push_back(name + " is " + shown(text) + " there, not set here");
  return found;
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
