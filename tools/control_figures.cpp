// The figures of docs/control.md, as SVG:
//   control_figures docs/figures
// writes control_lqr.svg, control_ilqr.svg, control_shooting.svg, control_contact.svg and control_pushes.svg
// and prints the numbers in them. Motions are synthetic, seed 501. A build gives the same bytes each time;
// builds for other instruction sets have other numbers of lanes, and so of step lengths.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "control/fixtures.h"
#include "control/gains.h"
#include "control/plan.h"
#include "control/shooting.h"
#include "core/elementary.h"
#include "core/file.h"
#include "core/units.h"
#include "line_plot.h"
#include "physics/step.h"

namespace mimicx::tools {
namespace {

using namespace control;

constexpr int kThreads = 2;
constexpr auto kInfinity = std::numeric_limits<double>::infinity();
using Style = Curve::Style;

// The regulator: docs/control.md §1

/// V after each of some sweeps from V = Q, and the law of the last one: the double integrator of
/// docs/control.md §1, its place costing 1 and a push ¼ per second.
struct Regulator {
  Eigen::Matrix<float, 2, 3, Eigen::RowMajor> F;
  List<Eigen::Matrix2d> V;
  Eigen::RowVector2d K;
  double dt;

  Regulator(double frame, int sweeps) : dt(frame) {
    const auto h = static_cast<float>(frame);
    F << 1, h, 0.5f * h * h, 0, 1, h;
    ValueFunction value{Eigen::Vector2d(dt, 0.0).asDiagonal(), Eigen::Vector2d::Zero()};
    V.push_back(value.V);
    Feedback law;
    RiccatiScratch<double> scratch;
    for (int k = 0; k < sweeps; ++k) {
      StageCost cost{Eigen::Vector3d(dt, 0.0, 0.25 * dt).asDiagonal(), Eigen::Vector3d::Zero()};
      riccati_step({F, {}, 0}, 0.0, cost, value, law, scratch);
      V.push_back(value.V);
    }
    K = law.K.cast<double>();
  }
};

/// Places and speeds from place 1 at rest under the law.
void add_motion(const Regulator& regulator, double seconds, Curve& place, Curve& speed) {
  const Eigen::Matrix<double, 2, 3> F = regulator.F.cast<double>();
  Eigen::Vector2d x(1.0, 0.0);
  for (int t = 0; t * regulator.dt <= seconds; ++t) {
    for (Curve* curve : {&place, &speed}) curve->x.push_back(t * regulator.dt);
    place.y.push_back(x[0]);
    speed.y.push_back(x[1]);
    x = F * Eigen::Vector3d(x[0], x[1], regulator.K * x);
  }
}

std::string lqr_figure() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0)), limits[] = {golden, 0.5, 0.25 * std::sqrt(5.0)};
  const Regulator second(1.0, 40), eighth(0.125, 400);
  Panel values{"frames of 1 s: the sweep", "frames from the end", "entries of V", {}};
  const char* names[] = {"V₁₁, dashed: φ", "V₁₂, dashed: ½", "V₂₂, dashed: √5/4"};
  for (int entry = 0; entry < 3; ++entry) {
    Curve swept{names[entry], Style::kLineAndDots, entry, {}, {}};
    for (int k = 0; k <= 6; ++k) {
      swept.x.push_back(k);
      swept.y.push_back(second.V[k](entry / 2, (entry + 1) / 2));
    }
    values.curves.push_back(swept);
    values.curves.push_back({"", Style::kDashed, entry, {0.0, 6.0}, {limits[entry], limits[entry]}});
  }
  Curve place{"place, m: the closed form", Style::kLine, 0, {}, {}};
  Curve speed{"speed, m/s: the closed form", Style::kLine, 1, {}, {}};
  for (int k = 0; k <= 60; ++k) {
    const double t = 0.1 * k;
    for (Curve* curve : {&place, &speed}) curve->x.push_back(t);
    place.y.push_back(exp(-t) * (cos(t) + sin(t)));
    speed.y.push_back(-2.0 * exp(-t) * sin(t));
  }
  Curve fine_place{"dots: frames of ⅛ s", Style::kDots, 4, {}, {}}, fine_speed{"", Style::kDots, 4, {}, {}};
  add_motion(eighth, 6.0, fine_place, fine_speed);
  Panel motion{"short frames: the law at work", "time, s", "place, m; speed, m/s", {}};
  motion.curves = {fine_place, fine_speed, place, speed};
  return line_plot("A mass on a line under the linear-quadratic regulator", {values, motion});
}

