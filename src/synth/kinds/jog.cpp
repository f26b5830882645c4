#include <algorithm>
#include <cmath>

#include "synth/gait.h"
#include "synth/kinds.h"
#include "synth/whole_body_balance.h"

namespace mimicx::synth {
namespace {

/// One foot on the floor. Times fall on frames: the discrete motion is then exactly ballistic in flight.
struct Contact {
  int side;
  double land, leave;  ///< s
  double x;            ///< place of the foot, m
  bool flight;         ///< the body flies between this contact and the next
};

double on_frame(double t) { return std::round(t * kSynthFps) / kSynthFps; }

constexpr double kFlight = 3.0 / kSynthFps, kStance = 10.0 / kSynthFps;
constexpr double kBoth = 3.0 / kSynthFps;  ///< both feet on the floor, in the first and the last step
constexpr double kFirstSwing = 0.40;       ///< s
constexpr double kJogSettle = 0.55, kJogRest = 1.1;  ///< s
constexpr double kLandingKnee = 22.0 * kDegree;
constexpr double kPush = 6.0;  ///< acceleration of the centre of mass in the middle of a stance, m/s²
// Where the load acts in the foot, as a share of the way from the ankle to the toe points: at landing, when
// the foot carries the body, at leaving.
constexpr double kLandOn = 0.15, kCarryOn = 0.35, kLeaveOn = 0.70;
constexpr double kCarry = 0.11;  ///< from landing to carrying, s

/// From standing over steps of growing length to full steps, and back. The first contact is the foot that
/// stands while the other takes the first step, the last one the foot that is put down beside the other.
std::vector<Contact> draw_contacts(const PlanRequest& request, double step) {
  Random& random = request.random;
  const double begin = on_frame(random.uniform(0.85, 0.95)), period = kStance + kFlight;
  const int first = static_cast<int>(random.below(2));
  const double time = request.seconds() - begin - 2.0 * kFirstSwing - 2.0 * kBoth - kJogRest;
  const int flights = std::max(2, static_cast<int>(time / period));
  std::vector<Contact> contacts = {{first, 0.0, begin + on_frame(kFirstSwing) + kBoth, 0.0, false}};
  double land = begin + on_frame(kFirstSwing), x = 0.0;
  for (int k = 0; k <= flights; ++k) {
    const int from_end = std::min(k, flights - k);
    x += step * (from_end == 0 ? 0.45 : from_end == 1 ? 0.8 : 1.0);
    const bool last = k == flights;
    const double leave = land + kStance + (k == 0 || last ? kBoth : 0.0);
    contacts.push_back({(first + 1 + k) % 2, land, leave, x, !last});
    land = leave + (last ? -kBoth : kFlight);
  }
  // A short step on which the body comes to rest, and the other foot beside it.
  x += 0.30 * step;
  contacts.push_back({(first + flights + 2) % 2, land, request.seconds() + 1.0, x, false});
  contacts.push_back(
      {(first + flights + 3) % 2, land + kBoth + kFirstSwing, request.seconds() + 1.0, x, false});
  return contacts;
}

/// The load rolls over the foot to its ball.
void roll_over_soles(const Character& character, const std::vector<Contact>& contacts, double begin,
                     FeetTracks& feet) {
  const double forefoot = forefoot_length(character), middle = feet_middle(character);
  const int standing = contacts[0].side, other = 1 - standing;
  PerSide<std::vector<Knot>> knots;
  knots[standing] = {{begin, middle}, {contacts[0].leave, kLeaveOn * forefoot}};
  knots[other] = {{begin - kJogSettle, middle}, {begin, kLeaveOn * forefoot}};
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    std::vector<Knot>& track = knots[contacts[i].side];
    const bool stays = i + 2 >= contacts.size();
    track.push_back({contacts[i].land, kLandOn * forefoot});
    track.push_back({contacts[i].land + kCarry, kCarryOn * forefoot});
    track.push_back(stays ? Knot{contacts[i].land + kJogSettle, middle}
                          : Knot{contacts[i].leave, kLeaveOn * forefoot});
  }
  for (int side = 0; side < 2; ++side) feet.foot[side].pressure = MinJerkTrack(knots[side]);
}

FeetTracks jogging_feet(const Character& character, const PerSide<FootTarget>& start,
                        const std::vector<Contact>& contacts, double clearance) {
  std::vector<FootSwing> swings;
  const double begin = contacts[1].land - on_frame(kFirstSwing);
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    const int side = contacts[i].side;
    const double leave = i == 1 ? begin : contacts[i - 2].leave;
    const bool walking = i == 1 || i + 1 == contacts.size();
    swings.push_back({contacts[i].side, leave, contacts[i].land,
                      Eigen::Vector2d(contacts[i].x, start[side].place.y()), start[side].yaw,
                      walking ? 0.05 : clearance, !walking});
  }
  FeetTracks feet = stepping_feet(character, start, swings, kJogSettle);
  roll_over_soles(character, contacts, begin, feet);
  std::vector<Knot> load = {{begin - kJogSettle, 0.5}, {begin, contacts[0].side == 0 ? 1.0 : 0.0}};
  for (std::size_t i = 1; i + 1 < contacts.size(); ++i) {
    // The load goes over while both feet stand or neither does.
    const double standing = contacts[i].side == 0 ? 1.0 : 0.0;
    const bool from_both = i == 1 || i + 2 == contacts.size();
    load.push_back({std::min(contacts[i].land, contacts[i - 1].leave) - 0.001, 1.0 - standing});
    load.push_back({from_both ? contacts[i - 1].leave : contacts[i].land, standing});
  }
  const Contact& end = contacts.back();
  load.push_back({end.land, end.side == 0 ? 0.0 : 1.0});
  load.push_back({end.land + kJogSettle, 0.5});
  feet.load = MinJerkTrack(load);
  return feet;
}

