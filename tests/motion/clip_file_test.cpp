#include "motion/clip_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "core/temporary_folder.h"
#include "motion/full_clip.h"
#include "motion/keypoint_names.h"

namespace mimicx::motion {
namespace {

namespace fs = std::filesystem;
using test::clip_with_everything;
using test::counted;

Npz amass(std::size_t columns = 66) {
  Npz npz;
  npz.set("poses", test::counted(3, columns));
  npz.set("trans", test::counted(3, 3));
  npz.set("betas", NpyArray::from_double({16}, std::vector<double>(16).data()));
  npz.set("mocap_framerate", NpyArray::scalar(30.0));
  return npz;
}

Clip read(const Npz& npz) {
  const fs::path path = scratch("clip.npz");
  write_npz(path, npz);
  return read_clip(path);
}

/// The message of the DataError that reading gives; it always names the file.
std::string refusal(const Npz& npz) {
  try {
    read(npz);
  } catch (const DataError& e) {
    EXPECT_NE(std::string(e.what()).find("clip.npz"), std::string::npos) << e.what();
    return e.what();
  }
  return "nothing was refused";
}

void expect_refusal(const Npz& npz, const std::string& word) {
  const std::string message = refusal(npz);
  EXPECT_NE(message.find(word), std::string::npos) << message;
}

NpyArray with_value(NpyArray array, std::size_t at, double value) {
  std::vector<double> values = array.to_double();
  values[at] = value;
  return NpyArray::from_double(array.shape, values.data());
}

/// A member that passed through, or nullptr.
const NpyArray* passed_on(const Clip& clip, const std::string& key) {
  for (const auto& [name, array] : clip.passthrough)
    if (name == key) return &array;
  return nullptr;
}

TEST(ClipFile, RoundTripKeepsEveryBit) {
  const Clip clip = test::clip_with_everything();
  const fs::path path = scratch("round.npz");
  write_clip(path, clip, {{"reward", NpyArray::scalar(0.5)}});
  const Clip back = read_clip(path);
  EXPECT_EQ(back.name, "round");
  EXPECT_EQ(back.fps, clip.fps);
  EXPECT_EQ(back.rotations, clip.rotations);
  EXPECT_EQ(back.trans, clip.trans);
  EXPECT_EQ(back.betas, clip.betas);
  EXPECT_EQ(back.body_model, "mimicx");
  EXPECT_EQ(back.gender, "female");
  ASSERT_TRUE(back.keypoints);
  EXPECT_EQ(back.keypoints->names, clip.keypoints->names);
  EXPECT_EQ(back.keypoints->uvc, clip.keypoints->uvc);
  EXPECT_EQ(back.keypoints->intrinsics, clip.keypoints->intrinsics);
  EXPECT_EQ(back.keypoints->extrinsics, clip.keypoints->extrinsics);
  ASSERT_TRUE(passed_on(back, "pose_hand"));
  EXPECT_EQ(passed_on(back, "pose_hand")->bytes, clip.passthrough[0].second.bytes);
  EXPECT_TRUE(passed_on(back, "reward"));
  EXPECT_TRUE(back.warnings.empty());
}

TEST(ClipFile, WrittenFilesHaveTheDocumentedMembers) {
  const Npz npz = to_npz(test::clip_with_everything(), {{"joints", NpyArray::scalar(1.0)}});
  std::vector<std::string> keys;
  for (const auto& [key, array] : npz.members()) keys.push_back(key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"poses", "trans", "betas", "mocap_framerate", "gender", "joint_names",
                                      "body_model", "keypoints_2d", "keypoint_names", "camera_intrinsics",
                                      "camera_extrinsics", "pose_hand", "joints"}));
  EXPECT_EQ(npz.at("poses").shape, (std::vector<std::size_t>{5, 165})) << "with hands, as SMPL-X has it";
  EXPECT_EQ(npz.at("poses").type, NpyArray::Type::kFloat64);
  EXPECT_EQ(npz.at("joint_names").text[21], "right_wrist");
}

TEST(ClipFile, EveryLayoutReadsTheBodyAndKeepsTheOtherColumns) {
  for (const auto& [columns, model] :
       {std::pair<std::size_t, std::string>{66, "smplx"}, {72, "smpl"}, {156, "smplh"}, {165, "smplx"}}) {
    const Clip clip = read(amass(columns));
    EXPECT_EQ(clip.body_model, model) << columns;
    ASSERT_EQ(clip.frames(), 3);
    for (std::size_t t = 0; t < 3; ++t)
      for (std::size_t c = 0; c < 66; ++c)
        EXPECT_EQ(clip.rotations[t][c / 3][static_cast<int>(c % 3)],
                  amass(columns).at("poses").to_double()[t * columns + c]);
    const NpyArray* rest = passed_on(clip, "poses_rest");
    ASSERT_EQ(rest != nullptr, columns > 66);
    if (!rest) continue;
    EXPECT_EQ(rest->shape, (std::vector<std::size_t>{3, columns - 66}));
    EXPECT_EQ(rest->to_double()[columns - 66], 100.0 + 66.0 / 1000.0);
  }
}

