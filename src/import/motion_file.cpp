#include "import/motion_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "core/error.h"
#include "core/file.h"
#include "core/npz/npy_header.h"
#include "core/number_text.h"
#include "import/body_model.h"
#include "import/bvh.h"
#include "import/bvh_write.h"
#include "import/clip_checks.h"
#include "import/content_words.h"
#include "import/deepmimic.h"
#include "import/evidence/angle_unit.h"
#include "import/evidence/frame_rate.h"
#include "import/evidence/scene_lift.h"
#include "import/evidence/sides.h"
#include "import/evidence/translation_unit.h"
#include "import/evidence/up_axis.h"
#include "import/joint_positions.h"
#include "import/motionx.h"
#include "import/opensim/marker_joints.h"
#include "import/plausibility.h"
#include "import/retarget/person.h"
#include "import/retarget/retarget.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"

namespace mimicx::import {
namespace {

constexpr double kOddRate = 1.25;  ///< factor between the file's frame rate and that of a fall
constexpr std::string_view kHierarchy = "hierarchy";  // in any case
constexpr std::string_view kPathFileType = "PathFileType";
constexpr std::size_t kHeaderBytes = 1024;  ///< an npy header fits in
constexpr std::size_t kFirstBytes = 1024;   ///< bytes that identify a format
constexpr double kFarthest = 1e5;  ///< m from the origin: farther, differences of places lose their meaning
constexpr const char* kMotions = "a motion (npz, npy, BVH, DeepMimic or .trc)";
constexpr const char* kConverter =
    "tools/convert_video_results.py converts results of video estimators, and MDM's results.npy";
constexpr double kFloorWorthSaying = 0.05;  ///< m

bool decided(const char* line, const motion::Clip& clip) {
  return std::find(clip.decisions.begin(), clip.decisions.end(), line) != clip.decisions.end();
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void require_sense(const ReadConfig& o) {
  const auto require = [](bool sense, const char* what) {
    if (!sense) throw std::invalid_argument(what);
  };
  require(!o.scale || (*o.scale > 0.0 && std::isfinite(*o.scale)), "the scale must be positive");
  require(!o.fps || (*o.fps > 0.0 && *o.fps <= 2000.0), "the frame rate must lie between 0 and 2000 Hz");
  require(!o.mass || (*o.mass > 0.0 && std::isfinite(*o.mass)), "the mass must be positive");
  require(!o.height || (*o.height > 0.0 && std::isfinite(*o.height)), "the height must be positive");
  require(!o.floor || std::isfinite(*o.floor), "the height of the floor must be a number");
  if (o.up) rotation_to_z_up(*o.up);
}

KnownBody known_body(const ReadConfig& o) {
  KnownBody known;
  if (o.mass) known.mass = *o.mass;
  if (o.height) known.height = *o.height;
  return known;
}

/// The gender that a text names: "female", "male", or none.
std::string gender_in(const std::string& text) {
  for (const char* gender : {"female", "male"})  // the second is part of the first
    if (lower_case(text).find(gender) != std::string::npos) return gender;
  return "";
}

/// A male and a female model have shapes of their own, so betas of one mean nothing in another.
void warn_of_gender(const std::filesystem::path& model, motion::Clip& clip) {
  const std::string gender = gender_in(clip.gender), file = model.filename().string();
  if (gender.empty() || gender == gender_in(file)) return;
  clip.warnings.push_back("the betas are of the " + gender + " model: " + file + " must be that model");
}

/// Chooses the body: the standard one, the joints of the licensed model, or the file's own body.
void choose_body(const ReadConfig& o, motion::Clip& clip) {
  const bool foreign = clip.body_model != "mimicx";
  if (o.standard_body) {
    const Vector3d pelvis = motion::rest_pelvis(clip);
    clip.rest_joints.reset();
    clip.betas = {};
    for (Vector3d& trans : clip.trans) trans += pelvis - motion::rest_pelvis(clip);
    std::erase(clip.warnings, motion::foreign_betas_warning(clip.body_model));
    clip.decisions.emplace_back("body: the standard one, as asked for");
  } else if (clip.rest_joints) {
    clip.decisions.emplace_back("body: the joints that the file holds");
  } else if (foreign && !o.smplx.empty() && clip.body_model == "smplx") {
    const RestJoints joints = read_body_model(o.smplx).joints(clip.betas);
    try {
      make_character_of_joints(joints);
    } catch (const std::invalid_argument& error) {
      throw DataError(o.smplx.string(), "", "the joints of a human for the betas of " + clip.name,
                      error.what());
    }
    clip.rest_joints = joints;
    std::erase(clip.warnings, motion::foreign_betas_warning(clip.body_model));
    clip.decisions.push_back("body: joints of " + o.smplx.filename().string() + " at the file's betas");
    warn_of_gender(o.smplx, clip);
  } else if (foreign) {
    clip.decisions.push_back("body: the standard one, the file's model is " + clip.body_model);
  }
  if (!o.mass && !o.height) return;
  if (clip.rest_joints) {
    clip.warnings.emplace_back("--mass and --height change no body whose joints are known");
  } else if (foreign) {
    clip.warnings.emplace_back("--mass and --height change no body of another body model");
  } else {
    clip.decisions.push_back(settle_body(known_body(o), clip.betas));
    for (const std::string& warning :
         {mass_warning(known_body(o), clip.betas), height_warning(known_body(o), clip.betas)})
      if (!warning.empty()) clip.warnings.push_back(warning);
  }
}

void settle_scale(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.scale) {
    scale_world(*o.scale, clip);
    clip.decisions.push_back("scale: " + short_number(*o.scale) + " m per unit, as asked for");
    return;
  }
  if (believed) return;
  const TranslationUnit unit = decide_translation_unit(clip);
  if (unit.metres != 1.0) {
    clip.decisions.push_back("scale: the translation is taken to be in " + unit.name +
                             " (read as metres, the slower foot would move at " +
                             short_number(support_speed(clip)) + " m/s; now it moves at " +
                             short_number(unit.support_speed) + " m/s; --scale overrides)");
    scale_world(unit.metres, clip);
  }
  if (!unit.near.empty())
    clip.warnings.push_back("the translation may be in " + unit.near + ", not in " + unit.name +
                            ": --scale " + short_number(unit.near_metres));
}

/// The file's axis that is `axis` now, after the reader has turned `custom` to z.
char in_file(char axis, char custom) {
  return axis_letter(rotation_to_z_up(custom).conjugate() *
                     (rotation_to_z_up(axis).conjugate() * Vector3d::UnitZ()));
}

/// @param custom  the format's up axis, which the reader has turned to z
void settle_up(const ReadConfig& o, bool believed, char custom, motion::Clip& clip) {
  const auto turn_up = [&](char axis) {
    if (axis != custom) rotate_world(rotation_to_z_up(axis) * rotation_to_z_up(custom).conjugate(), clip);
  };
  if (o.up) {
    turn_up(*o.up);
    clip.decisions.push_back("up axis: " + axis_name(*o.up) + ", as asked for");
    return;
  }
  if (believed) return;
  UpDecision found = decide_up(landmarks_of(motion::poses_of(clip)), std::nullopt, 'z');
  const bool upside_down = found.axis == 'Z';
  found.axis = in_file(found.axis, custom);
  found.second = in_file(found.second, custom);
  turn_up(found.axis);
  clip.decisions.push_back("up axis: " +
                           (upside_down
                                ? std::string("upside down, turned over")
                                : axis_name(found.axis) + (found.axis == 'z' ? "" : ", turned to z")) +
                           " (" + found.why + (found.axis == custom ? ")" : "); --up overrides"));
  if (found.is_near()) clip.warnings.push_back(near_up_warning(found));
}

/// Whether another frame rate adds no inhuman speeds to a motion.
bool is_plausible_at(double fps, const motion::Clip& clip) {
  motion::Clip other = clip;
  other.fps = fps;
  return implausible_speeds(other).empty();
}

void settle_fps(const ReadConfig& o, bool believed, motion::Clip& clip) {
  const bool motionx = decided(kMotionxFormat, clip), assumed = motionx || decided(kAssumedRate, clip);
  if (o.fps) {
    std::erase(clip.decisions, kAssumedRate);
    clip.decisions.push_back(
        "frame rate: " + rate_text(*o.fps) + " fps, as asked for" +
        (assumed || clip.fps == *o.fps ? "" : " (the file says " + rate_text(clip.fps) + ")"));
    clip.fps = *o.fps;
    return;
  }
  if (believed) return;
  const std::optional<FallRate> fall = rate_from_flights(clip);
  const double factor = fall ? fall->fps / clip.fps : 1.0, usual = fall ? usual_rate(fall->fps) : 0.0;
  const std::string given = "frame rate: " + rate_text(clip.fps) +
                            (motionx   ? " fps, that of Motion-X, assumed: the file tells none"
                             : assumed ? " fps, as assumed"
                                       : " fps, as given");
  const std::string falls = !fall ? ""
                                  : counted(fall->flights, "flight") + ", in which the body falls with " +
                                        short_number(fall->acceleration) + " m/s² at the file's rate";
  const bool other = fall && std::max(factor, 1.0 / factor) > kOddRate && usual > 0.0;
  if (other && fall->agreed && is_plausible_at(usual, clip)) {
    clip.decisions.push_back("frame rate: " + rate_text(usual) + " fps, not " + rate_text(clip.fps) + " (" +
                             falls + "; --fps overrides)");
    clip.fps = usual;
    return;
  }
  clip.decisions.push_back(given + (fall && !other ? " (" + falls + ")" : ""));
  if (other && fall->clear)
    clip.warnings.push_back("the frame rate may be " + rate_text(usual) + " fps, not " + rate_text(clip.fps) +
                            " (" + falls + "): --fps " + rate_text(usual));
  for (const std::string& odd : odd_rate_warnings(clip.fps, clip.frames())) clip.warnings.push_back(odd);
}

void settle_floor(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.floor) {
    shift_world({0.0, 0.0, -*o.floor}, clip);
    clip.on_floor = true;
    clip.decisions.push_back("floor: at " + short_number(*o.floor) + " m, as asked for");
    return;
  }
  if (believed || !clip.scene.flat()) return;
  const double height = detect_floor(clip);
  if (std::abs(height) > kFloorWorthSaying)
    clip.decisions.push_back("floor: at " + short_number(height) +
                             " m, where the lowest points are; preparation puts it at 0 (--floor overrides)");
}

/// Takes the scene that was asked for, and puts a motion whose height is not believed onto its scene.
void settle_scene(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.scene) clip.scene = *o.scene;
  if (clip.scene.flat()) return;
  double highest = 0.0;
  for (const Plate& plate : clip.scene.plates) highest = std::max(highest, plate.height);
  std::string said =
      "scene: " + counted(clip.scene.plates.count(), "plate") + " up to " + short_number(highest) + " m";
  const double lift = believed || o.floor ? 0.0 : scene_lift(clip);
  if (lift != 0.0) {
    shift_world({0.0, 0.0, lift}, clip);
    said += "; the motion is moved " + short_number(std::abs(lift)) + " m " + (lift < 0.0 ? "down" : "up") +
            " onto it";
  }
  clip.decide(said);
}

