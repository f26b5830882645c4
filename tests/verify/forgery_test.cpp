// The verifier against honest certificates, forgeries and broken files. A forgery changes a sound certificate
// by at least ten times the tolerance of a rule and makes its hash again.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <functional>

#include "audit/certificate/certificate.h"
#include "audit/certificate/sha256.h"
#include "audit/thrown.h"
#include "core/random.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"
#include "physics/lanes.h"
#include "physics/step.h"
#include "rl/tracking/tracking_clip.h"
extern "C" {
#include "verify.h"
}

namespace mimicx::audit {
namespace {

constexpr std::size_t kHead = 64, kPlates = 5264, kPlate = 64, kRecord = 550, kState = 160, kNext = 69,
                      kBody = 20;
constexpr std::size_t kForces = kState + kNext + 147 + 63;
constexpr std::size_t kSteps = 24, kStride = 8;

struct Verdict {
  int status = BROKEN;
  std::string wrong;
  std::vector<int> failed;  ///< rules, in the order of the page
  std::string reasons() const {
    std::string text = wrong;
    for (const int rule : failed) text += " " + std::to_string(rule);
    return text;
  }
  bool names(int rule) const { return std::find(failed.begin(), failed.end(), rule) != failed.end(); }
};

Verdict verdict_of(const std::string& file, const std::string& motion = {}) {
  const auto bytes = [](const std::string& s) { return reinterpret_cast<const unsigned char*>(s.data()); };
  std::array<Rule, RULES> rules{};
  const char* wrong = nullptr;
  Verdict verdict;
  verdict.status = verify_bytes(bytes(file), file.size(), motion.empty() ? nullptr : bytes(motion),
                                motion.size(), rules.data(), &wrong);
  if (wrong != nullptr) verdict.wrong = wrong;
  if (verdict.status == BROKEN) return verdict;
  for (int i = 0; i < RULES; ++i) {
    const Rule& rule = rules[static_cast<std::size_t>(i)];
    if (rule.step >= 0 && !(rule.difference <= rule.tolerance)) verdict.failed.push_back(i);
  }
  return verdict;
}

double double_at(const std::string& file, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t i = 8; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(file[at + i]);
  return std::bit_cast<double>(bits);
}
void set_double(std::string& file, std::size_t at, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < 8; ++i) file[at + i] = static_cast<char>(bits >> 8 * i);
}
void set_integer(std::string& file, std::size_t at, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) file[at + i] = static_cast<char>(value >> 8 * i);
}
void rehash(std::string& file) {
  file.replace(file.size() - 32, 32, sha256({file.data(), file.size() - 32}));
}
std::size_t start_of(const std::string& file) {
  return kPlates + kPlate * static_cast<unsigned char>(file[24]);
}
std::size_t at_step(const std::string& file, std::size_t step, std::size_t column) {
  return start_of(file) + 8 * (step * kRecord + column);
}

/// A box under the left foot, a cushion of its height under the right one, which it overlaps, and a box far
/// away.
Scene boxes() {
  return {{{.centre = {1.0, 0.0}, .yaw = 3.1, .half_extents = {1.0, 1.2}, .height = 0.3},
           {.centre = {-1.0, -0.1},
            .yaw = -0.2,
            .half_extents = {1.1, 1.5},
            .height = 0.3,
            .stiffness = 15e3,
            .damping = 800.0},
           {.centre = {9.0, 0.0}, .half_extents = {1.0, 1.0}, .height = 0.5}}};
}

/// The end of a fall: bodies on the ground, friction, torques near their bounds.
SubstepMotion short_motion(std::size_t first = 300, const Scene& scene = {}) {
  static const Thrown flat, high(240.0, 0.08, boxes());
  SubstepMotion motion = (scene.flat() ? flat : high).steps();
  motion.last = motion.steps[first + kSteps].state;
  motion.steps = {motion.steps.begin() + static_cast<std::ptrdiff_t>(first),
                  motion.steps.begin() + static_cast<std::ptrdiff_t>(first + kSteps)};
  return motion;
}