TEST(ClipFile, UnusedColumnsAndBetasAreWrittenBackInPlace) {
  for (const std::size_t columns : {66u, 72u, 156u, 165u}) {
    Npz npz = amass(columns);
    npz.set("betas", test::counted(1, 16));
    const Npz back = to_npz(read(npz));
    EXPECT_EQ(back.at("poses").to_double(), npz.at("poses").to_double()) << columns;
    EXPECT_EQ(back.at("poses").shape, npz.at("poses").shape);
    EXPECT_EQ(back.at("betas").to_double(), npz.at("betas").to_double());
    EXPECT_FALSE(back.has("poses_rest") || back.has("betas_rest"));
  }
}

TEST(ClipFile, SmplxFilesAreWrittenWithNamedArrays) {
  Npz npz;
  npz.set("root_orient", test::counted(3, 3, 7.0));
  npz.set("pose_body", test::counted(3, 63, 8.0));
  npz.set("pose_hand", test::counted(3, 90, 9.0));
  npz.set("pose_eye", test::counted(3, 6, 10.0));
  npz.set("trans", test::counted(3, 3));
  npz.set("mocap_frame_rate", NpyArray::scalar(120.0));
  const Npz back = to_npz(read(npz));
  for (const char* key : {"root_orient", "pose_body", "pose_hand", "pose_eye", "trans", "mocap_frame_rate"}) {
    EXPECT_EQ(back.at(key).bytes, npz.at(key).bytes) << key;
    EXPECT_EQ(back.at(key).shape, npz.at(key).shape) << key;
  }
}

TEST(ClipFile, NamedArraysTakePrecedenceOverPoses) {
  Npz npz = amass(165);
  npz.set("root_orient", test::counted(3, 3, 7.0));
  npz.set("pose_body", test::counted(3, 63, 8.0));
  npz.set("pose_hand", test::counted(3, 90));
  npz.set("mocap_frame_rate", NpyArray::scalar_int(60));
  npz.set("surface_model_type", NpyArray::scalar_text("smplx_locked_head"));
  const Clip clip = read(npz);
  EXPECT_EQ(clip.body_model, "smplx");
  EXPECT_EQ(clip.rotations[1][0].x(), 107.0);
  EXPECT_EQ(clip.rotations[2][21].z(), 200.0 + 62.0 / 1000.0 + 8.0);
  EXPECT_TRUE(passed_on(clip, "pose_hand"));
  EXPECT_TRUE(passed_on(clip, "poses_rest"));
}

TEST(ClipFile, AmassFileOfSmplxKeepsAllColumns) {
  Npz npz = amass(165);
  const NpyArray poses = npz.at("poses");
  npz.set("root_orient", test::counted(3, 3, 7.0));
  npz.set("pose_body", test::counted(3, 63, 8.0));
  npz.set("pose_hand", test::counted(3, 90));
  const Npz back = to_npz(read(npz));
  EXPECT_EQ(back.at("poses").shape, poses.shape);
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t c = 66; c < 165; ++c)
      EXPECT_EQ(back.at("poses").to_double()[165 * t + c], poses.to_double()[165 * t + c]);
}

TEST(ClipFile, PosesBesideNamedArraysMustHaveTheirFrames) {
  Npz npz = amass(165);
  npz.set("root_orient", test::counted(3, 3, 7.0));
  npz.set("pose_body", test::counted(3, 63, 8.0));
  npz.set("poses", test::counted(4, 165));
  expect_refusal(npz, "poses: expected 3 frames as in root_orient, found shape (4, 165)");
}

TEST(ClipFile, WritesHandsAndJawOfNamedArraysIntoPoses) {
  Npz npz;
  npz.set("root_orient", test::counted(3, 3, 7.0));
  npz.set("pose_body", test::counted(3, 63, 8.0));
  npz.set("pose_hand", test::counted(3, 90, 9.0));
  npz.set("pose_jaw", test::counted(3, 3, 10.0));
  npz.set("trans", test::counted(3, 3));
  npz.set("mocap_frame_rate", NpyArray::scalar(120.0));
  const Npz back = to_npz(read(npz));
  const auto poses = to_matrix(back.at("poses"));
  ASSERT_EQ(poses.cols(), 165);
  EXPECT_EQ(poses.middleCols(66, 3), to_matrix(npz.at("pose_jaw")));
  EXPECT_TRUE(poses.middleCols(69, 6).isZero(0.0)) << "eyes at rest";
  EXPECT_EQ(poses.middleCols(75, 90), to_matrix(npz.at("pose_hand")));
}

