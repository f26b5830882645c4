#include "run/run_outputs.h"

#include <system_error>

#include "files/clean_copy.h"
#include "import/motion_file.h"

namespace mimicx::run {

std::filesystem::path copy_beside(const std::filesystem::path& input) {
  return input.parent_path() / (input.stem().string() + ".clean" + files::clean_suffix(input));
}

void claim_copies_beside(const std::vector<std::string>& inputs, bool force) {
  record::Outputs outputs(inputs, force);
  for (const std::string& input : inputs) {
    const std::filesystem::path copy = copy_beside(input);
    outputs.claim(copy, import::written_opening(copy));
  }
}

std::vector<std::string> as_recorded(const std::vector<std::string>& inputs,
                                     const record::Manifest& manifest) {
  std::map<std::filesystem::path, std::string> recorded;
  const auto key = [](const std::string& input) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(input, error);
    return error ? std::filesystem::path(input) : path;
  };
  for (const record::SequenceEntry& entry : manifest.sequences)
    recorded.emplace(key(entry.input), entry.input);
  std::vector<std::string> spelled;
  for (const std::string& input : inputs) {
    const auto found = recorded.find(key(input));
    spelled.push_back(found == recorded.end() ? input : found->second);
  }
  return spelled;
}

std::map<std::string, std::string> sequence_names(const std::vector<std::string>& inputs,
                                                  const std::map<std::string, std::string>& wanted,
                                                  const record::Manifest& manifest) {
  std::map<std::string, std::string> names;
  std::set<std::string> taken;
  for (const record::SequenceEntry& entry : manifest.sequences) {
    names[entry.input] = entry.name;
    record::reserve_motion_name(entry.name, taken);
  }
  for (const std::string& input : inputs) {
    if (names.contains(input)) continue;
    const auto found = wanted.find(input);
    const std::string name =
        found == wanted.end() ? std::filesystem::path(input).stem().string() : found->second;
    names[input] = record::unique_motion_name(name, taken);
  }
  return names;
}

void claim_run(const record::RunFolder& folder, const std::map<std::string, std::string>& names,
               bool continued, record::Outputs& outputs) {
  const auto claim = [&](const std::filesystem::path& path) {
    std::error_code none;
    if (std::filesystem::is_directory(path, none)) return;  // its sequence will fail with the reason
    continued ? outputs.claim_own(path) : outputs.claim(path);
  };
  for (const std::filesystem::path& path : {folder.manifest(), folder.journal(), folder.timing()})
    claim(path);
  if (!folder.is_part()) claim(folder.report());  // a shard has no report
  for (const auto& [input, name] : names) {
    for (const std::filesystem::path& path : folder.files_of(name)) claim(path);
    claim(folder.report_clip(name));
    claim(folder.clean(name, files::clean_suffix(input)));
  }
}

}  // namespace mimicx::run
