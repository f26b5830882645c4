// Down to the floor and up again: kneeling, crawling, lying.
#include "synth/kinds/random_postures.h"
#include "synth/sketch.h"

namespace mimicx::synth {
namespace {

LegPosture leg(double flexion, double knee, double pointing, double toes_up = 0.0, double out = 6.0) {
  return {flexion * kDegree, out * kDegree, knee * kDegree, pointing * kDegree, toes_up * kDegree};
}
ArmPosture arm(double forward, double out, double elbow) {
  return {forward * kDegree, out * kDegree, 0.0, elbow * kDegree};
}

/// The way down to both knees and up again, `side` first.
class Kneeler {
 public:
  Kneeler(Sketch& sketch, int side) : s_(sketch), side_(side), other_(1 - side) {
    stride_ = sketch.random().uniform(0.62, 0.70);
    tempo_ = sketch.random().uniform(0.9, 1.2);
    const PlanFrame& stand = sketch.stand();
    upright_ = lunge_ = stand;
    lunge_.pelvis.x() = 8.0 * kDegree;
    lunge_.trunk.x() = 6.0 * kDegree;
    for (ArmPosture& a : lunge_.arm) a = arm(25.0, 18.0, 30.0);
  }

  void down() {
    s_.pause(0.4);
    go(standing(), {on(sole(side_)), on(sole(other_))}, {{sole(other_)}}, 0.8);
    go(stepping(), {on(sole(other_)), moved(toes(side_), -0.5 * stride_, 0.07)}, {{sole(other_)}}, 0.5);
    go(split(), {on(sole(other_)), moved(toes(side_), -0.5 * stride_)}, {}, 0.5);
    go(half_kneeling(), half_bearings(), {}, 1.0);
    go(half_kneeling(), half_bearings(), kneeling_side(), 0.6);
    go(following(), {on(knee(side_)), on(toes(side_)), moved(toes(other_), -0.5 * stride_, 0.05)},
       kneeling_side(), 0.5);
    go(kneeling(upright_),
       {on(knee(side_)), on(toes(side_)), moved(toes(other_), -0.5 * stride_), on(knee(other_))}, knees(),
       0.6);
  }
  void up() {
    go(kneeling(upright_), kneeling_bearings(), kneeling_side(), 0.6);
    go(following(), {on(knee(side_)), on(toes(side_)), moved(toes(other_), 0.5 * stride_, 0.07)},
       kneeling_side(), 0.5);
    go(half_kneeling(), {on(knee(side_)), on(toes(side_)), home(sole(other_), advance_)}, kneeling_side(),
       0.5);
    go(half_kneeling(), half_bearings(), {}, 0.6);
    go(split(), {on(sole(other_)), on(toes(side_))}, {}, 0.9);
    go(pushing(), {on(sole(other_)), on(toes(side_))}, {{sole(other_)}}, 0.6);
    go(stepping(), {on(sole(other_)), moved(toes(side_), 0.5 * stride_, 0.07)}, {{sole(other_)}}, 0.5);
    go(standing(), {on(sole(other_)), home(sole(side_), advance_)}, {{sole(other_)}}, 0.5);
    s_.stand_up(0.8, advance_);
    s_.pause(0.3);
  }
  KeyPose kneeling(const PlanFrame& upper) const {
    return {upper, {leg(2.0, 92.0, 0.0, 55.0), leg(2.0, 92.0, 0.0, 55.0)}, {}, {}};
  }
  std::vector<Bearing> kneeling_bearings() const {
    return {on(knee(0)), on(toes(0)), on(knee(1)), on(toes(1))};
  }
  std::vector<Load> knees() const { return {{knee(0), 0.4}, {knee(1), 0.4}, {toes(0), 0.1}, {toes(1), 0.1}}; }
  /// Hands and knees have gone on.
  void advance(double ahead) { advance_ += ahead; }
  const PlanFrame& upright() const { return upright_; }
  void go(KeyPose key, std::vector<Bearing> bearings, std::vector<Load> weight_on, double seconds) {
    key.bearings = std::move(bearings);
    key.weight_on = std::move(weight_on);
    s_.go(key, tempo_ * seconds);
  }