TEST(ClipFile, ReadsBothFrameRateKeysAndRequiresOne) {
  Npz npz;
  for (const char* key : {"poses", "trans"}) npz.set(key, amass().at(key));
  expect_refusal(npz, "mocap_frame_rate");
  npz.set("mocap_frame_rate", NpyArray::scalar_int(120));
  EXPECT_EQ(read(npz).fps, 120.0);
  for (const double bad : {0.0, -30.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    npz.set("mocap_frame_rate", NpyArray::scalar(bad));
    expect_refusal(npz, "frame rate");
  }
  npz.set("mocap_frame_rate", NpyArray::scalar_text("30"));
  expect_refusal(npz, "found text in mocap_frame_rate");
  Npz pickled;
  for (const char* key : {"poses", "trans"}) pickled.set(key, amass().at(key));
  pickled.set_unsupported("fps", UnsupportedArray("a.npz", "fps", "numbers", "objects"));
  try {
    clip_from(pickled, "a");
    FAIL() << "there is no rate";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("found a pickled fps"), std::string::npos) << error.what();
  }
}

TEST(ClipFile, TheGivenRateStandsInForNoneAndForABadOne) {
  Npz npz;
  for (const char* key : {"poses", "trans"}) npz.set(key, amass().at(key));
  EXPECT_EQ(clip_from(npz, "a", {50.0, {}}).fps, 50.0);
  npz.set("fps", NpyArray::scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(clip_from(npz, "a", {50.0, {}}).fps, 50.0);
}

TEST(ClipFile, TwoRatesThatDisagreeGiveAWarning) {
  Npz npz = amass();
  npz.set("mocap_framerate", NpyArray::scalar(60.0));
  npz.set("fps", NpyArray::scalar(60.0));
  EXPECT_TRUE(read(npz).warnings.empty());
  npz.set("fps", NpyArray::scalar(30.0));
  const Clip clip = read(npz);
  EXPECT_EQ(clip.fps, 60.0);
  ASSERT_EQ(clip.warnings.size(), 1u);
  EXPECT_NE(clip.warnings[0].find("mocap_framerate says 60, fps says 30"), std::string::npos)
      << clip.warnings[0];
}

/// The columns of `poses` as named arrays beside it.
Npz with_named_arrays(const Npz& usual) {
  Npz npz = usual;
  const Eigen::MatrixXd poses = to_matrix(usual.at("poses"));
  npz.set("root_orient", from_matrix(poses.leftCols(3)));
  npz.set("pose_body", from_matrix(poses.middleCols(3, 63)));
  return npz;
}

TEST(ClipFile, TwoSourcesOfRotationsThatDifferGiveAWarning) {
  Npz still = amass(165);
  still.set("poses", from_matrix(Eigen::MatrixXd::Zero(3, 165)));
  Npz npz = with_named_arrays(still);
  EXPECT_TRUE(read(npz).warnings.empty());
  EXPECT_TRUE(read(npz).decisions.empty()) << "poses are written anew";
  npz.set("poses", with_value(npz.at("poses"), 165, 1.5));
  npz.set("fullpose", with_value(npz.at("poses"), 165 + 65, 0.1));
  const Clip clip = read(npz);
  EXPECT_EQ(clip.rotations[1][0], Vector3d(0, 0, 0));
  ASSERT_EQ(clip.warnings.size(), 1u);
  EXPECT_EQ(clip.warnings[0],
            "two sources of rotations: root_orient with pose_body, poses, fullpose differ by up to 1.5 rad; "
            "the first is used");
}

TEST(ClipFile, TwoSourcesOfPlacesThatDifferGiveAWarning) {
  Npz npz = amass();
  npz.set("transl", with_value(npz.at("trans"), 4, 3.5));
  ASSERT_EQ(read(npz).warnings.size(), 1u);
  EXPECT_NE(read(npz).warnings[0].find("two sources of places: trans, transl differ by up to 96.5;"),
            std::string::npos)
      << read(npz).warnings[0];
}

TEST(ClipFile, RoundingIsNoSecondSource) {
  Npz npz = amass();
  std::vector<float> narrow;
  npz.set("poses", from_matrix(0.02 * to_matrix(npz.at("poses"))));
  for (const double value : npz.at("poses").to_double()) narrow.push_back(static_cast<float>(value));
  npz.set("thetas", NpyArray::from_float({3, 66}, narrow.data()));
  EXPECT_TRUE(read(npz).warnings.empty());
}

TEST(ClipFile, OtherNamesOfTheMotionAreNotCopiedAndSaidButForeignMembersOfTheseNamesAre) {
  Npz npz = amass();
  npz.set("transl", npz.at("trans"));
  npz.set("root_orient", from_matrix(to_matrix(npz.at("poses")).leftCols(3)));
  npz.set("beta", npz.at("betas"));
  npz.set("pose", test::counted(4, 4));
  npz.set("theta", NpyArray::scalar_text("of the cone"));
  const Clip clip = read(npz);
  EXPECT_TRUE(clip.warnings.empty());
  ASSERT_EQ(clip.decisions.size(), 1u);
  EXPECT_EQ(clip.decisions[0],
            "not copied: root_orient, transl, beta (other names of members that are used)");
  const Npz back = to_npz(clip);
  for (const char* key : {"transl", "root_orient", "beta"}) EXPECT_FALSE(back.has(key)) << key;
  EXPECT_EQ(back.at("pose").bytes, npz.at("pose").bytes) << "no motion: it has other rows";
  EXPECT_EQ(back.at("theta").text, npz.at("theta").text);
}

TEST(ClipFile, ReadsTheNamesOfOtherPrograms) {
  const Npz usual = amass();
  const Clip want = read(usual);
  const auto renamed = [&](const std::string& poses, const std::string& trans, const std::string& rate) {
    Npz npz;
    npz.set(poses, usual.at("poses"));
    npz.set(trans, usual.at("trans"));
    npz.set(rate, usual.at("mocap_framerate"));
    return npz;
  };
  for (const auto& [poses, trans, rate] : {std::tuple{"smpl_poses", "smpl_trans", "fps"},
                                           {"fullpose", "transl", "frame_rate"},
                                           {"thetas", "translation", "framerate"},
                                           {"pose", "trans", "mocap_frame_rate"}}) {
    const Clip clip = read(renamed(poses, trans, rate));
    EXPECT_EQ(clip.rotations, want.rotations) << poses;
    EXPECT_EQ(clip.trans, want.trans) << trans;
    EXPECT_EQ(clip.fps, want.fps) << rate;
  }
  Npz split;
  const Eigen::MatrixXd poses = to_matrix(usual.at("poses"));
  split.set("global_orient", from_matrix(poses.leftCols(3)));
  Eigen::MatrixXd body = Eigen::MatrixXd::Constant(poses.rows(), 69, 0.25);
  body.leftCols(63) = poses.middleCols(3, 63);
  split.set("body_pose", from_matrix(body));
  split.set("transl", usual.at("trans"));
  split.set("fps", usual.at("mocap_framerate"));
  const Clip clip = read(split);
  EXPECT_EQ(clip.rotations, want.rotations);
  EXPECT_EQ(clip.body_model, "smpl");
  EXPECT_EQ(to_matrix(to_npz(clip).at("poses")).cols(), 72) << "the hands come back";
}

TEST(ClipFile, AistPlacesAreInTheUnitOfTheirScaling) {
  Npz npz;
  npz.set("smpl_poses", amass().at("poses"));
  npz.set("smpl_trans", amass().at("trans"));
  npz.set("smpl_scaling", NpyArray::scalar(4.0));
  const Clip clip = clip_from(npz, "a", {60.0, {}});
  EXPECT_EQ(clip.trans[1], Vector3d(read(amass()).trans[1] / 4.0));
  EXPECT_FALSE(to_npz(clip).has("smpl_scaling")) << "it holds no more";
  npz.set("smpl_scaling", NpyArray::scalar(0.0));
  EXPECT_THROW(clip_from(npz, "a", {60.0, {}}), DataError);
}

TEST(ClipFile, JointsOfThreeNumbersAreTheFlatLayout) {
  const Npz usual = amass();
  Npz npz = usual;
  NpyArray poses = usual.at("poses");
  poses.shape = {poses.shape[0], poses.shape[1] / 3, 3};
  npz.set("poses", poses);
  EXPECT_EQ(read(npz).rotations, read(usual).rotations);
  EXPECT_EQ(to_matrix(to_npz(read(npz)).at("poses")).cols(), to_matrix(usual.at("poses")).cols());
  const std::vector<double> matrices(3 * 22 * 9, 0.0);
  npz.set("poses", NpyArray::from_double({3, 22, 3, 3}, matrices.data()));
  expect_refusal(npz, "rotation matrices");
  for (const auto& [shape, name] : {std::pair(std::vector<std::size_t>{3, 24, 4}, "quaternions"),
                                    {{3, 96}, "quaternions"},
                                    {{3, 24, 6}, "6D rotations"},
                                    {{3, 144}, "6D rotations"}}) {
    npz.set("poses", NpyArray::from_double(shape, matrices.data()));
    expect_refusal(
        npz, std::string("expected rotations as axis-angle, found shape (3, ") +
                 (shape.size() == 3 ? "24, " + std::to_string(shape[2]) : std::to_string(shape[1])) + "), " +
                 name);
  }
}

TEST(ClipFile, OneOfSeveralPeopleIsRead) {
  const Npz usual = amass();
  const Eigen::MatrixXd poses = to_matrix(usual.at("poses")), trans = to_matrix(usual.at("trans"));
  const auto people = [](const Eigen::MatrixXd& one, double factor) {
    std::vector<double> values;
    for (const double by : {1.0, factor})
      for (Eigen::Index r = 0; r < one.rows(); ++r)
        for (Eigen::Index c = 0; c < one.cols(); ++c) values.push_back(by * one(r, c));
    return NpyArray::from_double(
        {2, static_cast<std::size_t>(one.rows()), static_cast<std::size_t>(one.cols())}, values.data());
  };
  Npz npz;
  npz.set("root_orient", people(poses.leftCols(3), 1.0));
  npz.set("pose_body", people(poses.middleCols(3, 63), 1.0));
  npz.set("trans", people(trans, 2.0));
  expect_refusal(npz, "--person 1 to 2");
  const Clip second = clip_from(npz, "a", {30.0, 2});
  EXPECT_EQ(second.rotations, read(usual).rotations);
  EXPECT_EQ(second.trans[1], Vector3d(2.0 * read(usual).trans[1]));
  EXPECT_THROW(clip_from(npz, "a", {30.0, 3}), DataError);
}

TEST(ClipFile, FramesInFrontOfPeopleAreRefused) {
  const std::vector<double> zeros(5 * 2 * 72, 0.0);
  Npz npz;
  npz.set("poses", NpyArray::from_double({5, 2, 72}, zeros.data()));
  npz.set("trans", NpyArray::from_double({5, 2, 3}, zeros.data()));
  expect_refusal(npz, "5 people in 2 frames, or 2 people in 5 frames");
  EXPECT_THROW(clip_from(npz, "a", {30.0, 1}), DataError) << "poses of different people";
}

TEST(ClipFile, WhatIsNotUsedNeedNotBeFinite) {
  Npz npz = amass();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  npz.set("poses", with_value(test::counted(3, 156), 100, nan));
  Eigen::MatrixXd betas = Eigen::MatrixXd::Zero(1, 16);
  betas(0, 12) = nan;
  npz.set("betas", from_matrix(betas));
  const Npz back = to_npz(read(npz));
  EXPECT_TRUE(std::isnan(to_matrix(back.at("poses"))(0, 100)));
  EXPECT_TRUE(std::isnan(back.at("betas").to_double()[12]));
}

TEST(ClipFile, OddMembersThatAreNotNeededDoNotCostTheMotion) {
  Npz npz = amass();
  npz.set("gender", NpyArray::from_text({"male", "male", "male"}));
  const std::vector<double> zeros(3 * 2 * 10, 0.0);
  npz.set("betas", NpyArray::from_double({3, 1, 10}, zeros.data()));
  EXPECT_TRUE(read(npz).warnings.empty());
  EXPECT_EQ(read(npz).gender, "male");
  npz.set("gender", NpyArray::from_text({"male", "female"}));
  npz.set("betas", NpyArray::from_double({3, 2, 10}, zeros.data()));
  EXPECT_EQ(read(npz).gender, "neutral");
  ASSERT_EQ(read(npz).warnings.size(), 1u);
  EXPECT_NE(read(npz).warnings[0].find("betas of shape (3, 2, 10)"), std::string::npos);
}

TEST(ClipFile, SaysWhatIsMissingAndWhatWasFound) {
  Npz npz;
  npz.set("cam", test::counted(3, 3));
  expect_refusal(npz, "found cam");
  npz.set_unsupported("smpl_thetas", UnsupportedArray("a", "smpl_thetas", "numbers", "a pickle"));
  try {
    clip_from(npz, "a");
    ADD_FAILURE();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("smpl_thetas (pickled"), std::string::npos) << error.what();
  }
}

