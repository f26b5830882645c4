#include "pipeline/options_folder.h"

#include <stdexcept>

#include "core/file.h"
#include "record/commit.h"
#include "record/outputs.h"
#include "record/utf8_names.h"

namespace mimicx::pipeline {
namespace {

std::string short_text(const record::Json& json) {
  constexpr std::size_t kMost = 60;
  const std::string text = json.dump();
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

/// The JSON of a file; null if it is no JSON.
record::Json json_or_null(const std::filesystem::path& path) {
  try {
    return record::Json::parse(read_file(path));
  } catch (const record::JsonError&) {
    return nullptr;
  }
}

/// The first member, by its path, in which two records differ: "settings/gamma is 0.9 there, 0.92 here".
/// Earlier budgets (`let_budget_grow`) are no difference.
std::string first_difference(const record::Json& there, const record::Json& here) {
  if (!there.is_object() || !here.is_object())
    return there == here ? "" : " is " + short_text(there) + " there, " + short_text(here) + " here";
  for (const auto& [name, value] : here.items())
    if (const std::string found = first_difference(there.value(name, record::Json()), value); !found.empty())
      return name + (found.starts_with(' ') ? "" : "/") + found;
  for (const auto& [name, value] : there.items())
    if (!here.contains(name) && name != "earlier_samples")
      return name + " is " + short_text(value) + " there, not set here";
  return {};
}

void write_options_manifest(const record::RunFolder& folder, const record::Json& manifest) {
  write_file_atomically(folder.manifest(), manifest.dump(1) + "\n");
}

}  // namespace

void claim_options(const record::RunFolder& folder, const std::vector<std::string>& files, bool force) {
  record::Outputs outputs(files, force);
  const bool continued = std::filesystem::exists(folder.manifest());
  const auto claim = [&](const std::filesystem::path& path, std::string_view opening) {
    continued ? outputs.claim_own(path) : outputs.claim(path, opening);
  };
  claim(folder.manifest(), record::kJsonOpening);
  claim(folder.root / "clusters.json", record::kJsonOpening);
  claim(folder.root / "options.npz", {});
}

bool let_budget_grow(const record::RunFolder& folder, record::Json& record) {
  if (!std::filesystem::exists(folder.manifest())) return false;
  const record::Json there = json_or_null(folder.manifest()).value("run", nullptr);
  try {
    const auto before = there.at("samples").get<std::int64_t>(),
               now = record.at("samples").get<std::int64_t>();
    record::Json same = record;
    same["samples"] = before;
    if (before > now || !first_difference(there, same).empty()) return false;
    record::Json earlier = there.value("earlier_samples", record::Json::array());
    if (before < now) earlier.push_back(before);
    if (!earlier.elements().empty()) record["earlier_samples"] = earlier;
    return before < now;
  } catch (const record::JsonError&) {
    return false;  // another run: `finished_outcome` names the difference
  }
}

std::optional<record::RunOutcome> finished_outcome(const record::RunFolder& folder,
                                                   const record::Json& record) {
  if (!std::filesystem::exists(folder.manifest())) return std::nullopt;
  const record::Json there = json_or_null(folder.manifest());
  const std::string difference = first_difference(there.value("run", nullptr), record);
  if (!difference.empty())
    throw std::invalid_argument(folder.root.string() + " holds another pre-training (" + difference +
                                "): give another folder, or remove it first");
  const std::filesystem::path options = folder.root / "options.npz";
  if (!std::filesystem::exists(options) || there.value("checksum", "") != record::file_checksum(options))
    return std::nullopt;
  for (const record::Json& input : there.at("inputs").elements())
    if (input.at("status") != "ok") return record::RunOutcome::kSomeFailed;
  return record::RunOutcome::kAllGood;
}

std::string identity_of_option(record::Json record, const std::vector<std::string>& members) {
  for (const char* budget : {"samples", "earlier_samples"}) record[budget] = nullptr;
  record::Json names = record::Json::array();
  for (const std::string& member : members) names.push_back(record::to_utf8(member));
  record["members"] = names;
  return record::checksum(record.dump());
}

void begin_options(const record::RunFolder& folder, const record::Json& record) {
  folder.create();
  write_options_manifest(folder, {{"run", record}, {"commit", record::commit()}});
}

void finish_options(const record::RunFolder& folder, const options::OptionSet& set,
                    const record::Json& record, const record::Json& inputs, const record::Json& trained) {
  const std::filesystem::path file = folder.root / "options.npz";
  options::write_options(file, set);
  write_options_manifest(folder, {{"run", record},
                                  {"commit", record::commit()},
                                  {"inputs", inputs},
                                  {"options", trained},
                                  {"checksum", record::file_checksum(file)}});
}

}  // namespace mimicx::pipeline
