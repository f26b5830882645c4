#include "pipeline/record/timing.h"

#include "core/file.h"
#include "pipeline/record/json.h"
#include "pipeline/record/names.h"

namespace mimicx::pipeline::record {

std::string format_timing(const std::vector<Timing>& timings, const std::vector<SequenceEntry>& sequences) {
  Json list = Json::array();
  for (const auto& t : timings) {
    Json json = {{"name", to_utf8(t.name)},
                 {"seconds", t.seconds},
                 {"planning_seconds", t.planning_seconds},
                 {"training_seconds", t.training_seconds},
                 {"threads", t.threads}};
    for (const auto& e : sequences)
      if (e.name == t.name && t.training_seconds > 0.0)
        json["samples_per_second"] = static_cast<double>(e.samples) / t.training_seconds;
    list.push_back(json);
  }
  return Json({{"sequences", list}}).dump(1) + "\n";
}

std::vector<Timing> read_timing(const std::filesystem::path& path) {
  std::vector<Timing> timings;
  if (!std::filesystem::exists(path)) return timings;
  try {
    const Json json = Json::parse(read_file(path));
    for (const Json& t : json.at("sequences").elements())
      timings.push_back({from_utf8(t.value("name", "").get<std::string>()), t.value("seconds", 0.0),
                         t.value("planning_seconds", 0.0), t.value("training_seconds", 0.0),
                         t.value("threads", 0)});
  } catch (const JsonError&) {
    timings.clear();
  }
  return timings;
}

}  // namespace mimicx::pipeline::record
