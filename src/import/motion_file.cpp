#include "import/motion_file.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "core/file.h"
#include "core/npz/npy_header.h"
#include "import/body_model.h"
#include "import/bvh.h"
#include "import/bvh_write.h"
#include "import/clip_checks.h"
#include "import/deepmimic.h"
#include "import/joint_positions.h"
#include "import/motionx.h"
#include "import/plausibility.h"
#include "import/retarget/retarget.h"
#include "import/world_transform.h"
#include "motion/clip_file.h"

namespace mimicx::import {
namespace {

constexpr double kOddRate = 1.25;  ///< factor between the file's frame rate and that of a fall
constexpr std::string_view kHierarchy = "hierarchy";  // in any case
constexpr std::size_t kHeaderBytes = 1024;            ///< an npy header fits in
constexpr std::size_t kFirstBytes = 64;               ///< bytes that identify a format
constexpr double kFarthest = 1e5;  ///< m from the origin: farther, differences of places lose their meaning
constexpr double kFloorWorthSaying = 0.05;  ///< m

void require_sense(const ReadConfig& o) {
  const auto require = [](bool sense, const char* what) {
    if (!sense) throw std::invalid_argument(what);
  };
  require(!o.scale || (*o.scale > 0.0 && std::isfinite(*o.scale)), "the scale must be positive");
  require(!o.fps || (*o.fps > 0.0 && *o.fps <= 2000.0), "the frame rate must lie between 0 and 2000 Hz");
  require(!o.floor || std::isfinite(*o.floor), "the height of the floor must be a number");
  if (o.up) rotation_to_z_up(*o.up);
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
  } else if (foreign) {
    clip.decisions.push_back("body: the standard one, the file's model is " + clip.body_model);
  }
}

void settle_scale(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.scale) {
    scale_world(*o.scale, clip);
    clip.decisions.push_back("scale: " + short_number(*o.scale) + " m per unit, as asked for");
    return;
  }
  if (believed) return;
  const double before = support_speed(clip), scale = detect_scale(clip);
  if (scale == 1.0) return;
  scale_world(scale, clip);
  clip.decisions.push_back("scale: the translation is taken to be in " +
                           std::string(scale == 0.01 ? "centimetres" : "millimetres") +
                           " (read as metres, the slower foot would move at " + short_number(before) +
                           " m/s; now it moves at " + short_number(support_speed(clip)) +
                           "; --scale overrides)");
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
  const UpAxis found = detect_up(clip);
  const char up = found.sure ? in_file(found.axis, custom) : custom;
  const std::string along = " (the body stands along it: " + short_number(found.along) + ")";
  turn_up(up);
  if (!found.sure)
    clip.decisions.push_back("up axis: " + axis_name(up) +
                             ", the default of the format (the body lies, crawls or turns over)");
  else if (found.axis == 'Z')
    clip.decisions.push_back("up axis: upside down, turned over" + along + "; --up overrides");
  else
    clip.decisions.push_back("up axis: " + axis_name(up) + (up == 'z' ? "" : ", turned to z") + along +
                             (up == custom ? "" : "; --up overrides"));
}

/// The frame rate next to `fps` of those in use, where one is within a tenth; else 0.
double usual_rate(double fps) {
  for (const double rate : {20.0, 24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 100.0, 120.0, 200.0, 240.0, 250.0})
    if (std::abs(fps / rate - 1.0) < 0.1) return rate;
  return 0.0;
}

/// Whether another frame rate adds no inhuman speeds to a motion.
bool is_plausible_at(double fps, const motion::Clip& clip) {
  motion::Clip other = clip;
  other.fps = fps;
  return implausible_speeds(other).empty();
}

