#include "core/npz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#ifdef MIMICX_WITH_ZLIB
#include <zlib.h>
#endif

namespace mimicx {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50, kEndOfDirectory = 0x06054b50;
constexpr std::size_t kLocalBytes = 30, kCentralBytes = 46, kEndBytes = 22;
constexpr std::uint64_t kSaturated32 = 0xFFFFFFFF;
constexpr std::uint16_t kStored = 0, kDeflated = 8;
constexpr std::uint32_t kDosDate = (0u << 9) | (1u << 5) | 1u;  ///< 1980-01-01; the time is 00:00
constexpr std::size_t kAlwaysUnpacked = std::size_t{1} << 28;   ///< bytes, whatever the archive's own size
constexpr std::size_t kMostRatio = 100;                         ///< of larger archives
constexpr std::size_t kMaxDeflateRatio = 1032;                  ///< of the deflate format itself

std::uint32_t crc32_of(const std::uint8_t* data, std::size_t size) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ (c & 1 ? 0xEDB88320u : 0u);
      t[i] = c;
    }
    return t;
  }();
  std::uint32_t c = 0xFFFFFFFF;
  for (std::size_t i = 0; i < size; ++i) c = table[(c ^ data[i]) & 0xFF] ^ (c >> 8);
  return ~c;
}

/// Bounds-checked little-endian reads from the archive.
class Bytes {
 public:
  Bytes(const std::string& data, const std::string& path) : data_(data), path_(path) {}

  std::size_t size() const { return data_.size(); }
  const std::uint8_t* block(std::uint64_t at, std::uint64_t length) const {
    if (at > data_.size() || length > data_.size() - at)
      fail("", "a complete zip archive", "the end of the file (truncated or damaged)");
    return reinterpret_cast<const std::uint8_t*>(data_.data()) + at;
  }
  std::uint64_t number(std::uint64_t at, int bytes) const {
    const std::uint8_t* p = block(at, static_cast<std::uint64_t>(bytes));
    std::uint64_t value = 0;
    for (int i = bytes; i-- > 0;) value = (value << 8) | p[i];
    return value;
  }
  [[noreturn]] void fail(const std::string& place, const std::string& expected,
                         const std::string& found) const {
    throw DataError(path_, place, expected, found);
  }
  const std::string& path() const { return path_; }

 private:
  const std::string& data_;
  const std::string& path_;
};

/// One member as the central directory describes it.
struct Entry {
  std::string name;
  std::uint64_t flags = 0, method = 0, crc = 0, packed = 0, unpacked = 0, local = 0;
  std::uint64_t next = 0;  ///< where the following entry of the directory starts
};

/// Zip64 extra field (id 1): 64-bit values, only of those fields that are saturated, in this order.
void read_zip64_extra(const Bytes& bytes, std::uint64_t at, std::uint64_t length, Entry& e) {
  const std::uint64_t end = at + length;
  while (at + 4 <= end) {
    const std::uint64_t id = bytes.number(at, 2), size = bytes.number(at + 2, 2);
    at += 4;
    if (id == 1) {
      std::uint64_t field = at;
      for (std::uint64_t* value : {&e.unpacked, &e.packed, &e.local}) {
        if (*value != kSaturated32 || field + 8 > std::min(at + size, end)) continue;
        *value = bytes.number(field, 8);
        field += 8;
      }
    }
    at += size;
  }
}

Entry read_entry(const Bytes& bytes, std::uint64_t at) {
  if (bytes.number(at, 4) != kCentralHeader) bytes.fail("", "a zip directory", "other content (damaged)");
  Entry e;
  e.flags = bytes.number(at + 8, 2);
  e.method = bytes.number(at + 10, 2);
  e.crc = bytes.number(at + 16, 4);
  e.packed = bytes.number(at + 20, 4);
  e.unpacked = bytes.number(at + 24, 4);
  const std::uint64_t name = bytes.number(at + 28, 2), extra = bytes.number(at + 30, 2);
  const std::uint64_t comment = bytes.number(at + 32, 2);
  e.local = bytes.number(at + 42, 4);
  const std::uint8_t* name_bytes = bytes.block(at + kCentralBytes, name);
  e.name.assign(name_bytes, name_bytes + name);
  read_zip64_extra(bytes, at + kCentralBytes + name, extra, e);
  e.next = at + kCentralBytes + name + extra + comment;
  return e;
}

