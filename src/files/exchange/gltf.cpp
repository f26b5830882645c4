#include "files/exchange/gltf.h"

#include <algorithm>
#include <numbers>

#include "files/exchange/glb.h"
#include "skin/arrow.h"
#include "skin/box.h"

namespace mimicx::files {
namespace {

using record::Json;

constexpr Array<const char*, kCarriers> kArrowNames = {"right_foot_force", "left_foot_force", "rest_force"};

Quaterniond to_y_up() { return exp_map(Vector3d(-0.5 * std::numbers::pi, 0, 0)); }

void add_floats(const Vector3d& v, std::vector<float>& values) {
  for (const double x : v) values.push_back(static_cast<float>(x));
}
/// Adds x, y, z, w, with the sign nearer to the previous key. @param before  that key; becomes this one
void add_floats(Quaterniond q, Quaterniond& before, std::vector<float>& values) {
  if (q.dot(before) < 0.0) q.coeffs() *= -1.0;
  before = q;
  q.normalize();
  for (const double x : q.coeffs()) values.push_back(static_cast<float>(x));
}

Json triple(const Vector3d& v) {
  return std::vector<Json>{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Weights in single precision whose sum is 1 up to rounding.
Array<float, skin::kInfluences> rounded(const Array<double, skin::kInfluences>& weights) {
  Array<float, skin::kInfluences> out;
  float rest = 1.0F;
  for (int k = skin::kInfluences - 1; k > 0; --k) {
    out[k] = static_cast<float>(weights[k]);
    rest -= out[k];
  }
  out[0] = rest;
  return out;
}

class Writer {
 public:
  Writer(const motion::Clip& clip, const skin::Mesh& mesh)
      : clip_(clip),
        mesh_(mesh),
        character_(motion::character_of(clip)),
        bind_(skin::bind_joints(character_)) {
    for (const Vector3d& p : mesh.vertices) lift_.y() = std::max(lift_.y(), -p.y());
  }

  std::string write(const RecordedForces* forces) {
    glb_.json["scene"] = 0;
    add_joints();
    add_body();
    add_motion();
    add_plates();
    if (forces != nullptr) add_arrows(*forces);
    Json scene = Json::object();
    scene["nodes"] = top_nodes_;
    glb_.append("scenes", scene);
    Json animation = Json::object();
    animation["name"] = clip_.name.empty() ? "motion" : clip_.name;
    animation["channels"] = channels_;
    animation["samplers"] = samplers_;
    glb_.append("animations", animation);
    return glb_.bytes();
  }

 private:
  void add_joints() {
    for (int b = 0; b < kBodies; ++b) {
      Json node = Json::object();
      node["name"] = kBodyNames[b];
      node["translation"] = triple(b == 0 ? lift_ : character_.joint_offset[b]);
      std::vector<Json> children;
      for (int child = 1; child < kBodies; ++child)
        if (kParents[child] == b) children.emplace_back(child);
      if (!children.empty()) node["children"] = children;
      glb_.append("nodes", node);
    }
    top_nodes_.emplace_back(0);
  }

  int add_material(const char* name, const std::vector<Json>& colour) {
    Json material = Json::object();
    material["name"] = name;
    material["pbrMetallicRoughness"]["baseColorFactor"] = colour;
    material["pbrMetallicRoughness"]["metallicFactor"] = 0;
    material["pbrMetallicRoughness"]["roughnessFactor"] = 0.75;
    return glb_.append("materials", material);
  }

  /// Positions, normals and triangles as the one primitive of a mesh. @param attributes  others it has
  int add_mesh(const char* name, const skin::Mesh& mesh, const Vector3d& moved, int material,
               Json attributes) {
    std::vector<float> places, normals;
    std::vector<std::uint32_t> corners;
    for (const Vector3d& p : mesh.vertices) add_floats(Vector3d(p + moved), places);
    for (const Vector3d& n : mesh.normals) add_floats(n, normals);
    for (const skin::Triangle& t : mesh.triangles)
      for (const int v : t) corners.push_back(static_cast<std::uint32_t>(v));
    attributes["POSITION"] = glb_.add(places, "VEC3", BufferUse::kVertices, true);
    attributes["NORMAL"] = glb_.add(normals, "VEC3", BufferUse::kVertices);
    Json primitive = Json::object();
    primitive["attributes"] = attributes;
    primitive["indices"] = glb_.add(corners, "SCALAR", BufferUse::kIndices);
    primitive["material"] = material;
    Json out = Json::object();
    out["name"] = name;
    out["primitives"].push_back(primitive);
    return glb_.append("meshes", out);
  }

  void add_body() {
    std::vector<std::uint8_t> joints;
    std::vector<float> weights, inverse_bind;
    for (int v = 0; v < mesh_.vertices.count(); ++v) {
      for (const int b : mesh_.joints[v]) joints.push_back(static_cast<std::uint8_t>(b));
      for (const float w : rounded(mesh_.weights[v])) weights.push_back(w);
    }
    for (int b = 0; b < kBodies; ++b) {
      inverse_bind.insert(inverse_bind.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});  // column by column
      add_floats(Vector3d(-bind_[b] - lift_), inverse_bind);
      inverse_bind.push_back(1);
    }
    Json attributes = Json::object();
    attributes["JOINTS_0"] = glb_.add(joints, "VEC4", BufferUse::kVertices);
    attributes["WEIGHTS_0"] = glb_.add(weights, "VEC4", BufferUse::kVertices);
    const int material = add_material("body", {0.62, 0.60, 0.57, 1.0});
    Json node = Json::object();
    node["name"] = "body";
    node["mesh"] = add_mesh("body", mesh_, lift_, material, attributes);
    Json skin = Json::object();
    skin["inverseBindMatrices"] = glb_.add(inverse_bind, "MAT4", BufferUse::kAnimation);
    skin["skeleton"] = 0;
    for (int b = 0; b < kBodies; ++b) skin["joints"].push_back(b);
    node["skin"] = glb_.append("skins", skin);
    top_nodes_.emplace_back(glb_.append("nodes", node));
  }

  void add_channel(int node, const char* path, int times, int values) {
    Json sampler = Json::object(), channel = Json::object();
    sampler["input"] = times;
    sampler["interpolation"] = "LINEAR";
    sampler["output"] = values;
    channel["sampler"] = samplers_.size();
    channel["target"]["node"] = node;
    channel["target"]["path"] = path;
    samplers_.push_back(sampler);
    channels_.push_back(channel);
  }

  int add_times(int count, double first) {
    std::vector<float> times;
    for (int t = 0; t < count; ++t) times.push_back(static_cast<float>((t + first) / clip_.fps));
    return glb_.add(times, "SCALAR", BufferUse::kAnimation, true);
  }

  void add_motion() {
    const auto rotations = motion::joint_rotations(clip_);
    const Quaterniond turned = to_y_up();
    const Vector3d rest = rest_pelvis(clip_);
    const int times = add_times(clip_.frames(), 0.0);
    std::vector<float> places;
    for (const Vector3d& trans : clip_.trans) add_floats(Vector3d(turned * (trans + rest)), places);
    add_channel(0, "translation", times, glb_.add(places, "VEC3", BufferUse::kAnimation));
    for (int b = 0; b < kBodies; ++b) {
      std::vector<float> values;
      Quaterniond before = Quaterniond::Identity();
      for (int t = 0; t < clip_.frames(); ++t)
        add_floats(b == 0 ? turned * rotations[t][b] : rotations[t][b], before, values);
      add_channel(b, "rotation", times, glb_.add(values, "VEC4", BufferUse::kAnimation));
    }
  }

  /// The boxes of the scene, a mesh each: they do not move.
  void add_plates() {
    if (clip_.scene.flat()) return;
    const int material = add_material("scene", {0.78, 0.77, 0.74, 1.0});
    for (const Plate& plate : clip_.scene.plates) {
      skin::Mesh box = skin::box();
      box.vertices = skin::box_under(plate, box);
      for (Vector3d& p : box.vertices) p = to_y_up() * p;
      for (Vector3d& n : box.normals) n = to_y_up() * (rotation_z(plate.yaw) * n);
      Json node = Json::object();
      node["name"] = "plate";
      node["mesh"] = add_mesh("plate", box, Vector3d::Zero(), material, Json::object());
      top_nodes_.emplace_back(glb_.append("nodes", node));
    }
  }

  void add_arrows(const RecordedForces& forces) {
    const List<FloorForces> floor = floor_forces(motion::poses_of(clip_), forces, clip_.scene);
    const int material = add_material("force", {0.85, 0.30, 0.08, 1.0});
    const int mesh = add_mesh("force", skin::arrow(), Vector3d::Zero(), material, Json::object()),
              times = add_times(floor.count(), 0.5);
    for (const int c : {kOnRightFoot, kOnLeftFoot, kOnTheRest}) {
      const bool ever =
          std::any_of(floor.begin(), floor.end(), [=](const FloorForces& f) { return f[c].loaded; });
      if (c == kOnTheRest && !ever) continue;
      add_arrow(kArrowNames[c], mesh, times, floor, c);
    }
  }

  void add_arrow(const char* name, int mesh, int times, const List<FloorForces>& floor, int carrier) {
    std::vector<float> places, turns, sizes;
    Quaterniond before = Quaterniond::Identity();
    const Quaterniond turned = to_y_up();
    for (const FloorForces& row : floor) {
      const FloorForce& f = row[carrier];
      const double length = f.loaded ? kMetresPerNewton * f.force.norm() : 0.0, width = f.loaded ? 1.0 : 0.0;
      add_floats(Vector3d(turned * f.point), places);
      add_floats(f.loaded ? rotation_between(Vector3d::UnitY(), turned * f.force) : before, before, turns);
      add_floats(Vector3d(width, length, width), sizes);
    }
    Json node = Json::object();
    node["name"] = name;
    node["mesh"] = mesh;
    const int number = glb_.append("nodes", node);
    top_nodes_.emplace_back(number);
    add_channel(number, "translation", times, glb_.add(places, "VEC3", BufferUse::kAnimation));
    add_channel(number, "rotation", times, glb_.add(turns, "VEC4", BufferUse::kAnimation));
    add_channel(number, "scale", times, glb_.add(sizes, "VEC3", BufferUse::kAnimation));
  }

  const motion::Clip& clip_;
  const skin::Mesh& mesh_;
  Character character_;
  PerBody<Vector3d> bind_;
  Vector3d lift_ = Vector3d::Zero();  ///< puts the bind pose on the floor, m
  Glb glb_;
  std::vector<Json> top_nodes_, channels_, samplers_;
};

}  // namespace

std::string format_glb(const motion::Clip& clip, const skin::Mesh& mesh, const RecordedForces* arrows) {
  return Writer(clip, mesh).write(arrows);
}

}  // namespace mimicx::files