void settle_fps(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.fps) {
    clip.decisions.push_back("frame rate: " + short_number(*o.fps) + " fps, as asked for (the file says " +
                             short_number(clip.fps) + ")");
    clip.fps = *o.fps;
    return;
  }
  if (believed) return;
  const std::optional<FallRate> fall = rate_from_flights(clip);
  const double factor = fall ? fall->fps / clip.fps : 1.0, usual = fall ? usual_rate(fall->fps) : 0.0;
  const std::string given = "frame rate: " + short_number(clip.fps) + " fps, as given";
  if (!fall) return clip.decisions.push_back(given);
  const std::string falls = std::to_string(fall->flights) + (fall->flights == 1 ? " flight" : " flights") +
                            ", in which the body falls with " + short_number(fall->acceleration) +
                            " m/s² at the file's rate";
  if (!(std::max(factor, 1.0 / factor) > kOddRate && usual > 0.0))
    return clip.decisions.push_back(given + " (" + falls + ")");
  if (fall->agreed && is_plausible_at(usual, clip)) {
    clip.decisions.push_back("frame rate: " + short_number(usual) + " fps, not " + short_number(clip.fps) +
                             " (" + falls + "; --fps overrides)");
    clip.fps = usual;
    return;
  }
  clip.decisions.push_back(given);
  clip.warnings.push_back("the frame rate may be " + short_number(usual) + " fps, not " +
                          short_number(clip.fps) + " (" + falls + "): --fps " + short_number(usual));
}

void settle_floor(const ReadConfig& o, bool believed, motion::Clip& clip) {
  if (o.floor) {
    shift_world({0.0, 0.0, -*o.floor}, clip);
    clip.on_floor = true;
    clip.decisions.push_back("floor: at " + short_number(*o.floor) + " m, as asked for");
    return;
  }
  if (believed) return;
  const double height = detect_floor(clip);
  if (std::abs(height) > kFloorWorthSaying)
    clip.decisions.push_back("floor: at " + short_number(height) +
                             " m, where the lowest points are; preparation puts it at 0 (--floor overrides)");
}