/// A motion file with the frames of the steps.
/// @param fps  of its header: 30 is true
std::string motion_file(const SubstepMotion& motion, double fps = 30.0) {
  motion::Clip clip = test::standing_clip(static_cast<int>(kSteps / kStride) + 1, 0.9);
  clip.fps = fps;
  clip.betas = motion.character.betas;
  clip.scene = motion.scene;
  for (int t = 0; t < clip.frames(); ++t) {
    const std::size_t k = static_cast<std::size_t>(t) * kStride;
    const motion::ReferenceFrame& state = k < kSteps ? motion.steps[k].state : motion.last;
    clip.trans[t] = state.p_root - rest_pelvis("mimicx");
    for (int i = 0; i < kBodies; ++i) clip.rotations[t][i] = log_map(state.q[i].normalized());
  }
  const TemporaryFolder folder;
  motion::write_clip(folder.path / "m.npz", clip);
  return read_file(folder.path / "m.npz");
}

struct Honest {
  explicit Honest(const Scene& scene) : motion(short_motion(300, scene)) {}
  SubstepMotion motion;
  std::string npz = motion_file(motion);
  std::string file = certificate_of(motion, {npz, kStride});
};
const Honest& honest() {
  static const Honest certificate({});
  return certificate;
}
const Honest& honest_on_boxes() {
  static const Honest certificate(boxes());
  return certificate;
}

/// A run's folder with a motion and its steps.
struct RunFiles {
  TemporaryFolder folder;
  std::filesystem::path motion = folder.path / "motions/fall.npz", steps = folder.path / "substeps/fall.npz";
  explicit RunFiles(const std::string& npz, const SubstepMotion& motion_steps = honest().motion) {
    make_folder(motion.parent_path());
    make_folder(steps.parent_path());
    write_file_atomically(motion, npz);
    write_substeps(steps, motion_steps);
  }
};