std::vector<Entry> read_directory(const Bytes& bytes) {
  // The end record stands at the end of the file, before a comment of at most 65535 bytes.
  if (bytes.size() < kEndBytes)
    bytes.fail("", "an npz (zip) archive", std::to_string(bytes.size()) + " bytes");
  std::uint64_t end = bytes.size() - kEndBytes;
  const std::uint64_t lowest = end > 0xFFFF ? end - 0xFFFF : 0;
  while (bytes.number(end, 4) != kEndOfDirectory) {
    if (end == lowest)
      bytes.fail("", "an npz (zip) archive", "no zip directory (not a zip file, or truncated)");
    --end;
  }
  if (const std::uint64_t behind = bytes.size() - end - kEndBytes, comment = bytes.number(end + 20, 2);
      behind != comment)
    bytes.fail("", "the end of the archive behind its directory", std::to_string(behind) + " bytes more");
  const std::uint64_t count = bytes.number(end + 10, 2), size = bytes.number(end + 12, 4);
  std::uint64_t at = bytes.number(end + 16, 4);
  if (count == 0xFFFF || size == kSaturated32 || at == kSaturated32)
    bytes.fail("", "an archive under 4 GiB and 65535 members", "a zip64 directory, which is not read");
  std::vector<Entry> entries;
  std::uint64_t packed = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    entries.push_back(read_entry(bytes, at));
    at = entries.back().next;
    packed += std::min<std::uint64_t>(entries.back().packed, bytes.size() + 1);
    // Members sharing the same bytes are how small archives unpack to terabytes.
    if (packed > bytes.size())
      bytes.fail(entries.back().name, "members within the file", "overlapping members");
  }
  return entries;
}

#ifdef MIMICX_WITH_ZLIB
std::vector<std::uint8_t> inflated(const std::uint8_t* packed, const Entry& e, const Bytes& bytes) {
  if (e.unpacked / kMaxDeflateRatio > e.packed + 1)
    bytes.fail(e.name, "a size deflate can reach", std::to_string(e.unpacked) + " bytes");
  std::vector<std::uint8_t> out(e.unpacked);
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::runtime_error("zlib: inflateInit2 failed");
  // zlib counts in 32 bits; both sizes were checked to be under 4 GiB.
  stream.next_in = const_cast<Bytef*>(packed);
  stream.avail_in = static_cast<uInt>(e.packed);
  std::uint8_t nothing = 0;
  stream.next_out = out.empty() ? &nothing : out.data();
  stream.avail_out = static_cast<uInt>(e.unpacked);
  const int status = inflate(&stream, Z_FINISH);
  const auto produced = stream.total_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END || produced != e.unpacked)
    bytes.fail(e.name, std::to_string(e.unpacked) + " bytes after inflating", "damaged data");
  return out;
}
#else
std::vector<std::uint8_t> inflated(const std::uint8_t*, const Entry& e, const Bytes& bytes) {
  bytes.fail(e.name, "a stored member", "a deflated one (this build has no zlib)");
}
#endif

