#include "core/npz/npz_archive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/npz/npy.h"
#include "core/npz/zip_format.h"
#include "core/number_text.h"

namespace mimicx {
namespace {

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>((value >> (8 * i)) & 0xFF);
}

/// The fields that local and central header share, from "version needed" to the length of the extra field.
std::string common_fields(const std::string& name, const std::string& content) {
  const bool ascii =
      std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
  std::string out;
  put(out, 20, 2);                    // version needed: 2.0
  put(out, ascii ? 0 : 1u << 11, 2);  // flags: the name is UTF-8
  put(out, kStored, 2);
  put(out, 0, 2);  // time
  put(out, kDosDate, 2);
  put(out, crc32_of(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()), 4);
  put(out, content.size(), 4);
  put(out, content.size(), 4);
  put(out, name.size(), 2);
  put(out, 0, 2);
  return out;
}

}  // namespace

bool Npz::has(const std::string& key) const {
  return std::any_of(members_.begin(), members_.end(), [&](const auto& m) { return m.first == key; });
}

const NpyArray& Npz::at(const std::string& key) const {
  for (const auto& [name, array] : members_)
    if (name == key) return array;
  for (const auto& [name, why] : unsupported_)
    if (name == key) raise(why);
  std::string names;
  for (const auto& [name, array] : members_) names += (names.empty() ? "" : ", ") + name;
  raise(DataError(path, "", "member '" + key + "'", names.empty() ? "none at all" : "only " + names));
}

void Npz::set(const std::string& key, NpyArray array) {
  for (auto& [name, old] : members_)
    if (name == key) {
      old = std::move(array);
      return;
    }
  members_.emplace_back(key, std::move(array));
}

void Npz::set_unsupported(const std::string& key, UnsupportedArray why) {
  unsupported_.emplace_back(key, std::move(why));
}

double number_at(const Npz& archive, const std::string& key) {
  const NpyArray& array = archive.at(key);
  if (array.type == NpyArray::Type::kText) raise(DataError(archive.path, key, "a number", "text"));
  if (array.size() != 1)
    raise(DataError(archive.path, key, "one number", std::to_string(array.size()) + " of them"));
  return array.to_double().front();
}

std::int64_t whole_number_at(const Npz& archive, const std::string& key) {
  const double value = number_at(archive, key);
  if (!(std::abs(value) <= 0x1p53) || value != std::floor(value))
    raise(DataError(archive.path, key, "a whole number", text_of(value)));
  return static_cast<std::int64_t>(value);
}

std::vector<double> numbers_at(const Npz& archive, const std::string& key, std::size_t count) {
  const NpyArray& array = archive.at(key);
  const bool text = array.type == NpyArray::Type::kText;
  if (text || array.size() != count)
    raise(DataError(archive.path, key, std::to_string(count) + " numbers",
                    text ? "text" : std::to_string(array.size())));
  return array.to_double();
}

const std::string& text_at(const Npz& archive, const std::string& key) {
  const NpyArray& array = archive.at(key);
  if (array.text.size() != 1)
    raise(DataError(
        archive.path, key, "one text",
        array.type == NpyArray::Type::kText ? std::to_string(array.text.size()) + " of them" : "numbers"));
  return array.text.front();
}

std::string format_npz(const Npz& archive) {
  std::string out, directory;
  for (const auto& [key, array] : archive.members()) {
    const std::string name = key + ".npy", content = format_npy(array);
    const std::string fields = common_fields(name, content);
    put(directory, kCentralHeader, 4);
    put(directory, (3u << 8) | 20, 2);  // made on Unix, version 2.0
    directory += fields;
    put(directory, 0, 2 + 2 + 2);       // comment length, disk, internal attributes
    put(directory, 0100644u << 16, 4);  // a plain file, rw-r--r--
    put(directory, out.size(), 4);
    directory += name;
    put(out, kLocalHeader, 4);
    out += fields + name + content;
    if (out.size() + directory.size() >= kSaturated32 || archive.members().size() >= 0xFFFF)
      raise(std::invalid_argument("format_npz: archives of 4 GiB or 65535 members are not written"));
  }
  const std::uint64_t count = archive.members().size(), start = out.size();
  out += directory;
  put(out, kEndOfDirectory, 4);
  put(out, 0, 2 + 2);  // this disk, disk of the directory
  put(out, count, 2);
  put(out, count, 2);
  put(out, directory.size(), 4);
  put(out, start, 4);
  put(out, 0, 2);  // comment
  return out;
}

}  // namespace mimicx