/// The simulation has single precision, which resolves 2 mm at 20 km. A motion that begins over 50 m from the
/// origin is moved there, by a multiple of 100 m. Each is moved by itself: motions that belong together stay
/// together only where they begin on the same side of such an edge.
void settle_place(motion::Clip& clip) {
  const Vector3d hundreds = (clip.trans.front() / kMove).array().round();
  const Vector3d shift(0.0 - kMove * hundreds.x(), 0.0 - kMove * hundreds.y(), 0.0);  // not -0
  if (shift.isZero(0.0)) return;
  shift_world(shift, clip);
  clip.place = shift;
  clip.decide(formatted("place: moved by (%.0f, %.0f) m to the origin", shift.x(), shift.y()));
}

void require_near(const std::filesystem::path& path, const motion::Clip& clip) {
  for (int t = 0; t < clip.frames(); ++t)
    if (!(clip.trans[t].cwiseAbs().maxCoeff() < kFarthest))
      throw DataError(path.string(), "frame " + std::to_string(t), "a place within 100 km of the origin",
                      short_number(clip.trans[t].cwiseAbs().maxCoeff()) + " m");
}

/// The usual name of a unit of length.
std::string unit_name(double metres) {
  for (const auto& [name, size] : {std::pair("metres", 1.0), {"centimetres", 0.01}, {"millimetres", 0.001}})
    if (std::abs(metres / size - 1.0) < 1e-6) return name;
  return "unit " + short_number(metres) + " m";
}

