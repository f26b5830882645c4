#include "record/manifest.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/file.h"
#include "record/commit.h"
#include "record/sequence_entry.h"
#include "record/table.h"
#include "record/utf8_names.h"

namespace mimicx::record {
namespace {

constexpr std::size_t kDifferencesSaid = 4;  ///< that a message names

/// Every setting by its name, as text.
std::vector<std::pair<std::string, std::string>> texts_of(const Manifest& m) {
  std::vector<std::pair<std::string, std::string>> texts = {{"version", m.version},
                                                            {"arithmetic", m.target},
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

void Manifest::order(const std::vector<std::string>& inputs) {
  std::map<std::string, std::size_t> place;
  for (const std::string& input : inputs) place.emplace(input, place.size() + 1);
  const auto place_of = [&](const SequenceEntry& entry) {
    const auto found = place.find(entry.input);
    return found == place.end() ? std::size_t{0} : found->second;
  };
  std::stable_sort(sequences.begin(), sequences.end(),
                   [&](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
}

std::string in_words(const std::vector<std::string>& differences) {
  std::string said;
  for (std::size_t k = 0; k < std::min(differences.size(), kDifferencesSaid); ++k)
    said += (k > 0 ? "; " : "") + differences[k];
  if (differences.size() > kDifferencesSaid)
    said += "; and " + std::to_string(differences.size() - kDifferencesSaid) + " more";
  return said;
}

Json run_json(const Manifest& manifest) {
  return {{"version", manifest.version},
          {"target", manifest.target},
          {"seed", manifest.seed},
          {"samples", manifest.samples},
          {"method", manifest.method},
          {"options", manifest.options},
          {"reading", to_utf8(manifest.reading)},
          {"settings", to_json(manifest.settings)}};
}

Manifest run_of(const Json& run) {
  Manifest manifest;
  manifest.version = run.at("version").get<std::string>();
  manifest.target = run.at("target").get<std::string>();
  manifest.seed = run.at("seed");
  manifest.samples = run.at("samples");
  manifest.method = run.value("method", "").get<std::string>();
  manifest.options = run.at("options").get<std::string>();
  manifest.reading = from_utf8(run.value("reading", "").get<std::string>());
  manifest.settings = named_values(run.at("settings"));
  return manifest;
}

std::string format_manifest(const Manifest& manifest) {
  const Json json = {{"run", run_json(manifest)}, {"commit", commit()}, {"sequences", Json::array()}};
  std::string text = json.dump(1);
  if (manifest.sequences.empty()) return text + "\n";
  text.resize(
      text.rfind(']'));  // entry by entry: the JSON tree of 10,000 entries would take most of the memory
  for (const SequenceEntry& e : manifest.sequences) {
    text += &e == &manifest.sequences.front() ? "\n  " : ",\n  ";
    for (const char c : to_json(e).dump(1)) {
      text += c;
      if (c == '\n') text += "  ";
    }
  }
  return text + "\n ]\n}\n";
}

Manifest read_manifest(const std::filesystem::path& path) { return parse_manifest(read_file(path), path); }

Manifest parse_manifest(const std::string& text, const std::filesystem::path& path) {
  try {
    const Json json = Json::parse(text);
    if (json.contains("options") && !json.contains("sequences"))
      throw DataError(path.string(), "", "the manifest of a run over motions",
                      "that of trained options (mimicx pretrain or teach)");
    Manifest manifest = run_of(json.at("run"));
    for (const Json& e : json.at("sequences").elements()) manifest.sequences.push_back(entry_of(e));
    return manifest;
  } catch (const JsonError& error) {
    throw DataError(path.string(), "", "the manifest of a run", error.what());
  }
}

}  // namespace mimicx::record
