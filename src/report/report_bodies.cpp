#include "report/report_bodies.h"

#include "character/body_words.h"
#include "core/units.h"
#include "record/json.h"
#include "record/run_folder.h"
#include "report/base64_digits.h"
#include "skin/mannequin.h"
#include "skin/shapes.h"
#include "skin/tailored.h"

namespace mimicx::report {
namespace {

constexpr double kCell = 0.026;         ///< of the lattice that the mannequin is made on, m
constexpr double kVertexUnit = 0.4e-3;  ///< m
constexpr double kFullWeight = 63.0;    ///< the largest digit
constexpr double kPerMetre = 1e4;       ///< of bones and shapes

void append_point(const Vector3d& p, record::Json& list) {
  for (const double x : p) list.push_back(rounded(x, kPerMetre));
}

/// Bones and collision shapes.
record::Json body_json(const Character& character) {
  record::Json offsets = record::Json::array(), shapes = record::Json::array();
  for (const Vector3d& offset : character.joint_offset) {
    record::Json one = record::Json::array();
    append_point(offset, one);
    offsets.push_back(one);
  }
  for (const Capsule& c : skin::collision_capsules(character)) {
    record::Json one = record::Json::array();
    one.push_back(c.body);
    append_point(c.a_B, one);
    append_point(c.b_B, one);
    one.push_back(rounded(c.radius, kPerMetre));
    shapes.push_back(one);
  }
  return {{"offsets", offsets}, {"shapes", shapes}};
}

/// Of the standard body.
const skin::Mesh& mannequin() {
  static const skin::Mesh mesh = skin::mannequin(make_character(), kReportTriangles, kCell);
  return mesh;
}

/// From the joint of the heaviest body: near enough for two digits.
std::string encode_vertices(const skin::Mesh& mesh, const Character& character) {
  const PerBody<Vector3d> joint = skin::bind_joints(character);
  Digits digits;
  for (int v = 0; v < mesh.vertices.count(); ++v)
    for (const double x : Vector3d(mesh.vertices[v] - joint[mesh.joints[v][0]]))
      digits.put(x / kVertexUnit, 2);
  return digits.text();
}

}  // namespace

std::string ReportBodies::take(const Character& character) {
  record::Json json = body_json(character);
  const std::string key = record::checksum(json.dump());
  const auto [found, is_new] = texts_.try_emplace(key);
  if (is_new) {
    json["vertices"] = encode_vertices(skin::tailored(mannequin(), make_character(), character), character);
    found->second = json.dump();
  }
  return key;
}

std::string skin_json() {
  const skin::Mesh& skin = mannequin();
  record::Json names = record::Json::array();
  for (int body = 0; body < kBodies; ++body) names.push_back(body_in_words(body));
  Digits triangles, joints, weights;
  for (const skin::Triangle& t : skin.triangles)
    for (const int v : t) triangles.put_count(v, 2);
  for (int v = 0; v < skin.vertices.count(); ++v)
    for (int k = 0; k < skin::kInfluences; ++k) {
      joints.put_count(skin.joints[v][k], 1);
      weights.put_count(kFullWeight * skin.weights[v][k], 1);
    }
  const record::Json json = {{"parents", kParents},
                             {"names", names},
                             {"triangles", triangles.text()},
                             {"joints", joints.text()},
                             {"weights", weights.text()}};
  return json.dump();
}

}  // namespace mimicx::report
