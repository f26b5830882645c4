#include "policy_export/cpp_header.h"

#include <charconv>
#include <set>
#include <stdexcept>

#include "policy_export/runtime_text.h"

namespace mimicx::policy_export {
namespace {

constexpr std::size_t kColumns = 118;

/// The shortest decimals that are this number, as a literal of C++.
template <class Real>
std::string decimals(Real x) {
  std::string out(32, '\0');
  const char* const end = std::to_chars(out.data(), out.data() + out.size(), x).ptr;
  out.resize(static_cast<std::size_t>(end - out.data()));
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

std::string literal(float x) { return decimals(x) + "F"; }
std::string literal(double x) { return decimals(x); }
std::string literal(std::int8_t x) { return std::to_string(x); }
std::string literal(std::int16_t x) { return std::to_string(x); }

const char* type_name(float) { return "float"; }
const char* type_name(double) { return "double"; }
const char* type_name(std::int8_t) { return "std::int8_t"; }
const char* type_name(std::int16_t) { return "std::int16_t"; }

/// Numbers separated by commas, broken into lines.
template <class T>
std::string list_of(const T* values, std::size_t count) {
  std::string out;
  std::size_t column = kColumns;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = literal(values[i]) + ",";
    if (column + number.size() > kColumns) {
      out += "\n ";
      column = 1;
    }
    out += number;
    column += number.size();
  }
  return out;
}

template <class T>
std::string c_array(const std::string& name, const T* values, std::size_t count) {
  return std::string("inline constexpr ") + type_name(T{}) + " " + name + "[" + std::to_string(count) +
         "] = {" + list_of(values, count) + "};\n";
}

std::string constant(const std::string& type, const std::string& name, const std::string& value,
                     const std::string& comment) {
  return "inline constexpr " + type + " " + name + " = " + value + ";  ///< " + comment + "\n";
}

/// A text as a literal of C++.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += '?';
    } else {
      out += c;
    }
  }
  return out + "\"";
}

/// runtime.h without its own opening and with another namespace around it.
std::string runtime_in(const std::string& name) {
  const std::string own = "namespace mimicx::policy_export {\n";
  std::string text(kRuntimeText);
  const std::size_t at = text.find(own), end = text.rfind("}  // namespace");
  if (at == std::string::npos || end == std::string::npos)
    throw std::logic_error("runtime.h has another namespace");
  return "namespace " + name + " {\n" + text.substr(at + own.size(), end - at - own.size());
}

std::string joints(const Character& character) {
  std::string names =
      "/// Bodies by their number: the joint i connects body i to its parent.\n"
      "inline constexpr const char* kJointName[kBodyCount] = {";
  std::vector<double> kp, kd, torque, centre, half;
  for (int body = 0; body < kBodies; ++body) {
    if (body % 6 == 0) names += "\n   ";
    names += " \"" + std::string(kBodyNames[body]) + "\",";
    const JointParameters& joint = character.joint[body];
    kp.push_back(joint.kp);
    kd.push_back(joint.kd);
    torque.push_back(joint.torque_limit);
    for (int k = 0; k < 3; ++k) {
      centre.push_back(joint.centre[k]);
      half.push_back(joint.half_range[k]);
    }
  }
  return names +
         "};\n// PD controllers, N·m/rad and N·m·s/rad, and the largest torque, N·m; entry 0 is not used\n" +
         c_array("kStiffness", kp.data(), kp.size()) + c_array("kDamping", kd.data(), kd.size()) +
         c_array("kTorqueLimit", torque.data(), torque.size()) +
         "// Range: rotations from the centre (a rotation vector) stay inside an ellipsoid of these half "
         "axes, rad\n" +
         c_array("kRangeCentre", centre.data(), centre.size()) +
         c_array("kRangeHalfAxes", half.data(), half.size());
}

/// A network as arrays, and its layers as `NAMELayers`.
template <class Weight>
std::string layers_text(const std::string& name, const Layer<Weight>* layers, int count) {
  std::string out, list;
  for (int l = 0; l < count; ++l) {
    const Layer<Weight>& layer = layers[l];
    const std::string number = std::to_string(l);
    const auto outputs = static_cast<std::size_t>(layer.outputs);
    out +=
        c_array(name + "Weights" + number, layer.weights, static_cast<std::size_t>(layer.inputs) * outputs);
    if (layer.scales != nullptr) out += c_array(name + "Scales" + number, layer.scales, outputs);
    out += c_array(name + "Biases" + number, layer.biases, outputs);
    list.append("    {").append(std::to_string(layer.inputs)).append(", ");
    list.append(std::to_string(layer.outputs)).append(", ").append(name).append("Weights").append(number);
    list.append(layer.scales != nullptr ? ", " + name + "Scales" + number : ", nullptr");
    list.append(", ").append(name).append("Biases").append(number).append("},\n");
  }
  return out + "inline constexpr Layer<" + type_name(Weight{}) + "> " + name + "Layers[] = {\n" + list +
         "};\n";
}