TEST(Sha256, MatchesTheExamplesOfTheStandard) {
  const auto hex = [](const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
      text += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4];
      text += "0123456789abcdef"[static_cast<unsigned char>(c) & 15];
    }
    return text;
  };
  EXPECT_EQ(hex(sha256("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hex(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Verify, AcceptsHonestFallsWholeAndTheirMotions) {
  const Verdict verdict = verdict_of(honest().file, honest().npz);
  EXPECT_EQ(verdict.status, ACCEPTED) << verdict.reasons();
  for (const Scene& scene : {Scene{}, boxes()}) {
    const Verdict whole = verdict_of(certificate_of(Thrown(240.0, 0.08, scene).steps(), {"", 8}));
    EXPECT_EQ(whole.status, ACCEPTED) << whole.reasons();
  }
}

// The box and the cushion both push, and so does the scene of a run's files.
TEST(Verify, AcceptsAFallOnBoxes) {
  const Honest& sound = honest_on_boxes();
  const Verdict verdict = verdict_of(sound.file, sound.npz);
  EXPECT_EQ(verdict.status, ACCEPTED) << verdict.reasons();
  EXPECT_EQ(certify_file(RunFiles(sound.npz, sound.motion).motion), sound.file);
  for (const std::size_t plate : {0, 1}) {
    std::string without = sound.file;
    set_double(without, kPlates + kPlate * plate, 50.0);
    rehash(without);
    EXPECT_EQ(verdict_of(without).status, REJECTED) << plate;
  }
}

TEST(Verify, RefusesAnotherScene) {
  const Honest& sound = honest_on_boxes();
  const auto with = [&](const std::function<void(Scene&)>& change) {
    SubstepMotion motion = sound.motion;
    change(motion.scene);
    std::string head = certificate_of(motion, {sound.npz, kStride});
    const std::size_t start = start_of(head);  // the steps are the honest ones
    head.replace(start, std::string::npos, sound.file.substr(start_of(sound.file)));
    std::copy_n(sound.file.begin() + kHead + 8 * 21, 4 * 8, head.begin() + kHead + 8 * 21);  // its claims
    rehash(head);
    return std::pair{verdict_of(head), verdict_of(head, sound.npz)};
  };
  const auto refused = [&](const char* what, const std::vector<int>& reasons,
                           const std::function<void(Scene&)>& change) {
    const auto [alone, with_motion] = with(change);
    EXPECT_TRUE(with_motion.names(SCENE)) << what << with_motion.reasons();
    const bool named = std::any_of(reasons.begin(), reasons.end(), [&](int r) { return alone.names(r); });
    EXPECT_EQ(named, !reasons.empty()) << what << alone.reasons();
    EXPECT_EQ(alone.status, reasons.empty() ? ACCEPTED : REJECTED) << what << alone.reasons();
  };
  EXPECT_EQ(with([](Scene&) {}).second.status, ACCEPTED);
  for (int k = 0; k < 2; ++k) {
    refused("higher", {NORMAL}, [&](Scene& s) { s.plates[k].height += 1e-3; });
    refused("lower", {NORMAL, AIR}, [&](Scene& s) { s.plates[k].height -= 1e-3; });
    refused("moved", {NORMAL, AIR}, [&](Scene& s) { s.plates[k].centre.x() += 20.0; });
    refused("turned away", {NORMAL, AIR}, [&](Scene& s) {
      s.plates[k].half_extents = {0.01, 0.01};
      s.plates[k].yaw += 1.0;
    });
    refused("softer", {NORMAL}, [&](Scene& s) { s.plates[k].stiffness *= 0.9; });
    refused("more damped", {NORMAL}, [&](Scene& s) { s.plates[k].damping *= 1.1; });
  }
  refused("taken away", {AIR}, [](Scene& s) { s.plates = {s.plates[0], s.plates[2]}; });
  refused("added", {NORMAL}, [](Scene& s) {
    s.plates.push_back({.half_extents = {3.0, 3.0}, .height = 0.31, .stiffness = 15e3, .damping = 800.0});
  });
  refused("added far away", {}, [](Scene& s) {
    s.plates.push_back({.centre = {-9.0, 0.0}, .half_extents = {1.0, 1.0}, .height = 0.4});
  });
  refused("far one moved", {}, [](Scene& s) { s.plates[2].centre.x() += 1e-9; });
  // Numbers that no scene has.
  const std::array<std::pair<int, double>, 6> beyond = {
      {{0, 2e4}, {2, 8.0}, {3, 0.009}, {5, 11.0}, {6, 1999.0}, {7, 2e6}}};
  for (const auto& [number, value] : beyond) {
    std::string file = sound.file;
    set_double(file, kPlates + 2 * kPlate + 8 * static_cast<std::size_t>(number), value);
    rehash(file);
    EXPECT_EQ(verdict_of(file).failed, std::vector<int>{SCENE}) << number;
  }
}

TEST(Verify, ReplayRepeatsEveryBitAndFindsAChangedStep) {
  const TemporaryFolder folder;
  for (const Honest* sound : {&honest(), &honest_on_boxes()}) {
    write_file_atomically(folder.path / "c.cert", sound->file);
    const CertificateReplay replay = replay_certificate(folder.path / "c.cert");
    EXPECT_EQ(replay.steps, static_cast<long>(kSteps));
    EXPECT_EQ(replay.first_state, -1);
    EXPECT_EQ(replay.first_step, -1);
  }
  std::string file = honest().file;
  const std::size_t at = at_step(file, 7, kState + 5);
  set_double(file, at, std::nextafter(double_at(file, at), 1e9));
  rehash(file);
  write_file_atomically(folder.path / "c.cert", file);
  EXPECT_EQ(replay_certificate(folder.path / "c.cert").first_step, 7);
}

TEST(Verify, RefusesAnotherMotionFile) {
  const std::string other = motion_file(short_motion(200));
  const Verdict swapped = verdict_of(honest().file, other);
  EXPECT_TRUE(swapped.names(MOTION_FILE)) << swapped.reasons();
  // Its hash bound in: the frames give it away.
  const Verdict bound = verdict_of(certificate_of(honest().motion, {other, kStride}), other);
  EXPECT_FALSE(bound.names(MOTION_FILE));
  EXPECT_TRUE(bound.names(FRAMES)) << bound.reasons();
}

TEST(Verify, RefusesAnotherRateOrShapeOfTheMotionFile) {
  const auto bound = [](const std::string& npz) {
    return verdict_of(certificate_of(honest().motion, {npz, kStride}), npz);
  };
  EXPECT_EQ(bound(honest().npz).status, ACCEPTED);
  EXPECT_EQ(bound(motion_file(honest().motion, 60.0)).failed, std::vector<int>{FRAMES});
  SubstepMotion lighter = honest().motion;
  lighter.character = make_character({});
  EXPECT_EQ(bound(motion_file(lighter)).failed, std::vector<int>{FRAMES});
  EXPECT_THROW(certify_file(RunFiles(motion_file(lighter)).motion), DataError);
}

// Poses that a program might read otherwise than the verifier, bound in.
TEST(Verify, RefusesOtherFormsOfTheMotionFile) {
  const std::string& npz = honest().npz;
  const std::string shape = "'shape': (";
  const auto verdict = [](const std::string& changed) {
    return verdict_of(certificate_of(honest().motion, {changed, kStride}), changed);
  };
  const std::size_t member = npz.find("poses.npy"), header = member + 9,
                    sizes = npz.find(shape, header) + shape.size();
  const std::size_t end = npz.find(')', sizes), columns = npz.find(' ', sizes) + 1;
  const std::size_t count = std::stoul(npz.substr(columns));
  const auto with = [&](std::size_t at, const std::string& text) {
    return std::string(npz).replace(at, text.size(), text);
  };
  const auto refuse = [&](const char* what, const std::string& changed) {
    EXPECT_EQ(verdict(changed).failed, std::vector<int>{FRAMES}) << what;
  };
  ASSERT_EQ(npz.substr(sizes, 3), "4, ");
  EXPECT_EQ(verdict(with(end, ",), }")).status, ACCEPTED) << "a comma behind the sizes is Python's";
  refuse("twice the frames", with(sizes, "8, " + std::to_string(count / 2) + "), }  "));
  refuse("fewer columns", with(sizes, "4, " + std::to_string(count - 3) + "), }  "));
  refuse("more sizes", with(end, ", 1), }"));
  refuse("of other bytes", with(npz.find("<f8", header), ">f8"));
  refuse("column by column", with(npz.find("False", header), "True "));
  refuse("column by column, said later", with(end, "), 'fortran_order': True}"));
  refuse("no end of the header", with(header + 127, " "));
  refuse("a longer header", with(header + 8, "w"));
  refuse("another version of the header", with(header + 6, "\x02"));
  refuse("another name", with(member, "p0ses"));
  refuse("compressed", with(member - 30 + 8, "\x08"));
  std::string first = npz.substr(member - 30, header - member + 30 + 128 + 8 * 4 * count), bare = first;
  refuse("there twice", first + npz);
  bare.erase(30 + 5, 4);  // the name is `poses`
  bare[26] = 5;
  refuse("there twice, once without its suffix", bare + npz);
}

// mimicx itself would show other poses, another size or another body.
TEST(Verify, RefusesMembersThatProgramsPreferToThePoses) {
  const Npz sound = parse_npz(honest().npz, "sound.npz");
  const auto with = [&](const std::string& name, const NpyArray& array) {
    Npz npz = sound;
    npz.set(name, array);
    const std::string changed = format_npz(npz);
    return verdict_of(certificate_of(honest().motion, {changed, kStride}), changed);
  };
  const std::size_t frames = kSteps / kStride + 1;
  const std::vector<double> zeros(66 * frames, 0.0);
  EXPECT_EQ(with("labels", NpyArray::from_double({frames, 3}, zeros.data())).status, ACCEPTED);
  for (const char* name : {"root_orient", "global_orient"})
    EXPECT_EQ(with(name, NpyArray::from_double({frames, 3}, zeros.data())).failed, std::vector<int>{FRAMES})
        << name;
  for (const char* name : {"pose_body", "body_pose"})
    EXPECT_EQ(with(name, NpyArray::from_double({frames, 63}, zeros.data())).failed, std::vector<int>{FRAMES})
        << name;
  EXPECT_EQ(with("rest_joints", NpyArray::from_double({22, 3}, zeros.data())).failed,
            std::vector<int>{FRAMES});
  EXPECT_EQ(with("smpl_scaling", NpyArray::scalar(0.5)).failed, std::vector<int>{FRAMES});
  for (const char* model : {"smplx", "smplh", "mimic", "mimicy"})
    EXPECT_EQ(with("body_model", NpyArray::scalar_text(model)).failed, std::vector<int>{FRAMES}) << model;
  Npz without;
  for (const auto& [name, array] : sound.members())
    if (name != "body_model") without.set(name, array);
  const std::string bare = format_npz(without);
  EXPECT_EQ(verdict_of(certificate_of(honest().motion, {bare, kStride}), bare).failed,
            std::vector<int>{FRAMES});
}

TEST(Verify, RefusesAnAdversarysMotions) {
  const auto forged = [](const std::function<void(SubstepMotion&)>& change) {
    SubstepMotion motion = short_motion();
    change(motion);
    return verdict_of(certificate_of(motion, {"", kStride}));
  };
  const Verdict swapped = forged([](SubstepMotion& m) { std::swap(m.steps[5], m.steps[14]); });
  EXPECT_TRUE(swapped.names(VELOCITY) && swapped.names(ROTATION)) << swapped.reasons();
  const Verdict slower = forged([](SubstepMotion& m) {  // the same poses, in twice the time
    for (std::size_t i = 0; i < kSteps; ++i) {
      m.steps[i].state.v_root *= 0.5;
      for (auto& w : m.steps[i].state.omega) w *= 0.5;
    }
  });
  EXPECT_TRUE(slower.names(POSITION) && slower.names(ROTATION)) << slower.reasons();
  const Verdict lighter = forged([](SubstepMotion& m) { m.character = make_character({-3, -3}); });
  EXPECT_TRUE(lighter.names(VELOCITY) || lighter.names(SPIN)) << lighter.reasons();
  const Verdict lifted = forged([](SubstepMotion& m) {  // held 5 cm over the floor
    for (auto& step : m.steps) step.state.p_root.z() += 0.05;
    m.last.p_root.z() += 0.05;
  });
  EXPECT_TRUE(lifted.names(VELOCITY)) << lifted.reasons();

  std::string file = honest().file;  // a lighter body under the same shape
  for (std::size_t i = 0; i < kBodies; ++i) {
    const std::size_t at = kHead + 8 * (25 + kBody * i + 6);
    set_double(file, at, 0.5 * double_at(file, at));
  }
  rehash(file);
  const Verdict light = verdict_of(file);
  EXPECT_EQ(light.failed, std::vector<int>{SHAPE}) << light.reasons();
}

/// A number of a certificate, changed by at least ten times its rule's tolerance, and the rules that may say
/// so.
struct Forgery {
  const char* what;
  std::function<void(std::string&, Random&)> change;
  std::vector<int> reasons;  ///< one of them must fail
};

std::vector<Forgery> forgeries() {
  const auto pick = [](Random& random, std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count)) % count;
  };
  const auto moved = [](std::string& file, std::size_t at, double least, Random& random) {
    const double by = least * (1.0 + 9.0 * random.uniform());
    set_double(file, at, double_at(file, at) + (random.uniform() < 0.5 ? -by : by));
  };
  const auto column = [=](std::size_t first, std::size_t count, double least) {
    return [=](std::string& file, Random& random) {
      moved(file, at_step(file, pick(random, kSteps), first + pick(random, count)), least, random);
    };
  };
  const std::size_t targets = kState + kNext, torques = targets + 147;
  return {
      {"pelvis position", column(0, 3, 1e-4), {POSITION}},
      {"rotation", column(3, 88, 1e-4), {UNIT, ROTATION, AXIS}},
      {"pelvis velocity",
       column(91, 3, 0.1),
       {VELOCITY, POSITION, FORCE}},                                      // FORCE alone: of the first state
      {"joint velocity", column(94, 66, 10.0), {SPIN, ROTATION, JOINT}},  // JOINT alone: of the first state
      {"pelvis velocity after a step", column(kState, 3, 0.1), {VELOCITY}},
      {"joint velocity after a step", column(kState + 3, 66, 10.0), {SPIN}},
      {"a little acceleration", column(kState, 3, 1e-6), {FORCE, MOMENT}},
      {"a little turn", column(kState + 3, 66, 1e-3), {FORCE, MOMENT, JOINT, LAW, AXIS}},
      {"target", column(targets, 84, 1e-2), {LAW}},
      {"target's velocity", column(targets + 84, 63, 1e-2), {LAW}},
      {"torque", column(torques, 63, 1e-3), {LAW, JOINT}},
      {"contact force",
       [=](std::string& file, Random& random) {
         const std::size_t step = pick(random, kSteps);
         std::vector<std::size_t> pushing;
         for (std::size_t n = 0; n < 37; ++n)
           if (double_at(file, at_step(file, step, kForces + 3 * n + 2)) > 0.0) pushing.push_back(n);
         if (pushing.empty()) return set_double(file, at_step(file, step, kForces + 2), 1.0);
         const std::size_t n = pushing[pick(random, pushing.size())];
         moved(file, at_step(file, step, kForces + 3 * n + pick(random, 3)), 1e-3, random);
       },
       {NORMAL, SIDEWAYS, FORCE, AIR}},
      {"force in the air", column(kForces + 3 * 18, 3, 1e-3), {AIR, NORMAL, SIDEWAYS, FORCE}},
      {"contact shifted to another point",
       [=](std::string& file, Random& random) {
         const std::size_t step = pick(random, kSteps), from = pick(random, 37);
         const std::size_t to = (from + 1 + pick(random, 36)) % 37;
         for (std::size_t k = 0; k < 3; ++k) {
           const std::size_t a = at_step(file, step, kForces + 3 * from + k);
           const std::size_t b = at_step(file, step, kForces + 3 * to + k);
           const double kept = double_at(file, a) == 0.0 ? 100.0 : double_at(file, a);
           set_double(file, a, 0.0);
           set_double(file, b, kept);
         }
       },
       {AIR, NORMAL, SIDEWAYS, FORCE, MOMENT}},
      {"torque beyond its bound",
       [=](std::string& file, Random& random) {
         set_double(file, at_step(file, pick(random, kSteps), torques + pick(random, 63)), 1000.0);
       },
       {BOUND}},
      {"constant",
       [=](std::string& file, Random& random) {
         const std::size_t at = kHead + 8 * pick(random, 11);
         set_double(file, at, double_at(file, at) * (random.uniform() < 0.5 ? 0.9 : 1.1));
       },
       {CONSTANT}},
      {"shape",
       [=](std::string& file, Random& random) {
         moved(file, kHead + 8 * (11 + pick(random, 10)), 1e-4, random);
       },
       {SHAPE}},
      {"claim",
       [=](std::string& file, Random& random) {
         moved(file, kHead + 8 * (21 + pick(random, 4)), 1e-5, random);
       },
       {CLAIM}},
      {"body",
       [=](std::string& file, Random& random) {
         moved(file, kHead + 8 * (25 + pick(random, 22 * kBody)), 1e-8, random);
       },
       {SHAPE}},
      {"contact point",
       [=](std::string& file, Random& random) {
         moved(file, kHead + 8 * (25 + 22 * kBody + pick(random, 37 * 5)), 1e-8, random);
       },
       {SHAPE}},
      {"not finite",
       [=](std::string& file, Random& random) {
         set_double(file, at_step(file, pick(random, kSteps), pick(random, kRecord)),
                    random.uniform() < 0.5 ? std::nan("") : HUGE_VAL);
       },
       {FINITE}},
  };
}

