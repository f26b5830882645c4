#include "judge/forces/force_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "audit/audit_file.h"
#include "audit/chatter.h"
#include "core/error.h"
#include "core/file.h"
#include "core/number_text.h"
#include "core/units.h"
#include "files/floor_forces.h"
#include "judge/evaluate.h"
#include "judge/forces/moment_comparison.h"
#include "judge/forces/paired_series.h"
#include "judge/forces/planar_moments.h"
#include "motion/clip_file.h"
#include "record/json.h"

namespace mimicx::judge {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kStance = 0.05;     ///< of the weight; a foot with more stands
constexpr double kPressed = 0.2;     ///< of the weight; less has no centre of pressure to compare
constexpr double kLeastSample = 15;  ///< N; a sample with less says nothing of the centre of pressure
constexpr int kFewestFrames = 4;     ///< of a stance, and more than which double support must have
constexpr int kAround = 3;           ///< frames around a stance in which the other force may have its peak

/// Forces of both feet on one time base, in body weights, and what they press on.
struct FeetSeries {
  PerFrame<Array<Vector3d, 2>> force;     ///< (forward, left, up) of the hips, body weights
  PerFrame<Array<Vector3d, 2>> newtons;   ///< world axes, N
  PerFrame<Vector3d> rest;                ///< force on the rest of the body, world axes, N
  PerFrame<Array<Vector3d, 2>> pressure;  ///< m; not finite: none
  PerFrame<Array<bool, 2>> valid;
  PerFrame<PerBody<Vector3d>> joints;  ///< at the frames, m
  double mass = 0.0;                   ///< kg