// iLQR and multiple shooting: docs/control.md §3

System synthetic_system(const std::string& kind) { return system_of(synthetic_reference(kind, 501)); }

/// The reference's own states, controls of zero, gaps between them.
Trajectory with_gaps(const System& system, int begin, int frames) {
  Trajectory window;
  window.begin = begin;
  for (int t = begin; t <= begin + frames; ++t) window.x.push_back(as_floats(system.at(t)));
  window.u.resize(frames);
  window.gaps = find_gaps(system, window);
  window.cost = window.worst = kInfinity;
  return window;
}
/// The roll-out of controls of zero from the reference's first state.
Trajectory rolled_out(const System& system, const Cost& cost, int begin, int frames) {
  Trajectory window = with_gaps(system, begin, frames);
  replay_controls(system, cost, window);
  return window;
}

/// What iterations of iLQR make of a window.
struct Course {
  std::vector<double> cost;      ///< [iterations + 1]
  std::vector<double> promised;  ///< [iterations + 1] the cost that the sweep promised for a full step
  std::vector<double> alpha;     ///< [iterations + 1] the step length taken; 0: none was better
};

Course improve_often(const System& system, const Cost& cost, Trajectory window, int iterations) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Course course{{window.cost}, {kNone}, {kNone}};
  IterationState state;
  for (int k = 0; k < iterations; ++k) {
    const double before = window.cost;
    const Iteration done = improve({system, cost}, 0.2, kThreads, state, window);
    course.cost.push_back(window.cost);
    course.promised.push_back(before - state.sweep.decrease);
    course.alpha.push_back(static_cast<double>(done.alpha));
  }
  return course;
}

void print(const std::string& name, const std::vector<double>& values, const char* format = " %.3g") {
  std::printf("  %-40s", name.c_str());
  for (double value : values) std::printf(format, value);
  std::printf("\n");
}

std::vector<double> count_from_zero(std::size_t n) {
  std::vector<double> out(n);
  for (std::size_t k = 0; k < n; ++k) out[k] = static_cast<double>(k);
  return out;
}

constexpr int kBegin = 30;  ///< first frame of the windows, a second into the walk

std::string ilqr_figure(const System& system, const Cost& cost) {
  const Trajectory start = rolled_out(system, cost, kBegin, 40);
  const Course course = improve_often(system, cost, start, 10);
  const std::vector<double> iterations = count_from_zero(course.cost.size());
  std::printf("control_ilqr: a window of 40 frames, from the roll-out of residuals of zero\n");
  print("cost", course.cost);
  print("distance of the roll-out, m", {start.worst});
  print("promised", course.promised);
  print("step length", course.alpha);
  Panel costs{"a window of 40 frames", "iteration", "cost", {}, true};
  costs.curves = {{"cost of the roll-out", Style::kLineAndDots, 0, iterations, course.cost},
                  {"promised by the sweep for a full step", Style::kDots, 1, iterations, course.promised}};
  Panel steps{"the line search", "iteration", "step length α", {}};
  steps.from_zero = true;
  steps.curves = {{"the full step", Style::kDashed, 4, {0.0, 10.0}, {1.0, 1.0}},
                  {"taken", Style::kLineAndDots, 0, iterations, course.alpha}};
  return line_plot("iLQR: cost of a window over the iterations, and the steps taken", {costs, steps});
}