/// How many forgeries, and how many broken files.
int count_of_forgeries() {
  const char* text = std::getenv("MIMICX_FORGERIES");
  return text != nullptr ? std::atoi(text) : 1000;
}

TEST(Verify, RefusesForgeriesForTheirReason) {
  const std::vector<Forgery> kinds = forgeries();
  const int count = count_of_forgeries();
  for (int k = 0; k < count; ++k) {
    const Forgery& kind = kinds[static_cast<std::size_t>(k) % kinds.size()];
    Random random(46, {static_cast<std::uint64_t>(k)});
    std::string file = (k / static_cast<int>(kinds.size()) % 2 == 0 ? honest() : honest_on_boxes()).file;
    kind.change(file, random);
    rehash(file);
    const Verdict verdict = verdict_of(file);
    EXPECT_EQ(verdict.status, REJECTED) << k << ": " << kind.what << " " << verdict.wrong;
    const bool named =
        std::any_of(kind.reasons.begin(), kind.reasons.end(), [&](int r) { return verdict.names(r); });
    EXPECT_TRUE(named) << k << ": " << kind.what << " " << verdict.reasons();
  }
}

TEST(Verify, SaysWhatIsWrongWithABrokenFile) {
  const std::string& sound = honest().file;
  const int count = count_of_forgeries();
  for (int k = 0; k < count; ++k) {
    Random random(47, {static_cast<std::uint64_t>(k)});
    std::string file = sound, wanted;
    const auto size = static_cast<double>(sound.size());
    switch (k % 8) {
      case 0:
        file.resize(static_cast<std::size_t>(random.uniform() * (size - 1)));
        wanted =
            file.size() < kPlates ? "not a certificate of version 6" : "size differs from that of its steps";
        break;
      case 1:
        file[kHead + static_cast<std::size_t>(random.uniform() * (size - kHead))] ^=
            static_cast<char>(1 << (k / 8 % 8));
        wanted = "hash differs";
        break;
      case 2:
        file[static_cast<std::size_t>(random.uniform() * 8)] ^= 4;
        wanted = "not a certificate of version 6";
        break;
      case 3:
        set_integer(file, 8, 7 + static_cast<std::uint64_t>(random.uniform() * 1e9), 4);
        wanted = "not a certificate of version 6";
        break;
      case 4:
        file += std::string(1 + static_cast<std::size_t>(random.uniform() * 100), 'x');
        wanted = "size differs from that of its steps";
        break;
      case 5:
        set_integer(file, 24, 65 + static_cast<std::uint64_t>(random.uniform() * 1e18), 8);
        wanted = "no or too many steps, or too many plates";
        break;
      case 6:
        set_integer(file, 16, 1 + (1U << 24) + static_cast<std::uint64_t>(random.uniform() * 1e18), 8);
        wanted = "no or too many steps, or too many plates";
        break;
      default:
        set_integer(file, 12, 241 + static_cast<std::uint64_t>(random.uniform() * 1e9), 4);
        wanted = "frames do not divide the steps";
    }
    if (k % 8 > 2 && k % 8 != 4) rehash(file);
    const Verdict verdict = verdict_of(file);
    EXPECT_EQ(verdict.status, BROKEN) << k;
    EXPECT_EQ(verdict.wrong, wanted) << k;
  }
}

