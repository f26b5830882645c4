#include "import/evidence/frame_rate.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/elementary.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/units.h"
#include "import/plausibility.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

constexpr std::array kCommonRates = {24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 100.0, 120.0, 200.0, 240.0, 250.0};
/// Of television (24000/1001 …), and rarer ones.
constexpr std::array kOtherRates = {24e3 / 1001, 30e3 / 1001, 60e3 / 1001, 120e3 / 1001, 12.0,  12.5,
                                    15.0,        20.0,        48.0,        72.0,         144.0, 150.0,
                                    180.0,       300.0,       360.0,       480.0,        500.0, 1000.0};
constexpr double kSlowest = 8.0, kFastest = 400.0;  ///< fps of recordings

constexpr int kManyFrames = 70;  ///< a motion of one second hardly has them by chance

constexpr double kClear = 0.03;              ///< m over the floor; nothing supports the body there
constexpr double kTop = 0.05;                ///< m of the lowest point at the top of a flight
constexpr double kFootTravel = 0.08;         ///< m of either foot in a flight
constexpr double kPelvisTravel = 0.03;       ///< m
constexpr double kLargestFactor = 4.2;       ///< between frame rates: 120 labelled 30, a little noise
constexpr int kShortestFlight = 5;           ///< frames
constexpr double kParabolaResidual = 0.012;  ///< m, root mean square, of a clean flight
constexpr int kSeveralFlights = 3;           ///< flights that must agree to change the frame rate
constexpr double kSameRate = 0.1;            ///< relative difference of the rates of flights that agree
constexpr double kRise = 0.1;                ///< m that a body rises in a jump from both feet

/// Least squares of a parabola to z[first..last] over the frame number.
struct Parabola {
  double acceleration = 0;  ///< m per frame²
  double residual = 0;      ///< m, root mean square
};
Parabola fit_parabola(const PerFrame<double>& z, int first, int last) {
  const int n = last - first + 1;
  Eigen::MatrixX3d powers(n, 3);
  Eigen::VectorXd values(n);
  for (int i = 0; i < n; ++i) {
    const double s = i - 0.5 * (n - 1);
    powers.row(i) << 1.0, s, 0.5 * s * s;
    values[i] = z[first + i];
  }
  const Matrix3d normal = powers.transpose() * powers;
  const Vector3d c = normal.inverse() * (powers.transpose() * values);
  return {c[2], (powers * c - values).norm() / std::sqrt(n)};
}

/// Largest extent of a joint's path in frames first … last, m.
double extent_of(const PerFrame<BodyPoses>& poses, int joint, int first, int last) {
  Vector3d low = poses[first].p_WB[joint], high = low;
  for (int t = first; t <= last; ++t) {
    low = low.cwiseMin(poses[t].p_WB[joint]);
    high = high.cwiseMax(poses[t].p_WB[joint]);
  }
  return (high - low).norm();
}

/// Successive frames in which nothing supports the body.
struct Flight {
  int frames = 0;
  double acceleration = 0;  ///< downward, m per frame²

  /// How far the centre of mass rises and falls again, m.
  double rise() const { return acceleration * frames * frames / 8.0; }
};

List<Flight> flights_of(const motion::Clip& clip) {
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const PerFrame<double> lowest = motion::lowest_resting_heights(motion::surface_points(character), poses);
  const double floor = detect_floor(clip);
  PerFrame<double> height;
  for (const BodyPoses& pose : poses) height.push_back(center_of_mass(character, pose).z());
  List<Flight> flights;
  for (int first = 0; first < lowest.count();) {
    int end = first;
    while (end < lowest.count() && lowest[end] > floor + kClear) ++end;
    const int length = end - first;
    if (length >= kShortestFlight) {
      const Parabola p = fit_parabola(height, first, end - 1);
      // A foot that does not move supports the body at any height; a body whose pelvis stays has no place.
      const bool free = extent_of(poses, kLeftFoot, first, end - 1) > kFootTravel &&
                        extent_of(poses, kRightFoot, first, end - 1) > kFootTravel &&
                        extent_of(poses, kPelvis, first, end - 1) > kPelvisTravel &&
                        *std::max_element(lowest.begin() + first, lowest.begin() + end) > floor + kTop;
      if (free && p.residual < kParabolaResidual && p.acceleration < 0.0)
        flights.push_back({length, -p.acceleration});
    }
    first = std::max(end, first + 1);
  }
  return flights;
}

