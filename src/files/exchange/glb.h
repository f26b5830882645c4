/// A binary glTF 2.0 file under construction: arrays of numbers in its one buffer, and its JSON.
///
/// Source: Khronos, "glTF 2.0 Specification", its chapters on binary data storage and on the GLB file format.
/// Little endian; numbers are single precision or whole; every array begins at a multiple of four bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "record/json.h"

namespace mimicx::files {

/// The use of an array in a buffer, by glTF's numbers.
enum class BufferUse { kAnimation = 0, kVertices = 34962, kIndices = 34963 };

class Glb {
 public:
  /// The first characters of the JSON, at byte kJsonAt of the file.
  static constexpr std::string_view kJsonOpening = R"({"asset":{"version":"2.0","generator":"mimicx")";
  static constexpr std::size_t kJsonAt = 20;

  Glb();

  /// @param type        "SCALAR", "VEC3", "VEC4", "MAT4"
  /// @param with_range  also store the least and largest value, which positions and times need
  /// @return the index of the accessor
  int add(const std::vector<float>& values, const std::string& type, BufferUse use, bool with_range = false);
  int add(const std::vector<std::uint8_t>& values, const std::string& type, BufferUse use);
  int add(const std::vector<std::uint32_t>& values, const std::string& type, BufferUse use);

  /// Appends to a list of the top-level JSON object. @return its index there
  int append(const std::string& list, record::Json element);

  record::Json json;

  /// The whole file.
  std::string bytes() const;

 private:
  /// What glTF calls an accessor.
  struct Accessor {
    std::size_t count;  ///< of elements
    int component;      ///< glTF's number of the component type
    std::string type;   ///< "SCALAR", …
    record::Json range = record::Json::object();
  };
  int add_array(const void* data, std::size_t bytes, const Accessor& accessor, BufferUse use);

  std::string buffer_;
};

}  // namespace mimicx::files