  int frames() const { return force.count(); }
  Vector3d total(int t) const { return force[t][0] + force[t][1]; }
  double load(int t) const { return (newtons[t][0] + newtons[t][1] + rest[t]).z(); }  ///< of the body, N
};

/// At the middles of the intervals that end at the frames; of the first frame as far before it.
PerFrame<PerBody<Vector3d>> midway(const PerFrame<PerBody<Vector3d>>& joints) {
  PerFrame<PerBody<Vector3d>> middle = joints;
  for (int t = 0; t < joints.count() && joints.count() > 1; ++t)
    for (int b = 0; b < kBodies; ++b)
      middle[t][b] = joints[t][b] - 0.5 * (joints[std::max(t, 1)][b] - joints[std::max(t, 1) - 1][b]);
  return middle;
}

FeetSeries simulated_series(const audit::SimulatedFrames& motion) {
  FeetSeries series;
  series.mass = motion.character.total_mass();
  for (const motion::ReferenceFrame& frame : motion.frames)
    series.joints.push_back(forward_kinematics(motion.character, frame.p_root, frame.q).p_WB);
  const PerFrame<PerBody<Vector3d>> middle = midway(series.joints);
  for (int t = 0; t < middle.count(); ++t) {
    const auto wrenches = files::floor_wrenches(motion.forces[static_cast<std::size_t>(t)].ground, middle[t]);
    series.rest.push_back(wrenches[files::kOnTheRest].tail<3>());
    auto& force = series.newtons.emplace_back();
    auto& pressure = series.pressure.emplace_back();
    for (int foot = 0; foot < 2; ++foot) {
      const files::Carrier carrier = foot == 0 ? files::kOnLeftFoot : files::kOnRightFoot;
      const Vector6d& wrench = wrenches[carrier];
      force[foot] = wrench.tail<3>();
      const double height = files::ground_under(carrier, middle[t], motion.scene).z();
      pressure[foot] = wrench[5] > files::kLeastLoad ? files::centre_of_pressure(wrench, height)
                                                     : Vector3d(Vector3d::Constant(kNone));
    }
    series.valid.push_back({true, true});
  }
  return series;
}

/// Means over the intervals; a centre of pressure by the vertical force of its samples.
FeetSeries measured_series(const import::MeasuredForces& measured, double fps, int frames) {
  FeetSeries series;
  const double begin = time_of_first_frame(measured.samples.front().time, fps),
               last = measured.samples.back().time - begin;
  std::size_t next = 0;
  for (int t = 0; t < frames && t <= fps * last + 1e-6; ++t) {
    Array<Vector3d, 2> force, pressed;
    Vector3d rest = Vector3d::Zero();
    force.fill(Vector3d::Zero());
    pressed.fill(Vector3d::Zero());
    Array<double, 2> load{};
    Array<bool, 2> valid = {t > 0, t > 0};
    int count = 0;
    for (; next < measured.samples.size(); ++next) {
      const import::ForceSample& sample = measured.samples[next];
      if (sample.time - begin > t / fps + 1e-6) break;
      if (t == 0) continue;
      ++count;
      rest += sample.rest;
      for (int foot = 0; foot < 2; ++foot) {
        force[foot] += sample.force[foot];
        valid[foot] = valid[foot] && sample.valid[foot];
        const double vertical = sample.force[foot].z();
        if (!(vertical > kLeastSample) || !sample.pressure[foot].allFinite()) continue;
        pressed[foot] += vertical * sample.pressure[foot];
        load[foot] += vertical;
      }
    }
    for (int foot = 0; foot < 2; ++foot) {
      force[foot] /= std::max(count, 1);
      pressed[foot] =
          load[foot] > 0.0 ? Vector3d(pressed[foot] / load[foot]) : Vector3d(Vector3d::Constant(kNone));
      valid[foot] = valid[foot] && count > 0;
    }
    series.newtons.push_back(force);
    series.rest.push_back(rest / std::max(count, 1));
    series.pressure.push_back(pressed);
    series.valid.push_back(valid);
  }
  return series;
}

/// The person's joints at the motion's frames; those of the motion where none were measured.
PerFrame<PerBody<Vector3d>> joints_at(const import::MeasuredForces& measured, double fps,
                                      const PerFrame<PerBody<Vector3d>>& otherwise) {
  if (measured.joints.empty()) return otherwise;
  PerFrame<PerBody<Vector3d>> joints;
  for (int t = 0;; ++t) {
    const auto row = static_cast<std::size_t>(std::lround(t * measured.joints_fps / fps));
    if (row >= measured.joints.size()) return joints;
    joints.push_back(measured.joints[row]);
  }
}

void shorten(int frames, FeetSeries& series) {
  series.newtons.resize(frames);
  series.rest.resize(frames);
  series.pressure.resize(frames);
  series.valid.resize(frames);
  series.joints.resize(frames);
}

void put_in_weights(const PerFrame<Matrix3d>& axes, FeetSeries& series) {
  for (int t = 0; t < axes.count(); ++t) {
    auto& force = series.force.emplace_back();
    for (int foot = 0; foot < 2; ++foot)
      force[foot] = axes[t].transpose() * series.newtons[t][foot] / (kGravity * series.mass);
  }
}

/// A simulated motion and its measurement over their common frames.
struct ComparedForces {
  FeetSeries a, b;  ///< simulated, measured
  PerFrame<Matrix3d> axes;
  PerFrame<Array<bool, 2>> counts;  ///< the foot's frame counts