/// The rate next to 1 / seconds whose duration lies between two others; 0 without one.
double rate_between(std::span<const double> rates, double shortest, double longest, double seconds) {
  double best = 0.0;
  for (const double rate : rates)
    if (1.0 / rate > shortest && 1.0 / rate < longest &&
        (best == 0.0 || std::abs(1.0 / rate - seconds) < std::abs(1.0 / best - seconds)))
      best = rate;
  return best;
}

/// What a digit at the last place of a printed number is worth.
double last_place(std::string_view text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size()), point = text.find('.');
  const auto power = number_from(text.substr(std::min(e + 1, text.size()))).value_or(0.0);
  const double decimals = point < e ? static_cast<double>(e - point - 1) : 0.0;
  return number_from("1e" + text_of(power - decimals)).value_or(0.0);
}

}  // namespace

std::string rate_text(double fps) { return formatted("%.6g", fps); }

double rate_of_frame_time(std::string_view text, double seconds) {
  const double fps = 1.0 / seconds, whole = std::round(fps);
  if (std::abs(fps - whole) < 1e-9 * fps) return whole;
  const double place = last_place(text), shortest = seconds - 0.51 * place, longest = seconds + 1.01 * place;
  for (const std::span<const double> rates : {std::span<const double>(kCommonRates), {kOtherRates}})
    if (const double rate = rate_between(rates, shortest, longest, seconds); rate > 0.0) return rate;
  return std::abs(fps - whole) < 5e-4 * fps ? whole : fps;
}

double usual_rate(double fps) {
  double best = 0.0;
  for (const double rate : {20.0, 24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 100.0, 120.0, 200.0, 240.0, 250.0})
    if (std::abs(fps / rate - 1.0) < 0.1 &&
        (best == 0.0 || std::abs(log(fps / rate)) < std::abs(log(fps / best))))
      best = rate;
  return best;
}

void require_no_time_step(const std::string& path, double fps) {
  if (const double rate = usual_rate(1.0 / fps); rate > 0.0)
    throw DataError(path, "", "a frame rate",
                    short_number(fps) + ", which is a time step: --fps " + rate_text(rate));
}

std::vector<std::string> odd_rate_warnings(double fps, int frames) {
  std::vector<std::string> said;
  if (fps < kSlowest || fps > kFastest)
    said.push_back("a frame rate of " + rate_text(fps) + " fps is odd: the motion takes " +
                   short_number(frames / fps) +
                   " s with it; --fps 30 (or what it was recorded at) overrides");
  else if (fps == frames && frames >= kManyFrames)
    said.push_back("the frame rate, " + rate_text(fps) +
                   " fps, is also the number of frames: was that meant? --fps overrides");
  return said;
}

std::optional<FallRate> rate_from_flights(const motion::Clip& clip) {
  const List<Flight> flights = flights_of(clip);
  if (flights.empty()) return std::nullopt;
  double sum = 0.0, weights = 0.0, rise = 0.0;
  for (const Flight& flight : flights) {
    // The uncertainty of the curvature falls with the fifth power of the length.
    const double weight = pow(flight.frames, 5);
    sum += weight * flight.acceleration;
    weights += weight;
    rise = std::max(rise, flight.rise());
  }
  const double per_frame = sum / weights;
  FallRate fall;
  fall.flights = flights.count();
  fall.acceleration = per_frame * clip.fps * clip.fps;
  fall.fps = std::sqrt(kGravity / per_frame);
  const double factor = fall.fps / clip.fps;
  if (std::max(factor, 1.0 / factor) > kLargestFactor) return std::nullopt;
  const bool same = std::all_of(flights.begin(), flights.end(), [&](const Flight& flight) {
    return std::abs(std::sqrt(kGravity / flight.acceleration) / fall.fps - 1.0) < kSameRate;
  });
  fall.agreed = flights.count() >= kSeveralFlights && same;
  fall.clear = rise > kRise || (flights.count() > 1 && same);
  return fall;
}

}  // namespace mimicx::import
