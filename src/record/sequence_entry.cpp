#include "record/sequence_entry.h"

#include <algorithm>
#include <string_view>

#include "core/containers.h"
#include "record/run_folder.h"
#include "record/utf8_names.h"

namespace mimicx::record {
namespace {

constexpr Array<std::string_view, 7> kEndings = {"none",          "budget",   "threshold", "stall",
                                                 "limit-seconds", "followed", "lost"};

Json checksums_json(const FileChecksums& files) {
  Json json = Json::object();
  for (const auto& [name, checksum] : files) json[to_utf8(name)] = checksum;
  return json;
}

Json worse_json(const std::vector<Worsening>& worse) {
  Json json = Json::array();
  for (const Worsening& w : worse)
    json.push_back({{"measure", w.measure}, {"numbers", w.numbers}, {"frames", w.frames}, {"why", w.why}});
  return json;
}

std::vector<Worsening> worse_of(const Json& json) {
  std::vector<Worsening> worse;
  for (const Json& w : json.elements())
    worse.push_back({w.at("measure").get<std::string>(), w.at("numbers").get<std::string>(),
                     w.at("frames").get<std::vector<std::array<int, 2>>>(), w.at("why").get<std::string>()});
  return worse;
}

SequenceEnding ending_of(const std::string& name) {
  const auto found = std::find(kEndings.begin(), kEndings.end(), name);
  if (found == kEndings.end()) throw JsonError("an ending '" + name + "'");
  return static_cast<SequenceEnding>(found - kEndings.begin());
}

}  // namespace

std::string in_words(const Worsening& worsening) {
  std::string text = worsening.measure + " " + worsening.numbers + ", most at frames";
  const char* between = " ";
  for (const auto& [first, last] : worsening.frames) {
    text += between + std::to_string(first) + (last > first ? "-" + std::to_string(last) : "");
    between = ", ";
  }
  return text + ": " + worsening.why;
}

bool SequenceEntry::spent_its_budget() const {
  if (samples == 0 || training_ending != SequenceEnding::kNone) return false;
  const bool beside_a_plan = ending == SequenceEnding::kLost || ending == SequenceEnding::kFollowed;
  return ending == SequenceEnding::kBudget || (beside_a_plan && !ok);
}

std::string parts_in_words(const SequenceEntry& entry) {
  std::string text;
  int k = 0;
  for (const auto& [first, last] : entry.parts) {
    text += k == 0 ? "followed in part, as motions of their own: frames " : ", frames ";
    text += std::to_string(first) + "-" + std::to_string(last) + " in " +
            RunFolder::motion_name(RunFolder::part_name(entry.name, ++k), true);
  }
  return text;
}

Json to_json(const SequenceEntry& e) {
  Json json = {{"name", to_utf8(e.name)},
               {"input", to_utf8(e.input)},
               {"input_checksum", e.input_checksum},
               {"output", e.output.empty() ? Json(nullptr) : Json(to_utf8(e.output))},
               {"status", e.ok ? "ok" : "failed"},
               {"reason", e.reason},
               {"parts", e.parts},
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
               {"policy", to_json(e.policy)},
               {"fit", to_json(e.fit)},
               {"input_metrics", to_json(e.input_metrics)},
               {"metrics_before", to_json(e.metrics_before)},
               {"ok_before", e.ok_before},
               {"metrics", to_json(e.metrics)},
               {"worse", worse_json(e.worse)},
               {"audit", to_json(e.audit)},
               {"preparation", to_json(e.preparation)},
               {"feasibility", to_json(e.feasibility)},
               {"decisions", e.decisions},
               {"notes", e.notes},
               {"files", checksums_json(e.files)}};
  if (e.training_ending != SequenceEnding::kNone)
    json["training_ending"] = kEndings[static_cast<int>(e.training_ending)];
  return json;
}

SequenceEntry entry_of(const Json& json) {
  SequenceEntry e;
  e.name = from_utf8(json.at("name").get<std::string>());
  e.input = from_utf8(json.at("input").get<std::string>());
  e.input_checksum = json.at("input_checksum").get<std::string>();
  if (!json.at("output").is_null()) e.output = from_utf8(json.at("output").get<std::string>());
  e.ok = json.at("status") == "ok";
  e.reason = json.at("reason").get<std::string>();
  if (json.contains("parts")) e.parts = json.at("parts").get<std::vector<std::array<int, 2>>>();  // as below
  e.method = json.value("method", "").get<std::string>();
  e.ending = ending_of(json.at("ending").get<std::string>());
  if (json.contains("training_ending"))
    e.training_ending = ending_of(json.at("training_ending").get<std::string>());
  e.frames = json.at("frames");
  e.fps = json.at("fps");
  e.seed = json.at("seed");
  e.samples = json.at("samples");
  e.reward_before = number_or_nan(json.at("reward_before"));
  e.reward_after = number_or_nan(json.at("reward_after"));
  e.arrangement = json.at("arrangement").get<std::vector<std::array<int, 2>>>();
  if (json.contains("plan")) e.plan = named_values(json.at("plan"));
  if (json.contains("policy")) e.policy = named_values(json.at("policy"));  // older manifests have none
  e.fit = named_values(json.at("fit"));
  e.metrics_before = named_values(json.at("metrics_before"));
  e.ok_before = json.at("ok_before");
  e.input_metrics = named_values(json.at("input_metrics"));
  e.metrics = named_values(json.at("metrics"));
  if (json.contains("worse")) e.worse = worse_of(json.at("worse"));      // as above
  if (json.contains("audit")) e.audit = named_values(json.at("audit"));  // as above
  e.preparation = named_values(json.at("preparation"));
  if (json.contains("feasibility")) e.feasibility = named_values(json.at("feasibility"));  // as above
  e.decisions = json.value("decisions", Json::array()).get<std::vector<std::string>>();
  e.notes = json.at("notes").get<std::vector<std::string>>();
  if (json.contains("files"))  // as above
    for (const auto& [name, checksum] : json.at("files").items())
      e.files.emplace_back(from_utf8(name), checksum.get<std::string>());
  return e;
}

}  // namespace mimicx::record