TEST(Certificate, FromARunsFilesHasTheSameBytes) {
  const RunFiles run(honest().npz);
  const std::string file = certify_file(run.motion);
  EXPECT_EQ(file, honest().file);
  std::filesystem::remove(run.steps);
  EXPECT_THROW(certify_file(run.motion), DataError);
}

TEST(Certificate, RefusesFramesThatAreNotTheStates) {
  EXPECT_THROW(certify_file(RunFiles(motion_file(short_motion(200))).motion), DataError);
}

TEST(Certificate, RefusesAnotherSceneThanTheSteps) {
  SubstepMotion motion = honest_on_boxes().motion;
  motion.scene.plates[2].height += 0.1;
  EXPECT_THROW(certify_file(RunFiles(honest_on_boxes().npz, motion).motion), DataError);
}

// A falling body whose lowest point is within rounding of the ground: whichever step float32 takes, the
// record explains it. Without that the force of the first touch, some kN, is missing in one of the two.
TEST(Certificate, TakesTheContactsOfTheSimulator) {
  using Packed = physics::Pack<physics::kLanes>;
  for (const Scene& scene : {Scene{}, boxes()}) {
    const SubstepMotion fall = Thrown(240.0, 0.08, scene).steps();
    SubstepMotion motion = fall;
    motion.steps = {fall.steps[15]};
    motion::ReferenceFrame& state = motion.steps[0].state;
    state.v_root.z() = -1.0;
    const BodyPoses poses = forward_kinematics(motion.character, state.p_root, state.q);
    double lowest = 1e9;
    for (const ContactPoint& point : motion.character.contact_points) {
      const Vector3d p = lowest_position(point, poses);
      lowest = std::min(lowest, p.z() - scene.height_under(p));
    }
    const double touching = state.p_root.z() - lowest + motion.simulation.skin;
    const auto model = physics::make_model<float>(motion.character, {}, scene);
    const auto data = std::make_unique<physics::Data<Packed>>();
    std::array<int, 2> seen{};
    for (int k = -8; k <= 8; ++k) {
      state.p_root.z() = static_cast<float>(touching + 3e-8 * k);
      const physics::State<double> start = rl::tracking::simulator_state(state);
      physics::Target<double> target;
      for (int i = 0; i < kBodies; ++i) {
        target.q[i] = physics::from_eigen(motion.steps[0].target_q[i]);
        target.omega[i] = physics::from_eigen(motion.steps[0].target_omega[i]);
      }
      auto next = physics::in_all_lanes<Packed>(start);
      physics::step(model, physics::in_all_lanes<Packed>(target), next, *data);
      motion.last = rl::tracking::frame_of_state(physics::lane_of(next, 0));
      ++seen[data->ground_count > 0 ? 1 : 0];
      const Verdict verdict = verdict_of(certificate_of(motion, {"", 1}));
      for (const int rule : {VELOCITY, SPIN, FORCE, MOMENT, JOINT, AIR, NORMAL, SIDEWAYS, CLAIM})
        EXPECT_FALSE(verdict.names(rule)) << k << ":" << verdict.reasons();
    }
    EXPECT_GT(seen[0], 2);
    EXPECT_GT(seen[1], 2);
  }
}

TEST(Certificate, RefusesOtherSettings) {
  SubstepMotion motion = short_motion();
  motion.simulation.friction = 0.8;
  EXPECT_THROW(certificate_of(motion, {"", kStride}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::audit
