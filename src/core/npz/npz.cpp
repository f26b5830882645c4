#include "core/npz/npz.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>

#ifdef MIMICX_WITH_ZLIB
#include <zlib.h>
#else
#include "core/npz/inflate.h"
#endif

#include "core/npz/zip_format.h"

namespace mimicx {
namespace {

constexpr std::size_t kAlwaysUnpacked = std::size_t{1} << 28;  ///< unpacked bytes allowed for any archive
constexpr std::size_t kMostRatio = 100;         ///< unpacked size over that of the archive, for larger ones
constexpr std::size_t kMaxDeflateRatio = 1032;  ///< limit of the deflate format itself

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
    raise(DataError(path_, place, expected, found));
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

/// Count and place of the directory from the zip64 record, whose locator is in front of the end record at
/// `end`.
void read_zip64_end(const Bytes& bytes, std::uint64_t end, std::uint64_t& count, std::uint64_t& at) {
  constexpr std::uint64_t kLocatorBytes = 20, kLocator = 0x07064b50, kZip64End = 0x06064b50;
  if (end < kLocatorBytes || bytes.number(end - kLocatorBytes, 4) != kLocator)
    bytes.fail("", "a zip64 directory", "no locator of one (damaged)");
  const std::uint64_t record = bytes.number(end - kLocatorBytes + 8, 8);
  if (bytes.number(record, 4) != kZip64End) bytes.fail("", "a zip64 directory", "other content (damaged)");
  count = bytes.number(record + 32, 8);
  at = bytes.number(record + 48, 8);
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
  std::uint64_t count = bytes.number(end + 10, 2), at = bytes.number(end + 16, 4);
  if (count == 0xFFFF || bytes.number(end + 12, 4) == kSaturated32 || at == kSaturated32)
    read_zip64_end(bytes, end, count, at);
  std::vector<Entry> entries;
  std::uint64_t packed = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    entries.push_back(read_entry(bytes, at));
    at = entries.back().next;
    packed += std::min<std::uint64_t>(entries.back().packed, bytes.size() + 1);
    // Overlapping members let small archives unpack to terabytes.
    if (packed > bytes.size())
      bytes.fail(entries.back().name, "members within the file", "overlapping members");
  }
  return entries;
}

#ifdef MIMICX_WITH_ZLIB
/// None if the data is damaged.
std::optional<std::vector<std::uint8_t>> unpacked(const std::uint8_t* packed, const Entry& e) {
  std::vector<std::uint8_t> out(e.unpacked);
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) raise(std::runtime_error("zlib: inflateInit2 failed"));
  // zlib counts in 32 bits; both sizes were checked to be under 4 GiB.
  stream.next_in = const_cast<Bytef*>(packed);
  stream.avail_in = static_cast<uInt>(e.packed);
  std::uint8_t nothing = 0;
  stream.next_out = out.empty() ? &nothing : out.data();
  stream.avail_out = static_cast<uInt>(e.unpacked);
  const int status = ::inflate(&stream, Z_FINISH);
  const auto produced = stream.total_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END || produced != e.unpacked) return std::nullopt;
  return out;
}
#else
std::optional<std::vector<std::uint8_t>> unpacked(const std::uint8_t* packed, const Entry& e) {
  return inflate({packed, static_cast<std::size_t>(e.packed)}, static_cast<std::size_t>(e.unpacked));
}
#endif

std::vector<std::uint8_t> inflated(const std::uint8_t* packed, const Entry& e, const Bytes& bytes) {
  if (e.unpacked / kMaxDeflateRatio > e.packed + 1)
    bytes.fail(e.name, "a size deflate can reach", std::to_string(e.unpacked) + " bytes");
  if (auto out = unpacked(packed, e)) return std::move(*out);
  bytes.fail(e.name, std::to_string(e.unpacked) + " bytes after inflating", "damaged data");
}

std::vector<std::uint8_t> read_member(const Bytes& bytes, const Entry& e) {
  if (e.flags & 1) bytes.fail(e.name, "a plain member", "an encrypted one");
  if (e.unpacked >= kSaturated32 || e.packed >= kSaturated32)
    bytes.fail(e.name, "a member under 4 GiB", std::to_string(e.unpacked) + " bytes");
  if (bytes.number(e.local, 4) != kLocalHeader) bytes.fail(e.name, "a zip member", "other content (damaged)");
  // The local header may lack the sizes (streamed archives): those of the directory are used.
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

/// Whether a member is one that macOS adds beside every file: "__MACOSX/._trans.npy".
bool is_of_finder(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return name.starts_with("__MACOSX/") ||
         std::string_view(name).substr(slash == std::string::npos ? 0 : slash + 1).starts_with("._");
}

}  // namespace

Npz parse_npz(const std::string& data, const std::string& path, std::size_t max_bytes,
              const std::vector<std::string>& keys) {
  const Bytes bytes(data, path);
  Npz archive;
  archive.path = path;
  // Limit for all members together: a bomb may have many small ones. No motion compresses by 100.
  const std::size_t most = std::min(max_bytes, std::max(kAlwaysUnpacked, kMostRatio * data.size()));
  std::size_t left = most;
  for (const Entry& e : read_directory(bytes)) {
    if (!e.name.ends_with(".npy") || is_of_finder(e.name)) continue;
    const std::string key = e.name.substr(0, e.name.size() - 4);
    if (!keys.empty() && std::find(keys.begin(), keys.end(), key) == keys.end()) continue;
    if (e.unpacked > left)
      bytes.fail(e.name, "at most " + std::to_string(most) + " bytes after unpacking", "more");
    left -= static_cast<std::size_t>(e.unpacked);
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

void write_npz(const std::filesystem::path& path, const Npz& archive) {
  write_file_atomically(path, format_npz(archive));
}

}  // namespace mimicx
