// Onto a seat or a bed and up again.
#include <algorithm>
#include <utility>

#include "core/elementary.h"
#include "synth/kinds/random_postures.h"
#include "synth/sketch.h"

namespace mimicx::synth {
namespace {

/// Angles in degrees.
LegPosture bent(double flexion, double knee, double pointing = 0.0) {
  return {flexion * kDegree, 4.0 * kDegree, knee * kDegree, pointing * kDegree, 0.0};
}

/// Height of the knees over vertical shanks, m.
double knee_height(const Character& c) {
  return c.joint_offset[kLeftAnkle].norm() - sole_point(c.contact_points[0]).y();
}

/// A plate behind the feet.
/// @param deep   m from front to back  @param wide  m from side to side
/// @param share  of the height of thighs that are level
Scene seat_behind(const PlanRequest& request, double deep, double wide, double share) {
  const Character& c = request.character;
  const double front = -0.18 * c.joint_offset[kLeftKnee].norm();
  Plate plate;
  plate.half_extents = {0.5 * deep, 0.5 * wide};
  plate.centre = {front - 0.5 * deep, 0.0};
  plate.height = share * (knee_height(c) - c.capsule[kLeftHip].radius);
  Scene scene;
  scene.plates.push_back(plate);
  return scene;
}

/// Flexion of hips and knees of a person who sits upright on a plate over vertical shanks, degrees.
/// @param height  of the plate, m
double seated_flexion(const Character& c, double height) {
  double bottom = 0.0;  // of the pelvis, m over its joint
  for (const ContactPoint& point : c.contact_points)
    if (point.body == kPelvis) bottom = std::min(bottom, sole_point(point).y());
  const double hip = height - bottom + c.joint_offset[kLeftHip].y();
  return 90.0 + asin((knee_height(c) - hip) / c.joint_offset[kLeftKnee].norm()) / kDegree;
}

/// A person between standing and sitting.
class Sitter {
 public:
  Sitter(const Character& character, Sketch& sketch, double height)
      : s_(sketch), height_(height), flexion_(seated_flexion(character, height)), stand_(sketch.stand()) {
    tempo_ = sketch.random().uniform(0.9, 1.15);
    lean_ = sketch.random().uniform(36.0, 44.0);
    upright_ = stand_;  // the hands over the thighs
    for (ArmPosture& arm : upright_.arm) arm = {30.0 * kDegree, 10.0 * kDegree, 0.0, 55.0 * kDegree};
  }

  void down() {
    s_.pause(0.5);
    go(bowed(80.0, 62.0), {}, soles(), 1.0);
    go(bowed(114.0, 97.0), {}, soles(), 0.8);
    go(leaning(), seated(), to_feet(), 0.8);
    go(sitting(upright_), seated(), on_seat(), 0.8);
  }
  void up() {
    go(sitting(upright_), seated(), on_seat(), 0.7);
    go(leaning(), seated(), to_feet(), 0.8);
    go(bowed(114.0, 97.0), {}, soles(), 0.8);
    go(bowed(80.0, 62.0), {}, soles(), 0.8);
    s_.stand_up(1.0, 0.0);
    s_.pause(0.4);
  }
  void gesture(const PlanFrame& upper, double seconds) { go(sitting(upper), seated(), on_seat(), seconds); }
  /// Over the hands behind the hips and then the forearms onto the back, and up again the same way.
  void lie(double rest) {
    PlanFrame open = upright_;  // the hands go around the hips
    for (ArmPosture& arm : open.arm) arm = {-10.0 * kDegree, 45.0 * kDegree, 0.0, 20.0 * kDegree};
    gesture(open, 0.6);
    lean_back(-20.0, 0.15, 1.0);
    lean_back(-38.0, 0.3, 1.0);
    lean_back(-55.0, 0.4, 1.2);
    lean_back(-86.0, 0.45, 1.2);
    s_.pause(rest);
    lean_back(-55.0, 0.4, 1.2);
    lean_back(-38.0, 0.3, 1.2);
    lean_back(-20.0, 0.15, 1.0);
    gesture(open, 0.6);
  }
  const PlanFrame& upright() const { return upright_; }