/// Height of the centre of mass: a parabola in every flight, quintics between. A stance between two flights
/// is two quartics (the least jerk towards a middle whose height is free), so that the load is even.
MinJerkTrack jogging_height(const Character& character, const PlanFrame& stand,
                            const std::vector<Contact>& contacts, double step) {
  // At landing and leaving the foot is half a stance's way from the centre of mass.
  const double away = 0.5 * step * kStance / (kStance + kFlight);
  const double low =
      com_height_for_knee(character, stand, stand.pressure - Eigen::Vector2d(away, 0.0), kLandingKnee);
  const double velocity = 0.5 * kGravity * kFlight;
  const double begin = contacts[1].land - on_frame(kFirstSwing);
  std::vector<Knot> height = {{begin - 0.3, stand.com_height}, {contacts[1].land, low}};
  for (std::size_t i = 1; i + 2 < contacts.size(); ++i) {
    if (!contacts[i].flight) continue;
    if (i > 1) {
      const double half = 0.5 * (contacts[i].leave - contacts[i].land);
      const double drop = 0.5 * velocity * half + (kGravity + kPush) * half * half / 12.0;
      height.push_back({contacts[i].land + half, low - drop, 0.0, kPush});
    }
    height.push_back({contacts[i].leave, low, velocity, -kGravity});
    height.push_back({contacts[i + 1].land, low, -velocity, -kGravity});
  }
  const double landed = height.back().time;
  height.push_back({landed + 0.45, low - 0.03});
  height.push_back({landed + 1.3, stand.com_height});
  return MinJerkTrack(height);
}

}  // namespace

PerFrame<PlanFrame> plan_jog(const PlanRequest& request) {
  Random& random = request.random;
  const Character& character = request.character;
  const double half_width = rest_half_width(character) * random.uniform(0.70, 0.82);
  const auto start = feet_apart(half_width, random.uniform(3.0, 6.0) * kDegree);
  const double step = random.uniform(0.74, 0.88) * leg_length(character);
  const std::vector<Contact> contacts = draw_contacts(request, step);
  const FeetTracks feet = jogging_feet(character, start, contacts, random.uniform(0.11, 0.15));
  const PlanFrame stand = standing_frame(character, feet);
  PlanFrame jogging = stand;  // leaning forward, elbows bent
  jogging.trunk.x() = random.uniform(3.0, 7.0) * kDegree;
  for (ArmPosture& arm : jogging.arm) arm.elbow = random.uniform(65.0, 80.0) * kDegree;
  const MinJerkTrack height = jogging_height(character, stand, contacts, step);
  const double end = contacts.back().land;
  const std::vector<PostureKey> keys = {{0.0, stand},
                                        {contacts[1].land - kFirstSwing - 0.3, stand},
                                        {contacts[1].leave, jogging},
                                        {end - 0.6, jogging},
                                        {end + 0.4, stand}};
  PerFrame<PlanFrame> plan = request.every_frame(stand);
  hold_postures(keys, feet, plan);
  const GaitStyle style = {random.uniform(20.0, 28.0) * kDegree, random.uniform(3.0, 5.0) * kDegree,
                           random.uniform(1.0, 2.0) * kDegree, random.uniform(2.0, 4.0) * kDegree};
  follow_feet(character, style, step, feet, plan);
  for (int i = 0; i < plan.count(); ++i) {
    const double t = time_of(i);
    plan[i].com_height = height.at(t);
    for (std::size_t k = 0; k + 1 < contacts.size(); ++k)
      if (contacts[k].flight && t > contacts[k].leave + 0.01 && t < contacts[k + 1].land - 0.01)
        plan[i].flight = true;
  }
  return plan;
}

}  // namespace mimicx::synth