template <class Weight>
std::string data_of(const ExportedPolicy& exported, const Policy<Weight>& policy) {
  const MotionSpline& motion = exported.motion;
  const auto inputs = exported.inputs.size();
  std::string out = c_array("kKnots", motion.knots.data(), motion.knots.size()) +
                    c_array("kMiddle", policy.motion.middle, kChannels) +
                    c_array("kStep", policy.motion.step, kChannels) +
                    c_array("kSpeedCodes", motion.speeds.data(), motion.speeds.size()) +
                    c_array("kSpeedStep", policy.motion.speed_step, kSpeeds) +
                    c_array("kJointOffset", policy.joint_offset, 3 * kBodyCount) +
                    c_array("kShape", policy.shape, kShapeCount) + c_array("kInput", policy.input, inputs) +
                    c_array("kMean", policy.mean, inputs) + c_array("kFactor", policy.factor, inputs);
  if (policy.power != nullptr) out += c_array("kPower", policy.power, inputs);
  return out + layers_text("k", policy.layer, policy.layers);
}

/// The braces of a Policy.
template <class Weight>
std::string braces_of(const ExportedPolicy& exported, const Policy<Weight>& policy) {
  return "{\n    {" + std::to_string(exported.motion.frames) + ", " +
         std::to_string(exported.motion.spacing) + ", " + literal(exported.motion.fps) +
         ", kKnots, kMiddle, kStep, kSpeedCodes, kSpeedStep},\n    kJointOffset, kShape, kInput, kMean, "
         "kFactor, " +
         literal(policy.limit) + ", " + (policy.power != nullptr ? "kPower" : "nullptr") + ", " +
         std::to_string(policy.layers) + ", kLayers, " + literal(policy.max_action) + "}";
}

template <class Weight>
std::string policy_data_text(const ExportedPolicy& exported, const Policy<Weight>& policy) {
  return data_of(exported, policy) + "inline constexpr Policy<" + type_name(Weight{}) +
         "> kPolicy = " + braces_of(exported, policy) + ";\n";
}

std::string policy_data_text(const ExportedPolicy& exported, const CodedPolicy<float>& policy) {
  return data_of(exported, policy) + c_array("kPoseMean", policy.pose_mean, kPoseCount) +
         c_array("kPoseFactor", policy.pose_factor, kPoseCount) +
         layers_text("kEncoder", policy.encoder, policy.encoder_layers) +
         layers_text("kDecoder", policy.decoder, policy.decoder_layers) +
         "inline constexpr CodedPolicy<float> kPolicy = {" + braces_of(exported, policy) +
         ",\n    kPoseMean, kPoseFactor, " + literal(policy.pose_limit) + ", " +
         std::to_string(policy.encoder_layers) + ", " + std::to_string(policy.decoder_layers) +
         ", kEncoderLayers, kDecoderLayers};\n";
}

/// Rows of a matrix, each in braces, in braces.
template <std::size_t kRows, std::size_t kColumns>
void append_rows(const float (&rows)[kRows][kColumns], std::string& out) {
  out += "{";
  for (const auto& row : rows) out.append("{").append(list_of(row, kColumns)).append("},");
  out += "}";
}

std::string records_of(const ExportedPolicy& exported) {
  std::string out =
      "struct Record {\n  int frame;\n  State now;\n  float action[kActionCount];\n"
      "  float target_q[kBodyCount][4];\n};\ninline constexpr Record kRecords[] = {\n";
  for (const Record& record : exported.records) {
    const State& now = record.now;
    out.append("{").append(std::to_string(record.frame)).append(", {{").append(list_of(now.p_root, 3));
    out.append("}, {").append(list_of(now.v_root, 3)).append("}, ");
    append_rows(now.q, out);
    out += ", ";
    append_rows(now.omega, out);
    out.append("},\n{").append(list_of(record.action.data(), kActionCount)).append("}, ");
    append_rows(record.targets.q, out);
    out += "},\n";
  }
  return out + "};\n";
}

/// What a user calls. kWidest is that of the network.
constexpr std::string_view kCalls = R"(
/// The motion at a frame: a body that starts on it starts here.
inline State reference(int frame) { return motion_at(kPolicy.motion, frame); }