 private:
  void go(KeyPose key, std::vector<Bearing> more, std::vector<Load> weight_on, double seconds) {
    key.bearings = {on(sole(0)), on(sole(1))};
    key.bearings.insert(key.bearings.end(), more.begin(), more.end());
    key.weight_on = std::move(weight_on);
    s_.go(key, tempo_ * seconds);
  }
  /// The trunk leans back, degrees. What is on the bed behind the hips, hands, elbows or the back, bears a
  /// share of the weight.
  void lean_back(double tilt, double share, double seconds) {
    const bool on_back = tilt < -80.0, on_elbows = !on_back && tilt < -50.0;
    KeyPose key = reclined(tilt);
    std::vector<Bearing> bearings =
        on_back ? std::vector{rolling_on(hips(), height_), rolling_on(back(), height_)}
                : std::vector{rolling_on(seat(), height_)};
    std::vector<Load> loads = {{seat(), 0.95 - share}, {sole(0), 0.025}, {sole(1), 0.025}};
    if (on_back) loads.push_back({back(), share});
    for (const int side : {0, 1}) {
      key.upper.arm[side] = {(-55.0 - 0.5 * tilt) * kDegree, 14.0 * kDegree, 0.0,
                             std::min(-1.5 * tilt - 15.0, 90.0) * kDegree};
      bearings.push_back(on_back ? rolling_on(hand(side), height_) : resting_on(hand(side), height_));
      if (tilt < -50.0) bearings.push_back(rolling_on(elbow(side), height_));
      if (!on_back) loads.push_back({on_elbows ? elbow(side) : hand(side), 0.5 * share});
    }
    go(key, bearings, loads, seconds);
  }
  std::vector<Bearing> seated() const { return {rolling_on(hips(), height_)}; }
  static std::vector<Load> soles() { return {{sole(0)}, {sole(1)}}; }
  static std::vector<Load> to_feet() { return {{seat(), 0.66}, {sole(0), 0.17}, {sole(1), 0.17}}; }
  static std::vector<Load> on_seat() {
    return {{hips(), 0.65}, {thighs(), 0.2}, {sole(0), 0.075}, {sole(1), 0.075}};
  }
  /// Hips back, trunk and arms ahead.
  KeyPose bowed(double flexion, double knee) const {
    KeyPose key{stand_, {}, {}, {}};
    key.upper.pelvis.x() = lean_ * kDegree;
    key.upper.trunk.x() = 0.5 * lean_ * kDegree;
    key.upper.head.x() = -0.9 * lean_ * kDegree;
    for (ArmPosture& arm : key.upper.arm) arm = {110.0 * kDegree, 12.0 * kDegree, 0.0, 20.0 * kDegree};
    for (LegPosture& l : key.leg) l = bent(flexion, knee, lean_ + knee - flexion);
    return key;
  }
  KeyPose sitting(const PlanFrame& upper) const {
    KeyPose key{upper, {}, {}, {}};
    for (LegPosture& l : key.leg) l = bent(flexion_, flexion_);
    return key;
  }
  /// Before the hips leave the seat, and when they have reached it.
  KeyPose leaning() const {
    KeyPose key = bowed(flexion_ + 0.5 * lean_, flexion_);
    key.upper.pelvis.x() = 0.5 * lean_ * kDegree;
    key.upper.trunk.x() = 0.4 * lean_ * kDegree;
    for (ArmPosture& arm : key.upper.arm) arm.forward = 75.0 * kDegree;  // not down beside the plate
    for (LegPosture& l : key.leg) l.pointing = 0.0;
    return key;
  }
  KeyPose reclined(double tilt) const {
    KeyPose key = sitting(upright_);
    key.upper.pelvis.x() = tilt * kDegree;
    key.upper.head.x() = 12.0 * kDegree;
    for (LegPosture& l : key.leg) l = bent(flexion_ + tilt, flexion_);
    return key;
  }

  Sketch& s_;
  double height_, flexion_, tempo_ = 1.0, lean_ = 40.0;
  PlanFrame stand_, upright_;
};

/// Sits down, calls `busy(sitter)`, and stands up.
template <class Busy>
SceneMotion on_seat(const PlanRequest& request, double deep, double wide, const Busy& busy) {
  const double share = request.random.uniform(0.92, 1.0);
  SceneMotion motion{{}, seat_behind(request, deep, wide, share)};
  Sketch s(request, random_stance(request, 1.0, 1.3, 3.0, 9.0), motion.scene);
  Sitter sitter(request.character, s, motion.scene.plates.front().height);
  sitter.down();
  busy(sitter);
  sitter.up();
  motion.poses = s.finished();
  return motion;
}

}  // namespace

SceneMotion sit_down(const PlanRequest& request) {
  return on_seat(request, 0.55, 0.6,
                 [&](Sitter& sitter) { sitter.gesture(sitter.upright(), request.random.uniform(0.5, 1.2)); });
}

SceneMotion sit_and_reach(const PlanRequest& request) {
  return on_seat(request, 0.55, 0.6, [&](Sitter& sitter) {
    for (int gestures = 0; gestures < 3; ++gestures) {
      PlanFrame posture = random_posture(request.random, sitter.upright(), 0.6);
      posture.pelvis.x() += request.random.uniform(0.0, 10.0) * kDegree;
      sitter.gesture(posture, request.random.uniform(0.8, 1.1));
    }
  });
}

SceneMotion lie_on_bed(const PlanRequest& request) {
  return on_seat(request, 2.0, 1.0, [&](Sitter& sitter) { sitter.lie(request.random.uniform(1.2, 2.0)); });
}

}  // namespace mimicx::synth
