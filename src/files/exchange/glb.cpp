#include "files/exchange/glb.h"

#include <algorithm>
#include <bit>

namespace mimicx::files {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr int kUnsignedByte = 5121, kUnsignedInt = 5125, kFloat = 5126;

std::size_t width_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

void add_whole(std::uint32_t value, std::string& out) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Least and largest value of every component.
record::Json range_of(const std::vector<float>& values, std::size_t width) {
  std::vector<record::Json> least, most;
  for (std::size_t k = 0; k < width; ++k) {
    float low = values[k], high = values[k];
    for (std::size_t i = k; i < values.size(); i += width) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    least.emplace_back(low);
    most.emplace_back(high);
  }
  record::Json range = record::Json::object();
  range["min"] = least;
  range["max"] = most;
  return range;
}

}  // namespace

Glb::Glb() {
  json["asset"]["version"] = "2.0";
  json["asset"]["generator"] = "mimicx";
}

int Glb::add(const std::vector<float>& values, const std::string& type, BufferUse use, bool with_range) {
  const std::size_t width = width_of(type);
  Accessor accessor{values.size() / width, kFloat, type};
  if (with_range) accessor.range = range_of(values, width);
  return add_array(values.data(), values.size() * sizeof(float), accessor, use);
}

int Glb::add(const std::vector<std::uint8_t>& values, const std::string& type, BufferUse use) {
  return add_array(values.data(), values.size(), {values.size() / width_of(type), kUnsignedByte, type}, use);
}

int Glb::add(const std::vector<std::uint32_t>& values, const std::string& type, BufferUse use) {
  return add_array(values.data(), values.size() * sizeof(std::uint32_t),
                   {values.size() / width_of(type), kUnsignedInt, type}, use);
}

int Glb::add_array(const void* data, std::size_t bytes, const Accessor& accessor, BufferUse use) {
  buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
  record::Json view = record::Json::object();
  view["buffer"] = 0;
  view["byteOffset"] = buffer_.size();
  view["byteLength"] = bytes;
  if (use != BufferUse::kAnimation) view["target"] = static_cast<int>(use);
  record::Json json_accessor = record::Json::object();
  json_accessor["bufferView"] = append("bufferViews", view);
  json_accessor["componentType"] = accessor.component;
  json_accessor["count"] = accessor.count;
  json_accessor["type"] = accessor.type;
  for (const auto& [name, value] : accessor.range.items()) json_accessor[name] = value;
  buffer_.append(static_cast<const char*>(data), bytes);
  return append("accessors", json_accessor);
}

int Glb::append(const std::string& list, record::Json element) {
  json[list].push_back(std::move(element));
  return static_cast<int>(json.at(list).elements().size()) - 1;
}

std::string Glb::bytes() const {
  std::string buffer = buffer_;
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  record::Json whole = json, only = record::Json::object();
  only["byteLength"] = buffer.size();
  whole["buffers"].push_back(only);
  std::string text = whole.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  add_whole(2, out);
  add_whole(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()), out);
  add_whole(static_cast<std::uint32_t>(text.size()), out);
  out += "JSON" + text;
  add_whole(static_cast<std::uint32_t>(buffer.size()), out);
  out.append("BIN\0", 4);
  return out + buffer;
}

}  // namespace mimicx::files