TEST(ClipFile, JointsAreThoseOfTheClipsBody) {
  const Clip clip = read(amass());
  const std::vector<double> joints = joint_positions_member(clip).to_double();
  const auto poses = poses_of(clip);
  for (int t = 0; t < poses.count(); ++t)
    for (int b = 0; b < kBodies; ++b)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(joints[static_cast<std::size_t>(3 * (kBodies * t + b) + axis)], poses[t].p_WB[b][axis]);
}

TEST(ClipFile, RejectsBadDataNamingMemberAndReason) {
  Npz npz;
  for (const char* key : {"poses", "mocap_framerate"}) npz.set(key, amass().at(key));
  expect_refusal(npz, "'trans'");

  npz = amass();
  npz.set("poses", with_value(npz.at("poses"), 66 + 4, std::numeric_limits<double>::quiet_NaN()));
  expect_refusal(npz, "row 1");
  npz = amass();
  npz.set("trans", with_value(npz.at("trans"), 8, std::numeric_limits<double>::infinity()));
  expect_refusal(npz, "row 2");
  npz.set("trans", test::counted(2, 3));
  expect_refusal(npz, "3 frames");
  npz.set("trans", NpyArray::scalar_text("none"));
  expect_refusal(npz, "text");
  npz = amass();
  npz.set("poses", test::counted(3, 75));
  expect_refusal(npz, "75");
  npz.set("poses", test::counted(0, 66));
  npz.set("trans", test::counted(0, 3));
  expect_refusal(npz, "at least one frame");
  npz = amass();
  npz.set("betas", with_value(npz.at("betas"), 2, std::numeric_limits<double>::quiet_NaN()));
  expect_refusal(npz, "betas");
  npz = amass();
  npz.set("body_model", NpyArray::scalar_text("ghum"));
  expect_refusal(npz, "'ghum'");
  npz = amass();
  npz.set("keypoints_2d", test::counted(3, 4));
  npz.set("keypoint_names", NpyArray::from_text({"nose"}));
  npz.set("camera_intrinsics", test::counted(3, 3));
  npz.set("camera_extrinsics", test::counted(4, 4));
  expect_refusal(npz, "keypoints_2d");
}