/// What the PD controllers shall aim at for a body that is in the state `now` and shall be in `next` a frame later,
/// of a motion of your own. In between, the simulation moves the targets from the last ones to these: rotations by
/// normalised linear interpolation, velocities linearly. At first the last ones are the joints of the body.
inline Targets follow(const State& next, const State& now) { return follow<kWidest>(kPolicy, next, now); }

/// The same for the motion of this policy, from `frame` to the next one.
inline Targets follow(int frame, const State& now) { return follow(reference(frame + 1), now); }

/// Asks what was asked when this file was made. @return the largest difference from what was answered, rad; 0 on
/// every machine of IEEE 754 where the compiler fuses no multiplications (-ffp-contract=off), and under 1e-4 else
inline float self_test() {
  float worst = 0.0F;
  const auto compare = [&](float a, float b) {
    const float difference = a > b ? a - b : b - a;
    if (worst == worst && !(difference <= worst)) worst = difference;  // no number stays
  };
  for (const Record& record : kRecords) {
    float observation[kStateCount], action[kActionCount];
    const State next = reference(record.frame + 1);
    observe(kPolicy, next, record.now, observation);
    decide<kWidest>(kPolicy, observation, action);
    for (int k = 0; k < kActionCount; ++k) compare(action[k], record.action[k]);
    const Targets targets = targets_of(kPolicy, next, record.action);
    for (int body = 1; body < kBodyCount; ++body)
      for (int k = 0; k < 4; ++k) compare(targets.q[body][k], record.target_q[body][k]);
  }
  return worst;
}
)";

/// The head of a header. @param names  of the motions @param space  namespace of the example
std::string opening_for(const std::string& names, const std::string& space) {
  return std::string(kHeaderOpening) + " (" MIMICX_VERSION "): " + quoted(names) +
         ".\n"
         "// C++17; no heap, no exceptions, no other file.\n"
         "//\n"
         "//     auto body = " +
         space +
         "::reference(0);             // where the body starts\n"
         "//     for (int t = 0; t + 1 < " +
         space +
         "::kFrames; ++t) {\n"
         "//       auto targets = " +
         space +
         "::follow(t, body);   // for the PD controllers\n"
         "//       body = ...;                                       // a frame later, by your simulation\n"
         "//     }\n"
         "#pragma once\n\n#include <cmath>\n#include <cstdint>\n\n";
}

/// Data and functions of one policy, for the namespace of its own.
std::string policy_text(const ExportedPolicy& exported) {
  const motion::Reference& motion = exported.meant.motion;
  const physics::SimulationConfig& simulation = exported.meant.simulation;
  std::string out =
      "// ---- this policy -----------------------------------------------------------------------------\n\n";
  out += "inline constexpr char kName[] = " + quoted(motion.name) + ";\n";
  out += constant("int", "kFrames", std::to_string(exported.motion.frames), "of the motion");
  out += constant("double", "kFps", literal(exported.motion.fps),
                  "frames, and answers of the policy, per second");
  out +=
      constant("double", "kPhysicsRate", literal(simulation.rate), "steps per second that it was taught in");
  out += constant("double", "kGravity", literal(simulation.gravity), "m/s²");
  out += constant("double", "kFriction", literal(simulation.friction), "of the floor");
  out += constant("int", "kWidest", std::to_string(exported.widest()), "layer of the network");
  out += joints(motion.character);
  with_policy(exported, [&](const auto& policy) { out += policy_data_text(exported, policy); });
  out += records_of(exported);
  return out.append(kCalls);
}

}  // namespace

std::string namespace_of(const std::string& name) {
  std::string out = "policy_";
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain || out.back() != '_') out += plain ? c : '_';
  }
  return out;
}

std::string to_header(const ExportedPolicy& exported) {
  const std::string space = namespace_of(exported.meant.motion.name);
  return opening_for(exported.meant.motion.name, space) + runtime_in(space) + policy_text(exported) +
         "\n}  // namespace " + space + "\n";
}

std::string to_header(const std::vector<ExportedPolicy>& exported) {
  if (exported.size() == 1) return to_header(exported.front());
  const std::string all = "policies";
  std::string names, policies;
  std::set<std::string> spaces;
  for (const ExportedPolicy& one : exported) {
    const std::string& name = one.meant.motion.name;
    const std::string space = namespace_of(name);
    if (!spaces.insert(space).second)
      throw std::invalid_argument("two policies would be in the namespace " + space);
    names += (names.empty() ? "" : ", ") + name;
    policies += "namespace " + space + " {\nusing " + all + "::follow;\n" + policy_text(one) +
                "\n}  // namespace " + space + "\n\n";
  }
  return opening_for(names, all + "::" + *spaces.begin()) + runtime_in(all) + policies + "}  // namespace " +
         all + "\n";
}

}  // namespace mimicx::policy_export