std::vector<std::uint8_t> read_member(const Bytes& bytes, const Entry& e) {
  if (e.flags & 1) bytes.fail(e.name, "a plain member", "an encrypted one");
  if (e.unpacked >= kSaturated32 || e.packed >= kSaturated32)
    bytes.fail(e.name, "a member under 4 GiB", std::to_string(e.unpacked) + " bytes");
  if (bytes.number(e.local, 4) != kLocalHeader) bytes.fail(e.name, "a zip member", "other content (damaged)");
  // The sizes of the local header may be missing (streamed archives): the directory's count.
  const std::uint64_t start =
      e.local + kLocalBytes + bytes.number(e.local + 26, 2) + bytes.number(e.local + 28, 2);
  const std::uint8_t* packed = bytes.block(start, e.packed);
  std::vector<std::uint8_t> out;
  if (e.method == kStored) {
    if (e.packed != e.unpacked) bytes.fail(e.name, "equal sizes of a stored member", "different ones");
    out.assign(packed, packed + e.packed);
  } else if (e.method == kDeflated) {
    out = inflated(packed, e, bytes);
  } else {
    bytes.fail(e.name, "a stored or deflated member", "compression method " + std::to_string(e.method));
  }
  if (crc32_of(out.data(), out.size()) != e.crc) bytes.fail(e.name, "a matching checksum", "damaged data");
  return out;
}

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
    if (name == key) throw why;
  std::string names;
  for (const auto& [name, array] : members_) names += (names.empty() ? "" : ", ") + name;
  throw DataError(path, "", "member '" + key + "'", names.empty() ? "none at all" : "only " + names);
}

void Npz::set(const std::string& key, NpyArray array) {
  for (auto& [name, old] : members_)
    if (name == key) {
      old = std::move(array);
      return;
    }
  members_.emplace_back(key, std::move(array));
}

double number_at(const Npz& archive, const std::string& key) {
  const NpyArray& array = archive.at(key);
  if (array.type == NpyArray::Type::kText) throw DataError(archive.path, key, "a number", "text");
  if (array.size() != 1)
    throw DataError(archive.path, key, "one number", std::to_string(array.size()) + " of them");
  return array.to_double().front();
}

std::int64_t whole_number_at(const Npz& archive, const std::string& key) {
  const double value = number_at(archive, key);
  if (!(std::abs(value) <= 0x1p53) || value != std::floor(value))
    throw DataError(archive.path, key, "a whole number", std::to_string(value));
  return static_cast<std::int64_t>(value);
}

const std::string& text_at(const Npz& archive, const std::string& key) {
  const NpyArray& array = archive.at(key);
  if (array.text.size() != 1)
    throw DataError(
        archive.path, key, "one text",
        array.type == NpyArray::Type::kText ? std::to_string(array.text.size()) + " of them" : "numbers");
  return array.text.front();
}

Npz parse_npz(const std::string& data, const std::string& path, std::size_t max_bytes,
              const std::vector<std::string>& keys) {
  const Bytes bytes(data, path);
  Npz archive;
  archive.path = path;
  // For all members together: a bomb may have many small ones. No motion shrinks to a hundredth.
  const std::size_t most = std::min(max_bytes, std::max(kAlwaysUnpacked, kMostRatio * data.size()));
  std::size_t left = most;
  for (const Entry& e : read_directory(bytes)) {
    if (!e.name.ends_with(".npy")) continue;
    const std::string key = e.name.substr(0, e.name.size() - 4);
    if (!keys.empty() && std::find(keys.begin(), keys.end(), key) == keys.end()) continue;
    if (e.unpacked > left)
      bytes.fail(e.name, "at most " + std::to_string(most) + " bytes after unpacking", "more");
    left -= e.unpacked;
    const std::vector<std::uint8_t> content = read_member(bytes, e);
    try {
      archive.set(key, parse_npy(content.data(), content.size(), path, key, max_bytes));
    } catch (const UnsupportedArray& why) {
      archive.set_unsupported(key, why);
    }
  }
  return archive;
}

Npz read_npz(const std::filesystem::path& path, std::size_t max_bytes, const std::vector<std::string>& keys) {
  return parse_npz(read_file(path), path.string(), max_bytes, keys);
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
      throw std::invalid_argument("format_npz: archives of 4 GiB or 65535 members are not written");
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

void write_npz(const std::filesystem::path& path, const Npz& archive) {
  write_file_atomically(path, format_npz(archive));
}

}  // namespace mimicx