TEST(ClipFile, RejectsAnotherJointOrder) {
  std::vector<std::string> names(kBodyNames.begin(), kBodyNames.end());
  Npz npz = amass();
  npz.set("joint_names", NpyArray::from_text(names));
  EXPECT_EQ(read(npz).frames(), 3);
  std::swap(names[4], names[5]);
  npz.set("joint_names", NpyArray::from_text(names));
  expect_refusal(npz, "'left_knee' as joint 4");
  names.resize(4);
  npz.set("joint_names", NpyArray::from_text(names));
  expect_refusal(npz, "end of the list");
}

TEST(ClipFile, ForeignBetasWarnOnceAndGiveTheStandardBody) {
  Npz npz = amass(156);
  EXPECT_TRUE(read(npz).warnings.empty());
  npz.set("betas", with_value(npz.at("betas"), 1, 2.0));
  const Clip foreign = read(npz);
  EXPECT_EQ(foreign.warnings.size(), 1u);
  EXPECT_EQ(foreign.betas[1], 2.0);
  EXPECT_EQ(foreign.usable_betas(), (std::array<double, kBetas>{}));

  npz.set("body_model", NpyArray::scalar_text("mimicx"));
  const Clip own = read(npz);
  EXPECT_TRUE(own.warnings.empty());
  EXPECT_EQ(own.usable_betas()[1], 2.0);
  npz.set("betas", with_value(npz.at("betas"), 1, 5.5));
  expect_refusal(npz, "within");
}