  int frames() const { return a.frames(); }
  bool both(int t) const { return counts[t][0] && counts[t][1]; }
  bool double_support(int t) const {
    return both(t) && b.force[t][0].z() > kStance && b.force[t][1].z() > kStance;
  }
};

/// Values by the names of their columns.
using Named = std::map<std::string, double>;

void compare_totals(const ComparedForces& c, Named& out) {
  Array<PairedSeries, 3> total;
  Values norms;
  double ours = 0.0, theirs = 0.0;
  int count = 0;
  for (int t = 0; t < c.frames(); ++t) {
    if (!c.both(t)) continue;
    ++count;
    const Vector3d a = c.a.total(t), b = c.b.total(t);
    for (int axis = 0; axis < 3; ++axis) total[axis].add(a[axis], b[axis]);
    norms.push_back((a - b).norm());
    ours += a.z();
    theirs += b.z();
  }
  out["n"] = count;
  out["totV"] = 100.0 * total[2].rms();
  out["totV r"] = total[2].correlation();
  out["totAP"] = 100.0 * total[0].rms();
  out["totML"] = 100.0 * total[1].rms();
  out["N/kg"] = kGravity * rms_of(norms);
  out["imp%"] = 100.0 * (ours / theirs - 1.0);
}

void compare_feet(const ComparedForces& c, Named& out) {
  Array<PairedSeries, 3> foot_force;
  for (int t = 0; t < c.frames(); ++t)
    for (int foot = 0; foot < 2; ++foot)
      if (c.counts[t][foot])
        for (int axis = 0; axis < 3; ++axis)
          foot_force[axis].add(c.a.force[t][foot][axis], c.b.force[t][foot][axis]);
  constexpr Array<const char*, 3> kNames = {"ftAP", "ftML", "ftV"};
  for (int axis = 0; axis < 3; ++axis) {
    out[kNames[axis]] = 100.0 * foot_force[axis].rms();
    out[std::string(kNames[axis]) + " r"] = foot_force[axis].correlation();
  }
}

/// Peak and contact times of each stance that the plates see from beginning to end.
void compare_stances(const ComparedForces& c, double fps, Named& out) {
  Values peaks, begins, ends;
  const auto stands = [&](int t, int foot) { return t < c.frames() && c.b.force[t][foot].z() > kStance; };
  for (int foot = 0; foot < 2; ++foot)
    for (int x = 0; x < c.frames(); ++x) {
      if (!stands(x, foot)) continue;
      int y = x;
      bool seen = true;
      double theirs = -HUGE_VAL, ours = -HUGE_VAL;
      for (; stands(y, foot); ++y) {
        seen = seen && c.counts[y][foot];
        theirs = std::max(theirs, c.b.force[y][foot].z());
      }
      if (y - x >= kFewestFrames && seen) {
        int first = -1, last = -1;
        for (int t = std::max(0, x - kAround); t < std::min(c.frames(), y + kAround); ++t) {
          ours = std::max(ours, c.a.force[t][foot].z());
          if (!(c.a.force[t][foot].z() > kStance)) continue;
          if (first < 0) first = t;
          last = t;
        }
        peaks.push_back(100.0 * (ours - theirs));
        if (first >= 0) {
          begins.push_back(1000.0 * (first - x) / fps);
          ends.push_back(1000.0 * (last + 1 - y) / fps);
        }
      }
      x = y;
    }
  Values sizes;
  for (const double peak : peaks) sizes.push_back(std::abs(peak));
  out["dPk"] = mean_of_values(peaks);
  out["|dPk|"] = mean_of_values(sizes);
  out["on"] = mean_of_values(begins);
  out["off"] = mean_of_values(ends);
}

/// Centres of pressure from the ankles, along and across the person's foot.
void compare_pressure(const ComparedForces& c, Named& out) {
  const PerFrame<PerBody<Vector3d>> ours = midway(c.a.joints), theirs = midway(c.b.joints);
  Values along, across;
  for (int foot = 0; foot < 2; ++foot)
    for (int t = 0; t < c.frames(); ++t) {
      const int ankle = foot == 0 ? kLeftAnkle : kRightAnkle, ball = foot == 0 ? kLeftFoot : kRightFoot;
      if (!(c.a.force[t][foot].z() > kPressed && c.b.force[t][foot].z() > kPressed) || !c.counts[t][foot] ||
          !c.a.pressure[t][foot].allFinite() || !c.b.pressure[t][foot].allFinite())
        continue;
      const Vector3d away =
          (c.a.pressure[t][foot] - ours[t][ankle]) - (c.b.pressure[t][foot] - theirs[t][ankle]);
      Vector3d toe = c.b.joints[t][ball] - c.b.joints[t][ankle];
      toe.z() = 0.0;
      toe.normalize();
      const double side = foot == 0 ? 1.0 : -1.0;
      along.push_back(kMm * away.dot(toe));
      across.push_back(kMm * side * away.dot(Vector3d(-toe.y(), toe.x(), 0.0)));
    }
  out["copA"] = rms_of(along);
  out["bias"] = mean_of_values(along);
  out["copM"] = rms_of(across);
}

/// Columns: along the foot, the normal of its plane with the shank, and the direction across both.
Matrix3d axes_of_foot(const PerBody<Vector3d>& joints, int ankle, int knee, int ball) {
  Matrix3d axes;
  axes.col(0) = (joints[ball] - joints[ankle]).normalized();
  axes.col(1) = (joints[knee] - joints[ankle]).cross(axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Slip, docs/metrics.md (2), by joints and centres of pressure alone: a foot is the rigid body of ankle,
/// ball and the plane of the shank. Pressure before the ball moves with the ball. mm per 1/30 s.
double slip_of(const ComparedForces& c, const FeetSeries& series, double fps) {
  double sum = 0.0, loads = 0.0;
  for (int t = 1; t < c.frames(); ++t)
    for (int foot = 0; foot < 2; ++foot) {
      const double load = series.force[t][foot].z();
      const Vector3d& pressure = series.pressure[t][foot];
      if (!c.counts[t][foot] || load < kStance || !pressure.allFinite()) continue;
      const int ankle = kLeftAnkle + foot, knee = kLeftKnee + foot, ball = kLeftFoot + foot;
      const PerBody<Vector3d>&now = series.joints[t], &before = series.joints[t - 1];
      const Matrix3d axes = axes_of_foot(now, ankle, knee, ball),
                     axes_before = axes_of_foot(before, ankle, knee, ball);
      const Vector3d arm = axes.transpose() * (pressure - now[ankle]);
      const Vector3d way = arm.x() > (now[ball] - now[ankle]).norm()
                               ? Vector3d(now[ball] - before[ball])
                               : Vector3d(pressure - before[ankle] - axes_before * arm);
      sum += load * way.head<2>().norm();
      loads += load;
    }
  return kMm * fps / 30.0 * sum / loads;
}

/// Chatter of the force on both feet over the runs of frames that count, docs/metrics.md (6), %.
double chatter_of_runs(const ComparedForces& c, const FeetSeries& series, double fps) {
  double squares = 0.0;
  int count = 0;
  for (int t = 0; t < c.frames(); ++t) {
    List<double> run;
    for (; t < c.frames() && c.both(t); ++t) run.push_back(series.total(t).z());
    const double chatter = audit::chatter_of(run, 1.0, fps);
    if (std::isnan(chatter)) continue;
    squares += run.count() * chatter * chatter;
    count += run.count();
  }
  return std::sqrt(squares / count);
}

/// The part of the feet's horizontal forces along the line between them that cancels, body weights.
double internal_force(const FeetSeries& series, const Matrix3d& axes, const Vector3d& between, int t) {
  Array<double, 2> along;
  for (int foot = 0; foot < 2; ++foot) {
    Vector3d horizontal = axes * series.force[t][foot];
    horizontal.z() = 0.0;
    along[foot] = horizontal.dot(between);
  }
  const double a = along[0], b = -along[1];
  return a * b > 0.0 ? std::copysign(std::min(std::abs(a), std::abs(b)), a) : 0.0;
}

void compare_double_support(const ComparedForces& c, const PerFrame<audit::LoadSharing>& sharing,
                            Named& out) {
  constexpr double kSlack = 0.05;       // of the load
  constexpr double kLeastTotal = 0.05;  // body weights
  PairedSeries share, effort;
  Values ours, theirs, widths;
  int within = 0;
  for (int t = 0; t < c.frames(); ++t) {
    if (!c.double_support(t)) continue;
    const double total_a = std::max(c.a.total(t).z(), kLeastTotal),
                 total_b = std::max(c.b.total(t).z(), kLeastTotal), newtons = total_a * kGravity * c.a.mass;
    const double measured = c.b.force[t][0].z() / total_b, least = sharing[t].least[0].z() / newtons,
                 most = sharing[t].most[0].z() / newtons;
    share.add(c.a.force[t][0].z() / total_a, measured);
    effort.add(sharing[t].least_effort[0].z() / newtons, measured);
    within += measured > least - kSlack && measured < most + kSlack;
    widths.push_back(100.0 * (most - least));
    Vector3d between = c.b.joints[t][kRightAnkle] - c.b.joints[t][kLeftAnkle];
    between.z() = 0.0;
    between.normalize();
    ours.push_back(internal_force(c.a, c.axes[t], between, t));
    theirs.push_back(internal_force(c.b, c.axes[t], between, t));
  }
  const Values difference = share.difference();
  out["ds"] = static_cast<double>(difference.size());
  if (difference.size() < kFewestFrames) return;
  Values steps;
  for (std::size_t i = 1; i < difference.size(); ++i) steps.push_back(difference[i] - difference[i - 1]);
  out["shr"] = 100.0 * share.rms();
  out["b"] = 100.0 * mean_of_values(difference);
  out["wand"] = 100.0 * rms_of(steps) / std::sqrt(2.0);
  out["intM"] = 100.0 * rms_of(theirs);
  out["intS"] = 100.0 * rms_of(ours);
  out["in%"] = 100.0 * within / static_cast<double>(difference.size());
  out["wide"] = mean_of_values(widths);
  out["shrE"] = 100.0 * effort.rms();
}

void compare_moments(const ComparedForces& c, const audit::SimulatedFrames& motion, Named& out) {
  if (std::none_of(c.b.pressure.begin(), c.b.pressure.end(),
                   [](const auto& feet) { return feet[0].allFinite() || feet[1].allFinite(); }))
    return;
  const PerFrame<PerBody<Vector3d>> joints = midway(c.b.joints);  // where they are while the mean forces act
  const PerFrame<LegMoments> measured =
      planar_moments({joints, c.b.newtons, c.b.pressure, c.axes, c.b.mass, motion.fps});
  const PerFrame<LegMoments> simulated = recorded_moments(motion);
  constexpr Array<const char*, 3> kNames = {"ank", "kne", "hip"};
  for (int joint = 0; joint < 3; ++joint) {
    PairedSeries moments;
    for (int t = 0; t < c.frames(); ++t)
      for (int foot = 0; foot < 2; ++foot)
        if (c.counts[t][foot]) moments.add(simulated[t][foot][joint], measured[t][foot][joint]);
    out[kNames[joint]] = moments.rms();
    out[std::string(kNames[joint]) + " r"] = moments.correlation();
  }
}

/// Distance of the joints relative to the pelvis, of legs and arms without collars.
double tracking(const ComparedForces& c) {
  Values distances;
  for (int t = 0; t < c.frames(); ++t)
    for (const int b : {kLeftHip, kRightHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftFoot,
                        kRightFoot, kLeftShoulder, kRightShoulder, kLeftElbow, kRightElbow})
      distances.push_back(
          kMm *
          ((c.a.joints[t][b] - c.a.joints[t][kPelvis]) - (c.b.joints[t][b] - c.b.joints[t][kPelvis])).norm());
  return mean_of_values(distances);
}

/// With this mass the plates' vertical impulse in the frames that count is what the motion needs, kg. Their
/// mean load is not the weight where the body moves down at the first of these frames and up at the last.
/// @throws DataError if there is none
double mass_on_plates(const ComparedForces& c) {
  double theirs = 0.0, ours = 0.0;  // N and N/kg
  for (int t = 0; t < c.counts.count(); ++t) {
    if (!c.both(t)) continue;
    theirs += c.b.load(t);
    ours += c.a.load(t) / c.a.mass;
  }
  if (!(theirs > 0.0 && ours > 0.0))
    throw DataError("", "", "--mass, or frames in which the plates see both feet and a load", "none");
  return theirs / ours;
}

ComparedForces common_frames(const audit::SimulatedFrames& motion, const import::MeasuredForces& measured,
                             double mass) {
  ComparedForces c;
  c.a = simulated_series(motion);
  c.b = measured_series(measured, motion.fps, c.a.newtons.count());
  c.b.joints = joints_at(measured, motion.fps, c.a.joints);
  const int frames = std::min({c.a.newtons.count(), c.b.newtons.count(), c.b.joints.count()});
  if (frames < 5) throw DataError("", "", "at least 5 frames that both have", std::to_string(frames));
  shorten(frames, c.a);
  shorten(frames, c.b);
  for (int t = 0; t < frames; ++t) {
    c.axes.push_back(audit::heading_axes(c.b.joints[t]));
    const bool settled = t > 1 && t + 1 < frames;  // forces at the ends are not
    c.counts.push_back({settled && c.b.valid[t][0], settled && c.b.valid[t][1]});
  }
  c.b.mass = !std::isnan(mass) ? mass : measured.mass;
  if (std::isnan(c.b.mass)) c.b.mass = mass_on_plates(c);
  put_in_weights(c.axes, c.a);
  put_in_weights(c.axes, c.b);
  return c;
}

bool is_inverse_dynamics(const std::filesystem::path& file) { return import::lower_suffix(file) == ".sto"; }

/// Measurements of a folder, or the single file, by name. `NAME_grf` goes before `NAME`, which in OpenSim's
/// folders has the joints' angles. @throws DataError of two others of one name
std::map<std::string, std::filesystem::path> named_measurements(const std::filesystem::path& path) {
  std::map<std::string, std::filesystem::path> named;
  const auto add = [&](const std::filesystem::path& file) {
    std::string name = file.stem().string();
    for (const std::string_view end : {"_grf", "_ID"})
      if (name.ends_with(end)) name.resize(name.size() - end.size());
    const auto [other, first] = named.emplace(name, file);
    if (first) return;
    const bool plain = file.stem() == name, other_plain = other->second.stem() == name;
    if (plain == other_plain)
      throw DataError(file.string(), "", "one measurement of " + name, other->second.string() + ", too");
    if (other_plain) other->second = file;
  };
  if (!std::filesystem::is_directory(path)) {
    add(path);
    return named;
  }
  for (const bool moments : {false, true}) {
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      const std::string suffix = import::lower_suffix(entry.path());
      const bool wanted = moments ? suffix == ".sto" : suffix == ".npz" || suffix == ".mot";
      if (entry.is_regular_file() && wanted) add(entry.path());
    }
    if (!named.empty()) break;
  }
  return named;
}

ForceRow row_of_forces(const std::string& name, const std::filesystem::path& measured,
                       const std::filesystem::path& motion, double mass) {
  ForceRow row;
  row.name = name;
  try {
    if (motion.empty()) throw DataError(measured.string(), "", "a motion for this measurement", "none");
    const Npz npz = read_npz(motion);
    const audit::SimulatedFrames frames = audit::simulated_frames(motion::clip_from(npz, name), npz);
    if (is_inverse_dynamics(measured)) {
      const import::StorageTable table = import::parse_storage(read_file(measured), measured.string());
      row.values = compare_inverse_dynamics(frames, table, mass, measured.string());
      return row;
    }
    // The file's own is of the friction that it was simulated with.
    const PerFrame<audit::LoadSharing> sharing = npz.has("foot_force_least")
                                                     ? audit::read_sharing(npz, frames.frames.size())
                                                     : audit::load_sharing(frames);
    const ComparedMotion compared =
        compare_forces(frames, sharing, import::read_measured_forces(measured), mass);
    row.values = compared.values;
    for (const std::string& line : compared.told) row.told.push_back(measured.string() + ": " + line);
  } catch (const std::exception& error) {
    row.reason = reason_of(error);
  }
  return row;
}

/// Mean of a column over the rows that have a value.
double column_mean(const std::vector<ForceRow>& rows, std::size_t column) {
  Values values;
  for (const ForceRow& row : rows)
    if (row.reason.empty() && !std::isnan(row.values[column])) values.push_back(row.values[column]);
  return mean_of_values(values);
}

std::string cell(const ForceColumn& column, double value) {
  return formatted(" %6s", std::isnan(value) ? "-" : formatted(column.format, value).c_str());
}

/// The name that is printed: without what tells two columns apart.
std::string printed_name(const ForceColumn& column) {
  const std::string name = column.name;
  return name.ends_with(" r") ? "r" : name;
}

}  // namespace

const std::vector<ForceColumn>& force_columns() {
  static const std::vector<ForceColumn> columns = {
      {"n", "%.0f", "frames in which the plates see both feet"},
      {"kg", "%.0f", "mass of the simulated body"},
      {"totV", "%.1f", "vertical force on both feet, RMSE, % of body weight"},
      {"totV r", "%.2f", "its correlation"},
      {"totAP", "%.1f", "the same, forward"},
      {"totML", "%.1f", "the same, sideways"},
      {"N/kg", "%.2f", "all of the force on both feet, RMSE"},
      {"ftV", "%.1f", "vertical force of a foot, RMSE, % of body weight"},
      {"ftV r", "%.2f", "its correlation"},
      {"ftAP", "%.1f", "the same, forward"},
      {"ftAP r", "%.2f", "its correlation"},
      {"ftML", "%.1f", "the same, sideways"},
      {"ftML r", "%.2f", "its correlation"},
      {"imp%", "%+.1f", "vertical impulse beyond the measured one, %"},
      {"dPk", "%+.0f", "peak of a foot's stance beyond the measured one, % of body weight"},
      {"|dPk|", "%.0f", "its size"},
      {"on", "%+.0f", "a stance begins later, ms"},
      {"off", "%+.0f", "a stance ends later, ms"},
      {"copA", "%.0f", "centre of pressure from the ankle along the foot, RMSE, mm"},
      {"bias", "%+.0f", "its mean error, to the front, mm"},
      {"copM", "%.0f", "the same across the foot, RMSE, mm"},
      {"shr", "%.1f", "share of the left foot in double support, RMSE, points"},
      {"b", "%+.1f", "its mean error, points"},
      {"wand", "%.1f", "change of that error from frame to frame, RMS / √2, points"},
      {"intM", "%.1f", "measured force of the feet against each other, RMS, % of body weight"},
      {"intS", "%.1f", "that of the simulation"},
      {"ank", "%.2f", "moment across the ankle, RMSE, N·m/kg"},
      {"ank r", "%.2f", "its correlation"},
      {"kne", "%.2f", "the same at the knee"},
      {"kne r", "%.2f", "its correlation"},
      {"hip", "%.2f", "the same at the hip"},
      {"hip r", "%.2f", "its correlation"},
      {"mm", "%.0f", "distance of the joints from the person's, relative to the pelvis"},
      {"ds", "%.0f", "frames of double support"},
      {"in%", "%.1f", "of them: the measured share of the left foot is in the range of (7) ± 5 points, %"},
      {"wide", "%.1f", "mean width of that range, points"},
      {"shrE", "%.1f", "share by least effort, (8), RMSE, points"},
      {"chaM", "%.1f", "measured chatter of the vertical force on both feet, % of body weight"},
      {"chaS", "%.1f", "that of the simulation"},
      {"slipM", "%.2f", "slip of the person's feet by joints and centre of pressure, mm/frame"},
      {"slipS", "%.2f", "that of the simulation, in the same way"}};
  return columns;
}

const std::vector<ForceColumn>& moment_columns() {
  static const std::vector<ForceColumn> columns = {{"n", "%.0f", "frames that both have"},
                                                   {"kg", "%.0f", "mass of the simulated body"},
                                                   {"hip", "%.2f", "hip flexion, both legs, RMSE, N·m/kg"},
                                                   {"hip r", "%.2f", "its correlation"},
                                                   {"knee", "%.2f", "the same at the knee"},
                                                   {"knee r", "%.2f", "its correlation"},
                                                   {"ankle", "%.2f", "the same at the ankle"},
                                                   {"ankle r", "%.2f", "its correlation"},
                                                   {"hipL", "%.2f", "the same of the left leg"},
                                                   {"hipL r", "%.2f", "its correlation"},
                                                   {"kneeL", "%.2f", "the same of the left leg"},
                                                   {"kneeL r", "%.2f", "its correlation"},
                                                   {"ankleL", "%.2f", "the same of the left leg"},
                                                   {"ankleL r", "%.2f", "its correlation"},
                                                   {"hipR", "%.2f", "the same of the right leg"},
                                                   {"hipR r", "%.2f", "its correlation"},
                                                   {"kneeR", "%.2f", "the same of the right leg"},
                                                   {"kneeR r", "%.2f", "its correlation"},
                                                   {"ankleR", "%.2f", "the same of the right leg"},
                                                   {"ankleR r", "%.2f", "its correlation"}};
  return columns;
}

ComparedMotion compare_forces(const audit::SimulatedFrames& motion,
                              const PerFrame<audit::LoadSharing>& sharing,
                              const import::MeasuredForces& measured, double mass) {
  const ComparedForces c = common_frames(motion, measured, mass);
  Named named;
  named["kg"] = c.a.mass;
  compare_totals(c, named);
  compare_feet(c, named);
  compare_stances(c, motion.fps, named);
  compare_pressure(c, named);
  compare_double_support(c, sharing, named);
  compare_moments(c, motion, named);
  named["chaM"] = chatter_of_runs(c, c.b, motion.fps);
  named["chaS"] = chatter_of_runs(c, c.a, motion.fps);
  if (!measured.joints.empty()) {
    named["slipM"] = slip_of(c, c.b, motion.fps);
    named["slipS"] = slip_of(c, c.a, motion.fps);
    named["mm"] = tracking(c);
  }
  ComparedMotion compared;
  for (const ForceColumn& column : force_columns()) {
    const auto at = named.find(column.name);
    compared.values.push_back(at == named.end() ? kNone : at->second);
  }
  if (!measured.told.empty()) compared.told.push_back(measured.told);
  if (std::isnan(mass) && std::isnan(measured.mass))
    compared.told.push_back(formatted(
        "mass %.1f kg, with which the plates' impulse is the motion's (imp%% is 0); --mass gives another",
        c.b.mass));
  return compared;
}

ForceTable evaluate_forces(const std::filesystem::path& measured, const std::filesystem::path& motions,
                           double mass) {
  if (!std::filesystem::exists(measured))
    throw DataError(measured.string(), "", "measured forces: a folder, or one file", "no such path");
  const auto measurements = named_measurements(measured);
  if (measurements.empty()) throw DataError(measured.string(), "", ".npz, .mot or .sto files", "none");
  const auto named = named_motions(motions);
  const bool two_files = !std::filesystem::is_directory(measured) && named.size() == 1;
  ForceTable table{is_inverse_dynamics(measurements.begin()->second) ? &moment_columns() : &force_columns(),
                   {}};
  for (const auto& [name, file] : measurements) {
    const auto at = two_files ? named.begin() : named.find(name);
    table.rows.push_back(
        row_of_forces(name, file, at == named.end() ? std::filesystem::path() : at->second, mass));
  }
  return table;
}

std::string format_forces(const ForceTable& table) {
  const auto& [columns, rows] = table;
  constexpr std::size_t kName = 15;
  std::string text = padded("trial", kName);
  for (const ForceColumn& column : *columns) text += formatted(" %6s", printed_name(column).c_str());
  text += '\n';
  for (const ForceRow& row : rows) {
    text += padded(row.name, kName);
    if (!row.reason.empty()) {
      text += " failed: " + row.reason + '\n';
      continue;
    }
    for (std::size_t k = 0; k < row.values.size(); ++k) text += cell((*columns)[k], row.values[k]);
    text += '\n';
  }
  text += padded("mean", kName);
  for (std::size_t k = 0; k < columns->size(); ++k) text += cell((*columns)[k], column_mean(rows, k));
  return text + '\n';
}

std::string forces_json(const ForceTable& table) {
  const auto& [columns, rows] = table;
  record::Json json = {{"columns", record::Json::array()}, {"motions", record::Json::array()}};
  record::Json mean = record::Json::object();
  for (std::size_t k = 0; k < columns->size(); ++k) {
    const ForceColumn& column = (*columns)[k];
    json["columns"].push_back({{"name", column.name}, {"meaning", column.meaning}});
    mean[column.name] = record::number(column_mean(rows, k));
  }
  for (const ForceRow& row : rows) {
    record::Json values = record::Json::object();
    for (std::size_t k = 0; k < row.values.size(); ++k)
      values[(*columns)[k].name] = record::number(row.values[k]);
    json["motions"].push_back({{"name", row.name}, {"reason", row.reason}, {"values", values}});
  }
  json["mean"] = mean;
  return record::document(json);
}

}  // namespace mimicx::judge