/// Summary of the decisions about a foreign skeleton, in three lines.
std::vector<std::string> summary_of(const std::string& format, const RetargetReport& report, bool standard,
                                    const std::string& fps) {
  const std::string rate = fps + ", ";
  if (report.own) return {format + " of this program: " + rate + "y up, metres"};
  return {format + ": " + rate + axis_name(report.up) + " up, " + unit_name(report.scale),
          std::string(standard ? "standard body" : "body shape fitted") + ", joints " +
              short_number(report.mean_residual_mm) +
              " mm from the skeleton's on average; neutral pose: " + report.neutral,
          "moved " + short_number(std::abs(report.lift)) + " m " + (report.lift < 0.0 ? "down" : "up") +
              " to the floor; --verbose lists every decision"};
}

/// Retargets the motion of a foreign skeleton to our body.
motion::Clip retargeted(const SkeletonMotion& motion, const std::string& format, const ReadConfig& o) {
  RetargetConfig config;
  config.standard_body = o.standard_body;
  config.scale = o.scale.value_or(0.0);
  config.up = o.up;
  config.known = known_body(o);
  config.joint_map = o.joint_map;
  RetargetReport report;
  motion::Clip clip = retarget(motion, config, &report);
  clip.decisions.insert(clip.decisions.begin(), "format: " + format);
  const bool assumed = !o.fps && decided(kAssumedRate, clip);
  const std::string fps = rate_text(o.fps.value_or(clip.fps)) + " frames per second";
  if (o.verbose) return clip;
  clip.summary =
      summary_of(format, report, o.standard_body, fps + (assumed ? " (assumed: --fps overrides)" : ""));
  for (const std::string& line : clip.decisions)  // about frames that are left out
    if (line == kTPoseRemoved || line.ends_with(kPaddingLeftOut)) clip.summary.push_back(line);
  return clip;
}

