#include "record/timing.h"

#include <map>

#include "core/file.h"
#include "record/utf8_names.h"

namespace mimicx::record {

Json to_json(const Timing& t) {
  return {{"name", to_utf8(t.name)},
          {"seconds", t.seconds},
          {"planning_seconds", t.planning_seconds},
          {"training_seconds", t.training_seconds},
          {"threads", t.threads}};
}

Timing timing_of(const Json& json) {
  return {from_utf8(json.value("name", "").get<std::string>()), json.value("seconds", 0.0),
          json.value("planning_seconds", 0.0), json.value("training_seconds", 0.0), json.value("threads", 0)};
}

std::string format_timing(const std::vector<Timing>& timings, const std::vector<SequenceEntry>& sequences) {
  std::map<std::string, std::int64_t> samples;
  for (const SequenceEntry& e : sequences) samples[e.name] = e.samples;
  Json list = Json::array();
  for (const Timing& t : timings) {
    Json json = to_json(t);
    if (const auto found = samples.find(t.name); found != samples.end() && t.training_seconds > 0.0)
      json["samples_per_second"] = static_cast<double>(found->second) / t.training_seconds;
    list.push_back(json);
  }
  return Json({{"sequences", list}}).dump(1) + "\n";
}

std::vector<Timing> read_timing(const std::filesystem::path& path) {
  return std::filesystem::exists(path) ? parse_timing(read_file(path)) : std::vector<Timing>();
}

std::vector<Timing> parse_timing(const std::string& text) {
  std::vector<Timing> timings;
  try {
    const Json json = Json::parse(text);
    for (const Json& t : json.at("sequences").elements()) timings.push_back(timing_of(t));
  } catch (const JsonError&) {
    timings.clear();
  }
  return timings;
}

}  // namespace mimicx::record