TEST(ClipFile, KeypointsWithoutCameraAreIgnoredWithAWarning) {
  Npz npz = to_npz(test::clip_with_everything());
  Npz without;
  for (const auto& [key, array] : npz.members())
    if (key != "camera_extrinsics") without.set(key, array);
  const Clip clip = read(without);
  EXPECT_FALSE(clip.keypoints);
  EXPECT_EQ(clip.warnings.size(), 1u);
  EXPECT_TRUE(std::any_of(clip.passthrough.begin(), clip.passthrough.end(),
                          [](const auto& m) { return m.first == "keypoints_2d"; }));
}

/// A file with `count` keypoints that have no names; keypoint k is at (k, 0).
Npz with_unnamed_keypoints(std::size_t count) {
  Npz npz = amass();
  std::vector<double> uvc;
  for (std::size_t i = 0; i < 3 * count; ++i)
    uvc.insert(uvc.end(), {static_cast<double>(i % count), 0.0, 1.0});
  const Matrix3d K = Vector3d(1000, 1000, 1).asDiagonal();
  npz.set("keypoints_2d", NpyArray::from_double({3, count, 3}, uvc.data()));
  npz.set("camera_intrinsics", from_matrix(K));
  npz.set("camera_extrinsics", from_matrix(Eigen::Matrix4d::Identity()));
  return npz;
}