/// The skeleton of the person in a BVH, with its rotations in the unit in which they are.
SkeletonMotion read_skeleton(const std::string& bytes, const std::filesystem::path& path,
                             const ReadConfig& o) {
  const auto parse = [&](bool radians) {
    return person_of(parse_bvh(bytes, path, {o.fps, radians}), o.root, o.joint_map);
  };
  SkeletonMotion motion = parse(false);
  if (!may_be_radians(motion.largest_angle)) return motion;
  SkeletonMotion other = parse(true);
  const JointMap map = map_joints(motion, o.joint_map);
  const AngleUnit unit =
      decide_angle_unit(landmarks_of(motion, map), landmarks_of(other, map), motion.largest_angle);
  const std::string largest = "no rotation of the file exceeds " + short_number(motion.largest_angle);
  if (unit == AngleUnit::kUnsure) motion.warnings.push_back(largest + ", read as degrees: are they radians?");
  if (unit != AngleUnit::kRadians) return motion;
  other.warnings.push_back("rotations are taken to be radians, not degrees (" + largest +
                           "; as degrees the body would hardly bend)");
  return other;
}

/// The shape in an npy header; empty where it is damaged.
std::vector<std::size_t> header_shape(const std::string& bytes) {
  try {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return parse_npy_header(data, bytes.size(), "", "").shape;
  } catch (const std::exception&) {  // the reader reports the error
    return {};
  }
}

