/// A small reader of .glb files that shares nothing with their writer: after the glTF 2.0 specification.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/so3.h"

namespace mimicx::files {

class GlbReader {
 public:
  nlohmann::json json;

  /// @throws std::runtime_error where the container is not sound
  explicit GlbReader(const std::string& bytes) {
    const auto whole = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, sizeof value);
      return value;
    };
    require(bytes.size() % 4 == 0 && bytes.starts_with("glTF") && whole(4) == 2, "magic, version");
    require(whole(8) == bytes.size(), "length");
    const std::size_t text = whole(12);
    require(text % 4 == 0 && bytes.substr(16, 4) == "JSON", "JSON chunk");
    json = nlohmann::json::parse(bytes.substr(20, text));
    const std::size_t binary = 20 + text;
    require(whole(binary + 4) == 0x004E4942 && whole(binary) % 4 == 0, "BIN chunk");
    buffer_ = bytes.substr(binary + 8);
    require(buffer_.size() == whole(binary), "length of the BIN chunk");
    require(json["buffers"].size() == 1 && json["buffers"][0]["byteLength"] == buffer_.size(), "buffer");
    for (std::size_t i = 0; i < json["accessors"].size(); ++i) check(i);
  }

  /// Elements of an accessor, whatever their type, row by row.
  std::vector<std::vector<double>> rows(std::size_t accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t offset = view["byteOffset"].get<std::size_t>() + a.value("byteOffset", std::size_t{0});
    const std::size_t count = a["count"], w = width(a), size = component_size(a);
    std::vector<std::vector<double>> out(count, std::vector<double>(w));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < w; ++k) {
        const char* at = buffer_.data() + offset + (i * w + k) * size;
        if (a["componentType"] == 5126) {
          float value = 0;
          std::memcpy(&value, at, sizeof value);
          out[i][k] = value;
        } else if (a["componentType"] == 5125) {
          std::uint32_t value = 0;
          std::memcpy(&value, at, sizeof value);
          out[i][k] = value;
        } else {
          out[i][k] = static_cast<unsigned char>(*at);
        }
      }
    return out;
  }

  std::size_t node(const std::string& name) const {
    for (std::size_t i = 0; i < json["nodes"].size(); ++i)
      if (json["nodes"][i]["name"] == name) return i;
    throw std::runtime_error("no node " + name);
  }

  /// Keys of one channel of the animation; empty: there is none. @param times  theirs
  std::vector<std::vector<double>> keys(std::size_t node, const std::string& path,
                                        std::vector<double>* times = nullptr) const {
    const auto& animation = json["animations"][0];
    for (const auto& channel : animation["channels"])
      if (channel["target"]["node"] == node && channel["target"]["path"] == path) {
        const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
        if (times != nullptr)
          for (const auto& row : rows(sampler["input"])) times->push_back(row[0]);
        return rows(sampler["output"]);
      }
    return {};
  }

  /// World transforms of all nodes at a key; at -1 as they rest.
  std::vector<Eigen::Affine3d> transforms(int key) const {
    std::vector<Eigen::Affine3d> world(json["nodes"].size(), Eigen::Affine3d::Identity());
    for (const auto& top : json["scenes"][json["scene"].get<std::size_t>()]["nodes"])
      place(top, Eigen::Affine3d::Identity(), key, world);
    return world;
  }

 private:
  static void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("glb: " + what);
  }
  static std::size_t width(const nlohmann::json& accessor) {
    const std::string type = accessor["type"];
    return type == "SCALAR" ? 1u : type == "VEC3" ? 3u : type == "VEC4" ? 4u : 16u;
  }
  static std::size_t component_size(const nlohmann::json& accessor) {
    return accessor["componentType"] == 5121 ? 1u : 4u;
  }

  void check(std::size_t i) const {
    const auto& a = json["accessors"][i];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t from = view["byteOffset"], length = view["byteLength"], count = a["count"];
    require(count > 0 && from % 4 == 0 && from + length <= buffer_.size(), "bounds of a view");
    require(count * width(a) * component_size(a) == length, "an accessor fills its view");
    if (!a.contains("min")) return;
    const auto values = rows(i);
    for (std::size_t k = 0; k < width(a); ++k) {
      double low = values[0][k], high = low;
      for (const auto& row : values) {
        low = std::min(low, row[k]);
        high = std::max(high, row[k]);
      }
      require(a["min"][k] == low && a["max"][k] == high, "range of an accessor");
    }
  }

  std::vector<double> value(std::size_t node, const std::string& path, int key,
                            const std::vector<double>& otherwise) const {
    const auto all = key < 0 ? std::vector<std::vector<double>>() : keys(node, path);
    if (!all.empty()) return all[static_cast<std::size_t>(key)];
    return json["nodes"][node].value(path, otherwise);
  }

  void place(std::size_t node, const Eigen::Affine3d& parent, int key,
             std::vector<Eigen::Affine3d>& world) const {
    const auto p = value(node, "translation", key, {0, 0, 0}), q = value(node, "rotation", key, {0, 0, 0, 1}),
               s = value(node, "scale", key, {1, 1, 1});
    world[node] = parent * Eigen::Translation3d(p[0], p[1], p[2]) * Quaterniond(q[3], q[0], q[1], q[2]) *
                  Eigen::Scaling(s[0], s[1], s[2]);
    if (!json["nodes"][node].contains("children")) return;
    for (const auto& child : json["nodes"][node]["children"]) place(child, world[node], key, world);
  }

  std::string buffer_;
};

}  // namespace mimicx::files