void require_near(const std::filesystem::path& path, const motion::Clip& clip) {
  for (int t = 0; t < clip.frames(); ++t)
    if (!(clip.trans[t].cwiseAbs().maxCoeff() < kFarthest))
      throw DataError(path.string(), "frame " + std::to_string(t), "a place within 100 km of the origin",
                      short_number(clip.trans[t].cwiseAbs().maxCoeff()) + " m");
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The usual name of a unit of length.
std::string unit_name(double metres) {
  for (const auto& [name, size] : {std::pair("metres", 1.0), {"centimetres", 0.01}, {"millimetres", 0.001}})
    if (std::abs(metres / size - 1.0) < 1e-6) return name;
  return "unit " + short_number(metres) + " m";
}

/// Summary of the decisions about a foreign skeleton, in three lines.
std::vector<std::string> summary_of(const std::string& format, const RetargetReport& report, bool standard,
                                    double fps) {
  const std::string rate = short_number(fps) + " frames per second, ";
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
  config.joint_map = o.joint_map;
  RetargetReport report;
  motion::Clip clip = retarget(motion, config, &report);
  clip.decisions.insert(clip.decisions.begin(), "format: " + format);
  if (!o.verbose) clip.summary = summary_of(format, report, o.standard_body, o.fps.value_or(clip.fps));
  return clip;
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

motion::Clip read_any(const std::string& bytes, const std::filesystem::path& path, const ReadConfig& o) {
  const std::string name = path.stem().string();
  if (is_pickled(bytes, path))
    throw DataError(path.string(), "", "a motion (npz, npy, BVH or DeepMimic)",
                    "a Python pickle: tools/convert_video_results.py converts results of GVHMR, WHAM and "
                    "TRAM");
  switch (recognise(bytes)) {
    case MotionFormat::kNpz: {
      motion::Clip clip = motion::clip_from(parse_npz(bytes, path.string()), name);
      clip.decisions.insert(clip.decisions.begin(), "format: AMASS-like npz, body model " + clip.body_model);
      return clip;
    }
    case MotionFormat::kNpy: {
      const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
      const NpyArray array = parse_npy(data, bytes.size(), path.string(), "");
      if (!is_positions(array.shape)) return motionx_from(array, name, path.string(), !o.scale);
      return retargeted(skeleton_of_positions(array, name, path.string()),
                        array.shape.size() == 2 ? "HumanML3D features" : "joint positions", o);
    }
    case MotionFormat::kBvh:
      return retargeted(parse_bvh(bytes, path), "BVH", o);
    case MotionFormat::kDeepMimic:
      return retargeted(parse_deepmimic(bytes, path), "DeepMimic", o);
    case MotionFormat::kUnknown:
      break;
  }
  throw DataError(path.string(), "", "a motion (npz, npy, BVH or DeepMimic)",
                  bytes.empty() ? "an empty file" : "other content");
}

/// The first bytes of a file. None for a pipe, because opening it would wait for a writer.
std::string first_bytes(const std::filesystem::path& path, std::size_t count) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return {};
  std::string bytes(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace

std::string ReadConfig::text() const {
  std::string out;
  const auto add = [&](const std::string& what) { out += (out.empty() ? "" : " ") + what; };
  const auto number = [&](const char* name, const std::optional<double>& value) {
    char digits[64];
    if (!value) return;
    std::snprintf(digits, sizeof digits, "%s=%.17g", name, *value);
    add(digits);
  };
  if (up) add("up=" + axis_name(*up));
  number("scale", scale);
  number("fps", fps);
  number("floor", floor);
  if (standard_body) add("body=standard");
  if (!smplx.empty()) add("smplx=" + smplx.string());
  if (!joint_map.empty()) add("joint_map=" + joint_map.string());
  return out;
}

MotionFormat recognise(const std::string& bytes) {
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06")) return MotionFormat::kNpz;
  if (bytes.starts_with("\x93NUMPY")) return MotionFormat::kNpy;
  const std::size_t bom = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0,
                    start = bytes.find_first_not_of(" \t\r\n", bom);
  if (start == std::string::npos) return MotionFormat::kUnknown;
  if (bytes[start] == '{') return MotionFormat::kDeepMimic;
  if (lower_case(bytes.substr(start, kHierarchy.size())) == kHierarchy) return MotionFormat::kBvh;
  return MotionFormat::kUnknown;
}

motion::Clip read_motion(const std::filesystem::path& path, const ReadConfig& config) {
  return motion_from(read_file(path), path, config);
}

motion::Clip motion_from(const std::string& bytes, const std::filesystem::path& path,
                         const ReadConfig& config) {
  require_sense(config);
  motion::Clip clip = read_any(bytes, path, config);
  repair_angles(path.string(), clip);
  const MotionFormat format = recognise(bytes);
  const bool positions = format == MotionFormat::kNpy && is_positions(header_shape(bytes));
  const bool skeleton = positions || format == MotionFormat::kBvh || format == MotionFormat::kDeepMimic;
  const bool believed = !skeleton && (clip.body_model == "mimicx" || clip.rest_joints.has_value());
  if (!skeleton) {
    choose_body(config, clip);
    settle_scale(config, believed, clip);
    settle_up(config, believed, format == MotionFormat::kNpy ? 'y' : 'z', clip);
  }
  const double fps = clip.fps;
  settle_fps(config, believed, clip);
  const bool relabelled = !config.fps && clip.fps != fps;  // worth every line
  settle_floor(config, believed, clip);
  if (!believed) remove_t_pose(clip);
  warn_of_jumps(clip);
  if (!believed)
    for (const std::string& speed : implausible_speeds(clip)) clip.warnings.push_back(speed);
  require_near(path, clip);
  require_in_view(path.string(), clip);
  if (relabelled) clip.summary.clear();
  return clip;
}

bool holds_positions(const std::filesystem::path& path) {
  const std::string start = first_bytes(path, kHeaderBytes);
  return recognise(start) == MotionFormat::kNpy && is_positions(header_shape(start));
}

bool is_motion_file(const std::filesystem::path& path) {
  const std::string suffix = lower_suffix(path);
  if (suffix == ".txt") return recognise(first_bytes(path, kFirstBytes)) == MotionFormat::kDeepMimic;
  return is_written(suffix);
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
    motion::write_clip(path, clip);
  else if (suffix == ".npy")
    write_motionx(path, clip);
  else if (suffix == ".bvh")
    write_bvh(path, clip);
  else
    throw std::invalid_argument(path.string() + ": motions are written as " + written_suffixes() + ", not '" +
                                suffix + "'");
}

}  // namespace mimicx::import