/// Whether a file is a Python pickle, alone or in an archive of torch, as results of video estimators are.
bool is_pickled(const std::string& bytes, const std::filesystem::path& path) {
  const std::string suffix = lower_case(path.extension().string());
  return suffix == ".pt" || suffix == ".pth" || suffix == ".pkl" || bytes.starts_with("\x80");
}

/// Archives alone can have several people, and their reader counts them.
void require_person(MotionFormat format, const std::filesystem::path& path, const ReadConfig& o) {
  if (!o.person || *o.person == 1 || format == MotionFormat::kNpz || format == MotionFormat::kUnknown) return;
  throw DataError(path.string(), "", "people 1 to " + std::to_string(*o.person), "one person");
}

motion::Clip read_any(const std::string& bytes, const std::filesystem::path& path, const ReadConfig& o) {
  const std::string name = path.stem().string();
  if (is_pickled(bytes, path))
    throw DataError(path.string(), "", kMotions, "a Python pickle: " + std::string(kConverter));
  const MotionFormat format = recognise(bytes);
  require_person(format, path, o);
  switch (format) {
    case MotionFormat::kNpz: {
      motion::Clip clip = motion::clip_from(parse_npz(bytes, path.string()), name, {o.fps, o.person});
      clip.decisions.insert(clip.decisions.begin(), "format: AMASS-like npz, body model " + clip.body_model);
      return clip;
    }
    case MotionFormat::kNpy: {
      const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
      const NpyArray array = [&] {
        try {
          return parse_npy(data, bytes.size(), path.string(), "");
        } catch (const UnsupportedArray& why) {
          if (bytes.find("'descr': '|O'") == std::string::npos) throw;
          throw DataError(path.string(), "", kMotions,
                          "an object array, a Python pickle: " + std::string(kConverter));
        }
      }();
      if (!is_positions(array.shape)) return motionx_from(array, name, path.string(), !o.scale);
      return retargeted(skeleton_of_positions(array, name, path.string()),
                        array.shape.size() == 2 ? "HumanML3D features" : "joint positions", o);
    }
    case MotionFormat::kBvh:
      return retargeted(read_skeleton(bytes, path, o), "BVH", o);
    case MotionFormat::kDeepMimic:
      return retargeted(parse_deepmimic(bytes, path, o.fps), "DeepMimic", o);
    case MotionFormat::kMarkers: {
      ReadConfig metric = o;
      metric.scale.reset();
      return retargeted(skeleton_of_markers(bytes, name, path.string(), o.up, o.scale), "markers", metric);
    }
    case MotionFormat::kUnknown:
      break;
  }
  throw DataError(path.string(), "", kMotions, content_in_words(bytes));
}

/// Whether nothing is detected in an archive: it has our own layout, or says that this program wrote it.
bool is_believed(const ReadConfig& o, motion::Clip& clip) {
  if (clip.has_simulated_body()) return true;
  if (!motion::is_in_our_world(clip)) return false;
  if (!o.up && !o.scale) clip.decisions.emplace_back("world: z up, metres, as this program wrote it");
  return true;
}

void write_archive(const std::filesystem::path& path, const motion::Clip& clip) {
  std::vector<std::pair<std::string, NpyArray>> members = motion::world_members(clip);
  members.insert(members.begin(), {"joints", motion::joint_positions_member(clip)});
  motion::write_clip(path, clip, members);
}