std::string shooting_figure(const System& system, const Cost& cost) {
  std::printf("control_shooting: from roll-outs, and from the reference's own states\n");
  Panel gaps{
      "gaps between the reference's states", "frame of the window", "gap of the pelvis' velocity, m/s", {}};
  Curve gap{"what a frame reaches, minus the next state", Style::kLineAndDots, 2, {}, {}};
  for (const Eigen::VectorXd& g : with_gaps(system, kBegin, 60).gaps) {
    gap.x.push_back(static_cast<double>(gap.y.size()));
    gap.y.push_back(g.segment<3>(kRootVelocity).norm());
  }
  print("largest gap of the pelvis' velocity, m/s", {*std::max_element(gap.y.begin(), gap.y.end())});
  gaps.curves = {gap};
  Panel costs{"cost of the window", "iteration", "cost", {}, true};
  for (const int frames : {60, 90}) {
    const Course single = improve_often(system, cost, rolled_out(system, cost, kBegin, frames), 10);
    const Course multiple = improve_often(system, cost, with_gaps(system, kBegin, frames), 10);
    const std::vector<double> iterations = count_from_zero(single.cost.size());
    const std::string size = std::to_string(frames) + " frames";
    print(size + ", from a roll-out", single.cost);
    print(size + ", from states with gaps", multiple.cost);
    const Style style = frames == 60 ? Style::kLineAndDots : Style::kDashed;
    costs.curves.push_back({size + ", from a roll-out", style, 1, iterations, single.cost});
    costs.curves.push_back({size + ", from states with gaps", style, 0, iterations, multiple.cost});
  }
  return line_plot("Multiple shooting: gaps, and cost over the iterations", {gaps, costs});
}

// Contact: docs/control.md §4

/// A body at rest with its lowest contact point `height` above the height at which the floor begins to act.
State<double> standing_at(const System& system, double height) {
  State<double> x = system.at(0);
  x.v_root = zero3<double>();
  x.omega.fill(zero3<double>());
  const BodyPoses poses = poses_of(system, x);
  double lowest = kInfinity;
  for (const ContactPoint& point : system.model.contacts)
    lowest = std::min(lowest, lowest_position(point, poses).z());
  x.p_root.z += height + system.model.config.skin - lowest;
  return x;
}

/// Vertical force of the floor in the first physics step, N.
double floor_force(const System& system, State<double> x) {
  const auto data = std::make_unique<Data<double>>();
  Target<double> target{};
  target.q = x.q;
  physics::step(system.exact_model, target, x, *data);
  double force = 0.0;
  for (int k = 0; k < data->ground_count; ++k) force += data->ground[k].applied.z;
  return force;
}

/// Vertical velocity of the pelvis after a control frame, m/s.
double velocity_after(const System& system, State<double> x) {
  const auto data = std::make_unique<Data<double>>();
  Target<double> target{};
  target.q = x.q;
  advance_interval<double>(system.exact_model, {target, target, system.substeps}, x, *data);
  return x.v_root.z;
}

/// A line through a point, over some mm to both sides.
Curve slope(Curve line, const Eigen::Vector2d& through, double rise, double mm) {
  line.x = {through.x() - mm, through.x() + mm};
  line.y = {through.y() - mm * rise, through.y() + mm * rise};
  return line;
}

