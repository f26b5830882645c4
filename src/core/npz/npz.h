/// NumPy archives: reads npz files as NumPy writes them, and writes npz files that NumPy reads.
///
/// An npz file is a zip of npy members, stored or deflated. Archives are written (npz_archive.h) to a
/// temporary name and renamed. Deflated members need zlib (absent in the core-only build).
///
/// Format: PKWARE APPNOTE 6.3 (zip); the members are those of npy.h. Not supported: encrypted or split
/// archives, archives of 4 GiB and more.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/npz/npy.h"
#include "core/npz/npz_archive.h"

namespace mimicx {

/// Reads the arrays of an archive. Members whose name does not end in ".npy" are ignored.
/// @param keys  which members to read; none: all
/// @throws DataError for anything that is not a readable archive; never allocates more than `max_bytes` for
///         its members, whatever their headers declare.
Npz read_npz(const std::filesystem::path& path, std::size_t max_bytes = kMaxMemberBytes,
             const std::vector<std::string>& keys = {});
/// The same from bytes in memory. @param path  for messages
Npz parse_npz(const std::string& bytes, const std::string& path, std::size_t max_bytes = kMaxMemberBytes,
              const std::vector<std::string>& keys = {});
void write_npz(const std::filesystem::path& path, const Npz& archive);

}  // namespace mimicx