TEST(ClipFile, NamesUnnamedKeypointsOfKnownCountAndReportsIt) {
  for (const auto& [count, set] : {std::pair<std::size_t, KeypointSet>{22, KeypointSet::kJoints22},
                                   {17, KeypointSet::kCoco17},
                                   {133, KeypointSet::kCoco133}}) {
    const Clip clip = read(with_unnamed_keypoints(count));
    ASSERT_TRUE(clip.keypoints) << count;
    EXPECT_EQ(clip.keypoints->names, keypoint_names(set));
    EXPECT_EQ(clip.keypoints->uvc[2][13].x(), 13.0);
    ASSERT_GE(clip.decisions.size(), 1u) << count;
    EXPECT_NE(clip.decisions[0].find("keypoints"), std::string::npos) << clip.decisions[0];
    EXPECT_NE(clip.decisions[0].find(count == 22 ? "the 22 joints" : "COCO"), std::string::npos)
        << clip.decisions[0];
  }
}

TEST(ClipFile, ReportsUnusedFaceAndFingerKeypointsInOneLine) {
  EXPECT_EQ(read(with_unnamed_keypoints(17)).decisions.size(), 1u);  // nose, eyes and ears need no words
  const Clip clip = read(with_unnamed_keypoints(133));
  ASSERT_EQ(clip.decisions.size(), 2u);
  EXPECT_NE(clip.decisions[1].find("18 of 133"), std::string::npos) << clip.decisions[1];
  EXPECT_EQ(clip.decisions[1].find('\n'), std::string::npos);
}

TEST(KeypointNames, AreKnownInEverySpelling) {
  for (const auto& [spelled, known] : {std::pair<std::string, std::string>{"left_hip", "left_hip"},
                                       {"LEFT_HIP", "left_hip"},
                                       {"left hip", "left_hip"},
                                       {"left-hip", "left_hip"},
                                       {"LeftHip", "left_hip"},
                                       {"leftHip", "left_hip"},
                                       {"LHip", "left_hip"},
                                       {"RBigToe", "right_big_toe"},
                                       {"MidHip", "pelvis"},
                                       {"Nose", "nose"},
                                       {"REar", "right_ear"},
                                       {"face-3", "face-3"},
                                       {"Thing", "Thing"},
                                       {"", ""}})
    EXPECT_EQ(known_keypoint_name(spelled), known) << spelled;
  for (const KeypointSet set : {KeypointSet::kJoints22, KeypointSet::kCoco17, KeypointSet::kCoco133})
    for (const std::string& name : keypoint_names(set)) EXPECT_EQ(known_keypoint_name(name), name);
}

TEST(ClipFile, NamesKeypointsThatItDoesNotKnow) {
  Npz npz = with_unnamed_keypoints(6);
  npz.set("keypoint_names", NpyArray::from_text({"LHip", "p0", "p1", "p2", "p3", "face-1"}));
  const Clip clip = read(npz);
  EXPECT_EQ(clip.keypoints->names[0], "left_hip");
  EXPECT_EQ(clip.decisions.at(0),
            "keypoints: 1 of 6 have a place on the body; the others (p0, p1, p2, …) are not used");
}

TEST(ClipFile, ReadsTheBodyModelInEverySpelling) {
  for (const auto& [spelled, model] :
       {std::pair{"SMPL-X", "smplx"}, {"SMPLX", "smplx"}, {"smpl+h", "smplh"}, {"SMPL", "smpl"}}) {
    Npz npz = with_unnamed_keypoints(22);
    npz.set("body_model", NpyArray::scalar_text(spelled));
    EXPECT_EQ(read(npz).body_model, model) << spelled;
  }
}

TEST(ClipFile, RejectsUnreadableKeypointNames) {
  Npz npz = with_unnamed_keypoints(22);
  npz.path = "pickled.npz";
  npz.set_unsupported("keypoint_names", UnsupportedArray("pickled.npz", "keypoint_names", "text", "objects"));
  EXPECT_THROW(clip_from(npz, "pickled"), UnsupportedArray);
}

TEST(ClipFile, RejectsNumbersAsKeypointNames) {
  Npz npz = with_unnamed_keypoints(3);
  npz.set("keypoint_names", test::counted(1, 3));
  expect_refusal(npz, "keypoint_names: expected text, found numbers");
}