/// A simulated motion keeps its frame rate, axes, unit and floor, to which its forces belong: the settings
/// are for the files beside it, such as the truth that it is compared with.
ReadConfig settings_for(motion::Clip& clip, ReadConfig config) {
  const bool simulated = clip.is_simulated();
  if (simulated && config.forces_keep_body) {
    config.mass.reset();
    config.height.reset();
    config.standard_body = false;
  }
  if (!simulated || !(config.fps || config.up || config.scale || config.floor)) return config;
  clip.decisions.emplace_back("simulated: keeps the frame rate, axes, unit and floor of its forces");
  config.fps.reset();
  config.up.reset();
  config.scale.reset();
  config.floor.reset();
  return config;
}

/// What the numbers belong to that a simulation records beside a motion.
auto recorded_with(const motion::Clip& clip) {
  return std::tuple(clip.fps, clip.rotations, clip.trans, clip.betas, clip.rest_joints, clip.scene);
}

}  // namespace

std::string ReadConfig::text() const {
  std::string out;
  const auto add = [&](const std::string& what) { out += (out.empty() ? "" : " ") + what; };
  const auto number = [&](const char* name, const std::optional<double>& value) {
    if (value) add(formatted("%s=%.17g", name, *value));
  };
  if (up) add("up=" + axis_name(*up));
  number("scale", scale);
  number("fps", fps);
  number("floor", floor);
  number("mass", mass);
  number("height", height);
  if (standard_body) add("body=standard");
  if (!smplx.empty()) add("smplx=" + smplx.string());
  if (!joint_map.empty()) add("joint_map=" + joint_map.string());
  if (!root.empty()) add("root=" + root);
  if (person) add("person=" + std::to_string(*person));
  if (scene_from_motion) add("scene=auto");
  if (scene) {
    std::string plates;
    for (const Plate& p : scene->plates) {
      plates += plates.empty() ? "" : ";";
      for (const double value : {p.centre.x(), p.centre.y(), p.yaw, p.half_extents.x(), p.half_extents.y(),
                                 p.height, p.stiffness, p.damping})
        plates += (plates.empty() || plates.back() == ';' ? "" : ",") + text_of(value);
    }
    add("scene=" + plates);
  }
  return out;
}

MotionFormat recognise(const std::string& bytes) {
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06")) return MotionFormat::kNpz;
  if (bytes.starts_with("\x93NUMPY")) return MotionFormat::kNpy;
  const std::size_t bom = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  std::size_t start = bytes.find_first_not_of(" \t\r\n", bom);
  while (start != std::string::npos && (bytes[start] == '#' || bytes.compare(start, 2, "//") == 0))
    start = bytes.find_first_not_of(" \t\r\n", bytes.find_first_of("\r\n", start));
  if (start == std::string::npos) return MotionFormat::kUnknown;
  if (bytes[start] == '{') return MotionFormat::kDeepMimic;
  if (bytes.compare(start, kPathFileType.size(), kPathFileType) == 0) return MotionFormat::kMarkers;
  if (lower_case(bytes.substr(start, kHierarchy.size())) == kHierarchy) return MotionFormat::kBvh;
  return MotionFormat::kUnknown;
}

motion::Clip read_motion(const std::filesystem::path& path, const ReadConfig& config) {
  try {
    return motion_from(read_file(path), path, config);
  } catch (const std::bad_alloc& error) {
    throw DataError(path.string(), "", "a motion that fits into memory", reason_of(error));
  }
}

std::vector<std::string> told_decisions(const std::string& file, const motion::Clip& clip) {
  std::vector<std::string> told;
  for (const auto* lines : {clip.summary.empty() ? &clip.decisions : &clip.summary, &clip.warnings})
    for (const std::string& line : *lines) told.push_back(file + ": " + line);
  return told;
}