 private:
  KeyPose posed(const PlanFrame& upper, const LegPosture& behind, const LegPosture& ahead) const {
    KeyPose key{upper, {}, {}, {}};
    key.leg[side_] = behind;
    key.leg[other_] = ahead;
    return key;
  }
  KeyPose standing() const { return posed(upright_, leg(8.0, 14.0, -6.0), leg(8.0, 14.0, -6.0)); }
  KeyPose stepping() const { return posed(lunge_, leg(5.0, 50.0, 10.0, 10.0), leg(25.0, 30.0, -10.0)); }
  KeyPose split() const { return posed(lunge_, leg(-5.0, 35.0, -5.0, 40.0), leg(55.0, 55.0, -10.0)); }
  KeyPose pushing() const { return posed(lunge_, leg(-28.0, 30.0, 0.0, 45.0), leg(40.0, 55.0, -28.0)); }
  KeyPose half_kneeling() const { return posed(lunge_, leg(5.0, 92.0, 0.0, 55.0), leg(95.0, 100.0, -12.0)); }
  KeyPose following() const { return posed(lunge_, leg(5.0, 92.0, 0.0, 55.0), leg(60.0, 110.0, 0.0, 20.0)); }
  std::vector<Bearing> half_bearings() const { return {on(sole(other_)), on(toes(side_)), on(knee(side_))}; }
  std::vector<Load> kneeling_side() const { return {{knee(side_), 0.8}, {toes(side_), 0.2}}; }

  Sketch& s_;
  int side_, other_;
  double stride_, tempo_, advance_ = 0.0;
  PlanFrame upright_, lunge_;
};

/// From both knees to the hands, steps, the front on the floor, and back.
class Crawler {
 public:
  Crawler(Sketch& sketch, Kneeler& kneeler) : s_(sketch), k_(kneeler) {}

  void down() {
    k_.go(bowing(), all_bearings(), k_.knees(), 1.2);
    for (const int side : {0, 1}) {
      const Eigen::Vector2d shoulder_wide(kHandsAhead, side == 0 ? kHandsAside : -kHandsAside);
      reach_[side] = 0.5 * (s_.place(knee(0)) + s_.place(knee(1))) + shoulder_wide - s_.place(hand(side));
    }
    for (const int side : {0, 1}) move_hand(side, reach_[side]);
  }
  void up() {
    for (const int side : {1, 0}) move_hand(side, -reach_[side]);
    k_.go(bowing(), all_bearings(), k_.knees(), 0.6);
    k_.go(k_.kneeling(k_.upright()), k_.kneeling_bearings(), k_.knees(), 1.2);
  }
  /// One hand and the knee of the other side go ahead.
  void step(int side, double ahead, double seconds) {
    const int other = 1 - side;
    for (const double lift : {0.035, 0.0})
      k_.go(all_fours(),
            {on(hand(other)), moved(hand(side), 0.5 * ahead, lift), on(knee(side)), on(toes(side)),
             moved(knee(other), 0.5 * ahead, lift), moved(toes(other), 0.5 * ahead, lift)},
            {}, 0.5 * seconds);
  }
  void onto_the_front(double rest) {
    constexpr double kBack = 0.60;  // m
    move_leg(0, -kBack, legs_back(1), false);
    move_leg(1, -kBack, legs_back(2), false);
    k_.go(lying(), {on(hand(0)), on(hand(1)), on(toes(0)), on(toes(1)), on(front(0)), on(front(1))}, {}, 1.4);
    s_.pause(rest);
    k_.go(legs_back(2), {on(hand(0)), on(hand(1)), on(toes(0)), on(toes(1))}, {}, 1.4);
    move_leg(1, kBack, legs_back(1), true);
    move_leg(0, kBack, all_fours(), true);
  }

