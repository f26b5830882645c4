/// Archives with one damaged member and valid zip checksums.
///
/// An input is the name of a member, a line break, and the npy file that replaces it; without a file the
/// member is removed. The input goes to the readers of all archives with such a member.
#pragma once

#include <string>
#include <vector>

#include "core/npz/npz.h"

namespace mimicx::fuzz {

struct Archive {
  Npz sound;                 ///< small and valid
  void (*read)(const Npz&);  ///< its reader; a `DataError` is for `feed_member` to catch
};

/// @throws DataError if an archive is not valid: it would be useless as a seed
inline std::vector<std::string> seeds_of(const std::vector<Archive>& archives) {
  std::vector<std::string> seeds;
  for (const Archive& archive : archives) archive.read(archive.sound);
  for (const Archive& archive : archives)
    for (const auto& [name, array] : archive.sound.members())
      seeds.push_back(name + "\n" + format_npy(array));
  return seeds;
}

/// The archive with the member replaced or removed.
inline Npz with_member(const Npz& sound, const std::string& name, const std::string& npy) {
  Npz damaged;
  damaged.path = "fuzz.npz";
  for (const auto& [key, array] : sound.members()) {
    if (key != name)
      damaged.set(key, array);
    else if (!npy.empty())
      damaged.set(key, parse_npy(reinterpret_cast<const std::uint8_t*>(npy.data()), npy.size(), "fuzz", key));
  }
  return damaged;
}

inline void feed_member(const std::vector<Archive>& archives, const std::string& bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string name = bytes.substr(0, end), npy = bytes.substr(std::min(end + 1, bytes.size()));
  for (const Archive& archive : archives)
    if (archive.sound.has(name)) try {
        archive.read(with_member(archive.sound, name, npy));
      } catch (const DataError&) {
      }
}

}  // namespace mimicx::fuzz
