#include "record/journal.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/file.h"
#include "record/sequence_entry.h"

namespace mimicx::record {
namespace {

void put(const Timing& timing, std::vector<Timing>& timings) {
  const auto there =
      std::find_if(timings.begin(), timings.end(), [&](const Timing& t) { return t.name == timing.name; });
  if (there == timings.end())
    timings.push_back(timing);
  else
    *there = timing;
}

}  // namespace

void Journal::append(const SequenceEntry& entry, const Timing& timing) {
  errno = 0;
  if (!out_.is_open()) out_.open(path_, std::ios::binary | std::ios::trunc);
  out_ << Json({{"sequence", to_json(entry)}, {"timing", to_json(timing)}}).dump() << '\n' << std::flush;
  if (!out_)
    throw DataError(path_.string(), "", "a writable file",
                    std::generic_category().message(errno == 0 ? EIO : errno));
}

void Journal::clear() {
  out_.close();
  out_.clear();
  std::error_code none;
  std::filesystem::remove(path_, none);
}

void replay_journal(const std::filesystem::path& path, Manifest& manifest, std::vector<Timing>& timings) {
  if (std::filesystem::exists(path)) replay_lines(read_file(path), path, manifest, timings);
}

void replay_lines(const std::string& text, const std::filesystem::path& path, Manifest& manifest,
                  std::vector<Timing>& timings) {
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) try {
      const Json line = Json::parse(text.substr(begin, end - begin));
      manifest.put(entry_of(line.at("sequence")));
      put(timing_of(line.at("timing")), timings);
    } catch (const JsonError& error) {
      throw DataError(path.string(), "", "the journal of a run", error.what());
    }
}

}  // namespace mimicx::record