std::string contact_figure(const System& stand) {
  Panel force{"the floor's force on the feet at rest", "height of the soles, mm", "force, N", {}};
  Panel velocity{"a frame (1/30 s) later", "height of the soles, mm", "pelvis' vertical velocity, m/s", {}};
  Curve forces{"in the first physics step", Style::kLine, 0, {}, {}},
      velocities{"simulated", Style::kLine, 0, {}, {}};
  for (int k = -100; k <= 100; ++k) {
    const State<double> x = standing_at(stand, 1e-4 * k);
    velocities.x.push_back(0.1 * k);
    velocities.y.push_back(velocity_after(stand, x));
    if (std::abs(k) > 50 || (std::abs(k) > 10 && k % 10 != 0)) continue;
    forces.x.push_back(0.1 * k);
    forces.y.push_back(floor_force(stand, x));
  }
  std::printf("control_contact: standing at rest, soles at some height\n");
  print("height, mm", forces.x);
  print("force, N", forces.y, " %.0f");
  print("weight, N", {kGravity * stand.mass});
  force.curves = {forces};
  velocity.curves = {velocities};
  const auto scratch = std::make_unique<LinearisationScratch>();
  for (const double height : {-2.0, 2.0}) {
    const FramePoint point{0, standing_at(stand, 1e-3 * height), {}, {}};
    const double at = velocity_after(stand, point.x);
    const auto rise = [](const FrameMatrix& F) {
      return 1e-3 * static_cast<double>(F(kRootVelocity + 2, 2));
    };
    const double exact = rise(linearise(stand, point, *scratch));
    const double smoothed = rise(linearise_smoothed(stand, point, *GainConfig{}.smoothing));
    print("height, velocity, slopes in m/s per mm", {height, at, exact, smoothed});
    const bool first = height < 0.0;
    velocity.curves.push_back(slope({first ? "derivatives at −2 and 2 mm" : "", Style::kDashed, 1, {}, {}},
                                    {height, at}, exact, 4.0));
    velocity.curves.push_back(slope({first ? "smoothed derivatives there" : "", Style::kLine, 2, {}, {}},
                                    {height, at}, smoothed, 8.0));
  }
  return line_plot("What feet feel of the floor, and its derivatives", {force, velocity});
}

std::string pushes_figure(const System& system, const Cost& cost) {
  const Trajectory plan = trajectory_of(make_plan(system, {}, {.threads = kThreads}));
  GainConfig stiff;
  stiff.smoothing = {};
  stiff.residual = cost.weights.residual;
  stiff.change = cost.weights.change;
  GainConfig wide = stiff, dear;
  wide.smoothing = GainConfig{}.smoothing;
  dear.smoothing = {};
  const PlanControl control{.threads = kThreads};
  struct Law {
    std::string name;
    List<Eigen::MatrixXf> gains;
  };
  const Law laws[] = {{"softened: both", feedback_gains(system, cost, plan, {}, control)},
                      {"smoothed derivatives alone", feedback_gains(system, cost, plan, wide, control)},
                      {"dear residuals alone", feedback_gains(system, cost, plan, dear, control)},
                      {"stiff: neither", feedback_gains(system, cost, plan, stiff, control)},
                      {"no feedback", {}}};
  std::printf("control_pushes: trials of 16 that are followed to the end\n");
  const std::vector<double> speeds = {0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3};
  print("push, m/s", speeds);
  Panel followed{"pushes once a second", "push, m/s", "trials followed, of 16", {}};
  Panel kept{"how long", "push, m/s", "frames followed, mean", {}};
  kept.from_zero = true;
  for (int k = 0; k < 5; ++k) {
    Curve curve{laws[k].name, Style::kLineAndDots, k, speeds, {}}, frames = curve;
    for (const double speed : speeds) {
      const PushResult result = test_pushes(system, cost, plan, laws[k].gains, {.speed = speed});
      curve.y.push_back(result.followed);
      frames.y.push_back(result.frames_kept);
    }
    print(laws[k].name, curve.y);
    print("  frames followed, mean", frames.y, " %.0f");
    followed.curves.push_back(curve);
    frames.name.clear();
    kept.curves.push_back(frames);
  }
  return line_plot("Pushes that a plan survives under its feedback gains", {followed, kept});
}

void draw_all(const std::filesystem::path& folder) {
  const System walk = synthetic_system("walk");
  const Cost cost = make_cost(walk, {});
  write_file_atomically(folder / "control_lqr.svg", lqr_figure());
  write_file_atomically(folder / "control_ilqr.svg", ilqr_figure(walk, cost));
  write_file_atomically(folder / "control_shooting.svg", shooting_figure(walk, cost));
  write_file_atomically(folder / "control_contact.svg", contact_figure(synthetic_system("stand")));
  write_file_atomically(folder / "control_pushes.svg", pushes_figure(walk, cost));
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: control_figures FOLDER\n");
    return 2;
  }
  try {
    mimicx::tools::draw_all(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "control_figures: %s\n", error.what());
    return 1;
  }
  return 0;
}