std::vector<std::string> notable_decisions(const std::string& file, const motion::Clip& clip) {
  std::vector<std::string> told = told_decisions(file, clip);
  const std::vector<std::string>& decisions = clip.summary.empty() ? clip.decisions : clip.summary;
  if (decisions.size() == 1 && decisions.front().starts_with("format: ")) told.erase(told.begin());
  return told;
}

motion::Clip motion_from(const std::string& bytes, const std::filesystem::path& path,
                         const ReadConfig& asked) {
  require_sense(asked);
  motion::Clip clip = read_any(bytes, path, asked);
  const ReadConfig config = settings_for(clip, asked);
  repair_angles(path.string(), clip);
  const bool may_change = !asked.text().empty();
  const auto recorded = may_change ? std::optional(recorded_with(clip)) : std::nullopt;
  const MotionFormat format = recognise(bytes);
  const bool positions = format == MotionFormat::kNpy && is_positions(header_shape(bytes));
  const bool skeleton = positions || format == MotionFormat::kBvh || format == MotionFormat::kDeepMimic ||
                        format == MotionFormat::kMarkers;
  const bool believed = !skeleton && is_believed(config, clip);
  if (!skeleton) {
    choose_body(config, clip);
    settle_scale(config, believed, clip);
    settle_up(config, believed, format == MotionFormat::kNpy ? 'y' : 'z', clip);
    if (!believed && bends_backwards(clip))
      clip.warnings.emplace_back(
          "elbows or knees bend backwards: are left and right exchanged, or the world left-handed?");
  }
  const double fps = clip.fps;
  if (!config.fps) require_no_time_step(path.string(), fps);
  settle_fps(config, believed, clip);
  const bool relabelled = !config.fps && clip.fps != fps;  // worth every line
  settle_scene(config, believed, clip);
  settle_floor(config, believed, clip);
  if (const std::string doubt = scene_doubt(clip); !doubt.empty()) clip.warnings.push_back(doubt);
  clip.as_recorded = !may_change || recorded_with(clip) == *recorded;
  require_near(path, clip);
  if (clip.frames() > 0) settle_place(clip);
  if (!believed) remove_t_pose(clip);
  warn_of_jumps(clip);
  if (!believed)
    for (const std::string& speed : implausible_speeds(clip)) clip.warnings.push_back(speed);
  require_in_view(path.string(), clip);
  if (relabelled) clip.summary.clear();
  return clip;
}

bool holds_positions(const std::filesystem::path& path) {
  const std::string start = read_bytes(path, 0, kHeaderBytes);
  return recognise(start) == MotionFormat::kNpy && is_positions(header_shape(start));
}

bool is_motion_file(const std::filesystem::path& path) {
  const std::string suffix = lower_suffix(path);
  if (suffix == ".txt") {
    const MotionFormat format = recognise(read_bytes(path, 0, kFirstBytes));
    return format == MotionFormat::kDeepMimic || format == MotionFormat::kBvh;
  }
  return is_written(suffix) || suffix == ".trc";
}

std::string lower_suffix(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

bool is_written(const std::string& suffix) {
  const std::string known = lower_case(suffix);
  return known == ".npz" || known == ".npy" || known == ".bvh";
}

std::string written_suffixes() { return ".npz, .npy or .bvh"; }

std::string_view written_opening(const std::filesystem::path& path) {
  const std::string suffix = lower_suffix(path);
  return suffix == ".bvh" ? kBvhOpening : suffix == ".npy" ? kMotionxOpening : std::string_view();
}

void write_motion(const std::filesystem::path& path, const motion::Clip& clip) {
  const std::string suffix = lower_suffix(path);
  if (suffix == ".npz")
    write_archive(path, clip);
  else if (suffix == ".npy")
    write_motionx(path, clip);
  else if (suffix == ".bvh")
    write_bvh(path, clip);
  else
    throw std::invalid_argument(path.string() + ": motions are written as " + written_suffixes() + ", not '" +
                                suffix + "'");
}

}  // namespace mimicx::import