 private:
  void move_hand(int side, const Eigen::Vector2d& by) {
    for (const double lift : {0.04, 0.0}) {
      std::vector<Bearing> bearings = k_.kneeling_bearings();
      bearings.push_back(on(hand(1 - side)));
      bearings.push_back({hand(side), 0.5 * by, lift});
      k_.go(all_fours(), bearings, {}, 0.4);
    }
  }
  /// The left leg goes while the right one kneels, the right one while the left one is straight.
  /// @param kneels  it comes to bear on its knee, where that was before
  void move_leg(int side, double ahead, const KeyPose& pose, bool kneels) {
    for (const double lift : {0.06, 0.0}) {
      std::vector<Bearing> bearings = {on(hand(0)), on(hand(1)), on(toes(1 - side)),
                                       moved(toes(side), 0.5 * ahead, lift)};
      if (side == 0) bearings.push_back(on(knee(1)));
      if (kneels && lift == 0.0) bearings.push_back(on(knee(side)));
      k_.go(pose, bearings, {}, 0.45);
    }
  }
  KeyPose bowing() const {
    KeyPose key = k_.kneeling(k_.upright());
    key.upper.pelvis.x() = 58.0 * kDegree;
    key.upper.trunk.x() = 24.0 * kDegree;
    key.upper.head.x() = -35.0 * kDegree;
    for (ArmPosture& a : key.upper.arm) a = arm(95.0, 8.0, 12.0);
    for (LegPosture& l : key.leg) l = leg(85.0, 118.0, 0.0, 55.0);
    return key;
  }
  KeyPose all_fours() const {
    KeyPose key = k_.kneeling(k_.upright());
    key.upper.pelvis.x() = 72.0 * kDegree;
    key.upper.trunk.x() = 10.0 * kDegree;
    key.upper.head.x() = -30.0 * kDegree;
    for (ArmPosture& a : key.upper.arm) a = arm(85.0, 6.0, 10.0);
    for (LegPosture& l : key.leg) l = leg(72.0, 90.0, 0.0, 55.0);
    return key;
  }
  /// @param legs  how many of them are straight, the left one first
  KeyPose legs_back(int legs) const {
    KeyPose key = all_fours();
    key.leg[0] = leg(5.0, 12.0, 0.0, 50.0);
    if (legs == 2) key.leg[1] = key.leg[0];
    return key;
  }
  KeyPose lying() const {
    KeyPose key = legs_back(2);
    key.upper.pelvis.x() = 88.0 * kDegree;
    key.upper.trunk.x() = -8.0 * kDegree;
    for (ArmPosture& a : key.upper.arm) a = arm(60.0, 45.0, 110.0);
    return key;
  }
  std::vector<Bearing> all_bearings() const {
    std::vector<Bearing> bearings = k_.kneeling_bearings();
    bearings.push_back(on(hand(0)));
    bearings.push_back(on(hand(1)));
    return bearings;
  }
  static constexpr double kHandsAhead = 0.50, kHandsAside = 0.19;  ///< of the knees' middle, m

  Sketch& s_;
  Kneeler& k_;
  PerSide<Eigen::Vector2d> reach_;  ///< of the hands, from where they first touch the floor, m
};

/// Kneels down on both knees, calls `busy(sketch, kneeler)`, and stands up again.
template <class Busy>
PerFrame<SynthPose> on_knees(const PlanRequest& request, const Busy& busy) {
  Sketch s(request, random_stance(request, 0.95, 1.15, 2.0, 8.0));
  Kneeler k(s, static_cast<int>(s.random().below(2)));
  k.down();
  busy(s, k);
  k.up();
  return s.finished();
}

/// Goes down on hands and knees, calls `busy(crawler, kneeler)`, and stands up again.
template <class Busy>
PerFrame<SynthPose> on_all_fours(const PlanRequest& request, const Busy& busy) {
  return on_knees(request, [&](Sketch& s, Kneeler& k) {
    Crawler c(s, k);
    c.down();
    busy(c, k);
    c.up();
  });
}

}  // namespace

PerFrame<SynthPose> sketch_kneel(const PlanRequest& request) {
  return on_knees(request, [&](Sketch&, Kneeler& k) {
    Random& random = request.random;
    for (std::uint32_t busy = 1 + random.below(3); busy > 0; --busy) {
      const PlanFrame posture = random_posture(random, k.upright(), 0.5);
      k.go(k.kneeling(posture), k.kneeling_bearings(), k.knees(), random.uniform(0.7, 1.0));
    }
    k.go(k.kneeling(k.upright()), k.kneeling_bearings(), k.knees(), 0.7);
  });
}

PerFrame<SynthPose> sketch_crawl(const PlanRequest& request) {
  return on_all_fours(request, [&](Crawler& c, Kneeler& k) {
    Random& random = request.random;
    int side = static_cast<int>(random.below(2));
    const double ahead = random.uniform(0.16, 0.26), seconds = random.uniform(0.7, 1.0);
    const std::uint32_t pairs = 2 + random.below(2);
    for (std::uint32_t steps = 2 * pairs; steps > 0; --steps, side = 1 - side) c.step(side, ahead, seconds);
    k.advance(pairs * ahead);
  });
}

PerFrame<SynthPose> sketch_lie_down(const PlanRequest& request) {
  return on_all_fours(request,
                      [&](Crawler& c, Kneeler&) { c.onto_the_front(request.random.uniform(0.5, 1.5)); });
}

}  // namespace mimicx::synth
