#include "record/outputs.h"

#include <fstream>
#include <system_error>

#include "core/npz/npz.h"

namespace mimicx::record {
namespace {

bool is_own_archive(const std::filesystem::path& path) {
  try {
    const std::string bytes = read_file(path);
    return format_npz(parse_npz(bytes, path.string())) == bytes;
  } catch (const std::exception&) {  // no archive at all
    return false;
  }
}

bool is_there(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::exists(path, none);
}

}  // namespace

bool is_own_file(const std::filesystem::path& path, std::string_view opening, std::size_t at) {
  return opening.empty() ? is_own_archive(path) : read_bytes(path, at, opening.size()) == opening;
}

Outputs::Outputs(const std::vector<std::string>& inputs, bool force) : force_(force) {
  for (const std::string& input : inputs) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(input, error);
    if (!error) inputs_.insert(path);  // a missing input cannot be overwritten
  }
}

void Outputs::claim(const std::filesystem::path& path, std::string_view opening, std::size_t at) {
  if (path.empty()) return;
  claim_new(path);
  if (force_ || !is_there(path) || is_own_file(path, opening, at)) return;
  throw OutputRefused(path.string() + " exists and was not written by this program: --force overwrites it");
}

void Outputs::claim_own(const std::filesystem::path& path) { claim_new(path); }

void Outputs::claim_new(const std::filesystem::path& path) {
  std::error_code error;
  if (!claimed_.insert(std::filesystem::absolute(path, error).lexically_normal()).second)
    throw OutputRefused(path.string() + " would be written twice");
  if (!is_there(path)) return;
  if (inputs_.contains(std::filesystem::canonical(path, error)))
    throw OutputRefused(path.string() + " is an input: it would be overwritten");
  if (!std::filesystem::is_regular_file(path, error))
    throw OutputRefused(path.string() + " is no regular file");
}

}  // namespace mimicx::record