TEST(ClipFile, RejectsUnnamedKeypointsOfUnknownCountInOneLine) {
  for (const std::size_t count : {1u, 16u, 25u, 134u}) {
    const std::string message = refusal(with_unnamed_keypoints(count));
    EXPECT_NE(message.find("keypoint_names"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(count) + " keypoints"), std::string::npos) << message;
    EXPECT_NE(message.find("22"), std::string::npos) << message;
    EXPECT_NE(message.find("17"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  Npz flat = with_unnamed_keypoints(22);
  flat.set("keypoints_2d", test::counted(3, 66));
  expect_refusal(flat, "keypoints_2d");
}

TEST(ClipFile, UndetectedKeypointsGetConfidenceZero) {
  Clip clip = test::clip_with_everything();
  clip.keypoints->uvc[2][1].x() = std::numeric_limits<double>::quiet_NaN();
  const fs::path path = scratch("keypoints.npz");
  write_clip(path, clip);
  EXPECT_EQ(read_clip(path).keypoints->uvc[2][1], Vector3d(0, 0, 0));
}

TEST(ClipFile, OtherShapesOfTheSameCameraAreTheSame) {
  const Clip want = test::clip_with_everything();
  const Npz usual = to_npz(want);
  const Matrix3d& k = want.keypoints->intrinsics;
  const std::size_t frames = want.rotations.size();
  const std::vector<double> four = {k(0, 0), k(1, 1), k(0, 2), k(1, 2)},
                            once = usual.at("camera_intrinsics").to_double();
  std::vector<double> repeated;
  for (std::size_t t = 0; t < frames; ++t) repeated.insert(repeated.end(), once.begin(), once.end());
  for (const NpyArray& intrinsics :
       {NpyArray::from_double({4}, four.data()), NpyArray::from_double({1, 3, 3}, once.data()),
        NpyArray::from_double({frames, 3, 3}, repeated.data())}) {
    Npz npz = usual;
    npz.set("camera_intrinsics", intrinsics);
    EXPECT_EQ(read(npz).keypoints->intrinsics, k);
  }
  repeated.back() += 1.0;
  Npz zoomed = usual;
  zoomed.set("camera_intrinsics", NpyArray::from_double({frames, 3, 3}, repeated.data()));
  expect_refusal(zoomed, "another one in frame " + std::to_string(frames - 1));

  std::vector<double> rows, rows_of_frames;
  const Eigen::Matrix4d camera = want.keypoints->extrinsics[0];
  for (int i = 0; i < 12; ++i) rows.push_back(camera(i / 4, i % 4));
  for (std::size_t t = 0; t < frames; ++t)
    rows_of_frames.insert(rows_of_frames.end(), rows.begin(), rows.end());
  Npz npz = usual;
  npz.set("camera_extrinsics", NpyArray::from_double({3, 4}, rows.data()));
  ASSERT_EQ(read(npz).keypoints->extrinsics.count(), 1);
  EXPECT_EQ(read(npz).keypoints->extrinsics[0], camera);
  npz.set("camera_extrinsics", NpyArray::from_double({frames, 3, 4}, rows_of_frames.data()));
  ASSERT_EQ(read(npz).keypoints->extrinsics.size(), frames);
  EXPECT_EQ(read(npz).keypoints->extrinsics[1], camera);
}

TEST(ClipFile, KeypointsWithoutConfidencesCountWhereTheyAreSeen) {
  Npz npz = with_unnamed_keypoints(17);
  std::vector<double> uv;
  for (std::size_t i = 0; i < 3 * 17; ++i) uv.insert(uv.end(), {100.0 + static_cast<double>(i), 50.0});
  uv[0] = uv[1] = 0.0;
  uv[3] = std::numeric_limits<double>::quiet_NaN();
  npz.set("keypoints_2d", NpyArray::from_double({3, 17, 2}, uv.data()));
  const Clip clip = read(npz);
  EXPECT_EQ(clip.keypoints->uvc[0][0], Vector3d(0, 0, 0));
  EXPECT_EQ(clip.keypoints->uvc[0][1], Vector3d(0, 0, 0));
  EXPECT_EQ(clip.keypoints->uvc[2][16], Vector3d(150, 50, 1));
  EXPECT_TRUE(std::any_of(clip.decisions.begin(), clip.decisions.end(), [](const std::string& line) {
    return line.starts_with("keypoints: without confidences");
  }));
}

TEST(RealFiles, AreRead) {
  const fs::path motions = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(motions)) GTEST_SKIP() << "no folder of real motions here";
  int files = 0;
  for (const char* folder : {"video", "amass"})
    for (const auto& entry : fs::directory_iterator(motions / folder)) {
      if (entry.path().extension() != ".npz") continue;
      const Clip clip = read_clip(entry.path());
      EXPECT_GT(clip.frames(), 30) << entry.path();
      EXPECT_EQ(clip.fps, 30.0);
      EXPECT_EQ(clip.body_model, folder == std::string("video") ? "smpl" : "smplh");
      EXPECT_FALSE(clip.keypoints);
      ++files;
    }
  EXPECT_GT(files, 10);
}

}  // namespace
}  // namespace mimicx::motion
