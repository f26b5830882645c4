#include "import/retarget/joint_names.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "import/retarget/skeletons.h"
#include "import/text_input.h"

namespace mimicx::import {
namespace {

using Names = PerBody<std::string>;
using Words = std::vector<std::string>;

/// A skeleton with the tree of the 22 bodies and the given names; an empty name leaves the body out: what
/// hangs on it hangs on its parent instead. @param joint  index of each body's joint, -1 where left out
SkeletonMotion skeleton(const Names& names, PerBody<int>& joint) {
  SkeletonMotion motion;
  motion.path = "made";
  joint.fill(-1);
  for (int b = 0; b < kBodies; ++b) {
    int parent = kParents[b];
    while (parent >= 0 && joint[parent] < 0) parent = kParents[parent];
    if (names[b].empty()) continue;
    joint[b] = motion.joints.count();
    motion.joints.push_back({names[b], parent < 0 ? -1 : joint[parent], Vector3d(0, 1, 0), false});
  }
  return motion;
}

/// Bodies that a map must find, spine1 and spine2 apart.
void expect_found(const std::string& vocabulary, const Names& names) {
  PerBody<int> joint;
  const SkeletonMotion motion = skeleton(names, joint);
  JointMap map = map_joints(motion);
  map[kSpine1] = joint[kSpine1];
  map[kSpine2] = joint[kSpine2];
  for (int b = 0; b < kBodies; ++b) EXPECT_EQ(map[b], joint[b]) << vocabulary << ": " << kBodyNames[b];
}

/// Left and right of pairs of names in which '#' stands for the side; the trunk apart.
Names both(const std::string& left, const std::string& right, const Words& middle, const Words& limbs) {
  const auto side = [&](const std::string& name, const std::string& s) {
    const std::size_t at = name.find('#');
    return at == std::string::npos ? name : name.substr(0, at) + s + name.substr(at + 1);
  };
  Names names;
  const Array<int, 6> middle_bodies = {kPelvis, kSpine1, kSpine2, kSpine3, kNeck, kHead};
  for (std::size_t i = 0; i < 6; ++i) names[middle_bodies[i]] = middle[i];
  const Array<int, 8> left_bodies = {kLeftHip,    kLeftKnee,     kLeftAnkle, kLeftFoot,
                                     kLeftCollar, kLeftShoulder, kLeftElbow, kLeftWrist};
  for (std::size_t i = 0; i < 8; ++i) {
    const int b = left_bodies[i];
    names[b] = side(limbs[i], left);
    names[b + 1] = side(limbs[i], right);
  }
  return names;
}

TEST(JointNames, UnderstandsCommonNamingConventions) {
  expect_found("Mixamo", test::mixamo_names());
  expect_found("LAFAN1", both("Left", "Right", {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head"},
                              {"#UpLeg", "#Leg", "#Foot", "#Toe", "#Shoulder", "#Arm", "#ForeArm", "#Hand"}));
  expect_found("CMU",
               both("Left", "Right", {"Hips", "LowerBack", "Spine", "Spine1", "Neck1", "Head"},
                    {"#UpLeg", "#Leg", "#Foot", "#ToeBase", "#Shoulder", "#Arm", "#ForeArm", "#Hand"}));
  expect_found("Bandai", both("L", "R", {"Hips", "Spine", "", "Chest", "Neck", "Head"},
                              {"UpperLeg_#", "LowerLeg_#", "Foot_#", "Toes_#", "Shoulder_#", "UpperArm_#",
                               "LowerArm_#", "Hand_#"}));
  expect_found("Daz", both("l", "r", {"hip", "abdomen", "", "chest", "neck", "head"},
                           {"#Thigh", "#Shin", "#Foot", "", "#Collar", "#Shldr", "#ForeArm", "#Hand"}));
  Names smpl;
  std::copy(kBodyNames.begin(), kBodyNames.end(), smpl.begin());
  expect_found("SMPL", smpl);
  expect_found("SMPL, short", both("L", "R", {"Pelvis", "Spine1", "Spine2", "Spine3", "Neck", "Head"},
                                   {"#_Hip", "#_Knee", "#_Ankle", "#_Foot", "#_Collar", "#_Shoulder",
                                    "#_Elbow", "#_Wrist"}));
  expect_found("Biovision",
               both("Left", "Right", {"Hips", "Chest", "Chest2", "Chest3", "Neck", "Head"},
                    {"#Hip", "#Knee", "#Ankle", "#Toe", "#Collar", "#Shoulder", "#Elbow", "#Wrist"}));
  expect_found("Biped", both("L", "R",
                             {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Neck",
                              "Bip01 Head"},
                             {"Bip01 # Thigh", "Bip01 # Calf", "Bip01 # Foot", "Bip01 # Toe0",
                              "Bip01 # Clavicle", "Bip01 # UpperArm", "Bip01 # Forearm", "Bip01 # Hand"}));
  expect_found("Unreal", both("l", "r", {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head"},
                              {"thigh_#", "calf_#", "foot_#", "ball_#", "clavicle_#", "upperarm_#",
                               "lowerarm_#", "hand_#"}));
  expect_found("Unity", both("Left", "Right", {"Hips", "Spine", "Chest", "UpperChest", "Neck", "Head"},
                             {"#UpperLeg", "#LowerLeg", "#Foot", "#Toes", "#Shoulder", "#UpperArm",
                              "#LowerArm", "#Hand"}));
  expect_found("ASF",
               both("l", "r", {"root", "lowerback", "upperback", "thorax", "lowerneck", "head"},
                    {"#femur", "#tibia", "#foot", "#toes", "#clavicle", "#humerus", "#radius", "#wrist"}));
}

TEST(JointNames, IgnoresSuffixesOfRigs) {
  const Words middle = {"root", "spine_1", "spine_2", "spine_3", "neck_1", "head"};
  for (const Words& limbs :
       {Words{"#_thigh_JNT", "#_shin_JNT", "#_foot_JNT", "#_toe_JNT", "#_clavicle_JNT", "#_upperarm_JNT",
              "#_forearm_JNT", "#_hand_JNT"},
        Words{"thigh_#_1", "calf_#_1", "foot_#_1", "ball_#_1", "clavicle_#_1", "upperarm_#_1", "lowerarm_#_1",
              "hand_#_1"},
        Words{"#UpLeg.001", "#Leg.001", "#Foot.001", "#Toe.001", "#Shoulder.001", "#Arm.001", "#ForeArm.001",
              "#Hand.001"},
        Words{"thigh#", "shin#", "foot#", "toe#", "collar#", "upperarm#", "forearm#", "hand#"},
        Words{"#ThighBend", "#Shin", "#Foot", "#Toe", "#Collar", "#ShldrBend", "#ForearmBend", "#Hand"},
        Words{"#Thigh", "#Shin", "#Foot", "#Toe", "#Shoulder", "#UArm", "#FArm", "#Hand"},
        Words{"UpLeg_#", "LoLeg_#", "Foot_#", "Toe_#", "Collar_#", "UpArm_#", "LoArm_#", "Hand_#"}})
    expect_found(limbs[0], both("L", "R", middle, limbs));
}

TEST(JointNames, HelpersOfEqualNamesAreSteppedOver) {
  // Above each hip a helper in the middle, whose name says the same.
  SkeletonMotion motion;
  motion.path = "made";
  const auto add = [&](const std::string& name, int parent, const Vector3d& offset) {
    motion.joints.push_back({name, parent, offset, false});
    return motion.joints.count() - 1;
  };
  const int root = add("Hips", -1, Vector3d::Zero()), chest = add("Chest", root, Vector3d::UnitY());
  for (const auto& [side, x] : {std::pair{std::string("Left"), 1.0}, {"Right", -1.0}}) {
    int joint = add("__" + side + "UpLeg", root, Vector3d(0, -0.1, 0));
    joint = add(side + "UpLeg", joint, Vector3d(x, 0, 0));
    joint = add(side + "Leg", joint, Vector3d(0, -4, 0));
    add(side + "Foot", joint, Vector3d(0, -4, 0));
    joint = add(side + "Arm", chest, Vector3d(x, 0, 0));
    joint = add(side + "ForeArm", joint, Vector3d(3 * x, 0, 0));
    add(side + "Hand", joint, Vector3d(3 * x, 0, 0));
  }
  motion.translation.emplace_back();
  motion.rotation.emplace_back(motion.joints.size(), Quaterniond::Identity());
  for (const SkeletonJoint& joint : motion.joints) motion.translation[0].push_back(joint.offset);
  const JointMap map = map_joints(motion);
  EXPECT_EQ(motion.joints[map[kLeftHip]].name, "LeftUpLeg");
  EXPECT_EQ(motion.joints[map[kRightHip]].name, "RightUpLeg");
  EXPECT_EQ(map[kPelvis], root);
}

TEST(JointNames, PrefersTheMoreSpecificName) {
  PerBody<int> joint;
  SkeletonMotion motion = skeleton(
      both("l", "r", {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head"},
           {"thigh_#", "calf_#", "foot_#", "ball_#", "clavicle_#", "upperarm_#", "lowerarm_#", "hand_#"}),
      joint);
  motion.joints.push_back({"ik_foot_l", 0, Vector3d::Zero(), false});
  motion.joints.insert(motion.joints.begin() + 1, {"ik_hand_l", 0, Vector3d::Zero(), false});
  for (std::size_t j = 2; j + 1 < motion.joints.size(); ++j)
    motion.joints[j].parent += motion.joints[j].parent > 0 ? 1 : 0;
  const JointMap map = map_joints(motion);
  EXPECT_EQ(motion.joints[map[kLeftAnkle]].name, "foot_l");
  EXPECT_EQ(motion.joints[map[kLeftWrist]].name, "hand_l");
}

TEST(JointNames, UsesEndSitesForMissingWristsAndFeet) {
  PerBody<int> joint;
  Names names = test::mixamo_names();
  for (const int body : {kLeftWrist, kRightWrist, kLeftFoot, kRightFoot}) names[body].clear();
  SkeletonMotion motion = skeleton(names, joint);
  for (const int body : {kLeftElbow, kRightElbow, kLeftAnkle})
    motion.joints.push_back({"end", joint[body], Vector3d::Zero(), true});
  const JointMap map = map_joints(motion);
  EXPECT_EQ(map[kLeftWrist], motion.joints.count() - 3);
  EXPECT_EQ(map[kLeftFoot], motion.joints.count() - 1);
  EXPECT_EQ(map[kRightFoot], -1);
}

/// The message with which a skeleton is refused.
std::string names_refusal(const SkeletonMotion& motion, const std::filesystem::path& user_map = {}) {
  try {
    map_joints(motion, user_map);
  } catch (const DataError& e) {
    return e.what();
  }
  return "nothing was refused";
}

/// A skeleton whose limbs do not mirror each other, so that its shape tells nothing.
SkeletonMotion lopsided(SkeletonMotion motion) {
  double factor = 1.0;
  for (SkeletonJoint& joint : motion.joints) joint.offset *= (factor *= 1.2);
  for (auto& frame : motion.translation)
    for (int j = 0; j < motion.joints.count(); ++j) frame[j] = motion.joints[j].offset;
  return motion;
}

TEST(JointNames, ErrorNamesTheMissingBodies) {
  PerBody<int> joint;
  Names names = test::mixamo_names();
  names[kLeftKnee] = "Thing";
  const std::string message = names_refusal(lopsided(skeleton(names, joint)));
  EXPECT_NE(message.find("none for left knee"), std::string::npos) << message;
  EXPECT_EQ(message.find("right knee"), std::string::npos) << message;
}

TEST(JointNames, RejectsALimbOnTheWrongParent) {
  PerBody<int> joint;
  Names names = test::mixamo_names();
  std::swap(names[kLeftKnee], names[kLeftElbow]);
  const std::string message = names_refusal(lopsided(skeleton(names, joint)));
  EXPECT_NE(message.find("'mixamorig:LeftLeg', taken for left knee, below left hip"), std::string::npos)
      << message;
}

std::filesystem::path write_map(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("mimicx_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".txt");
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

TEST(JointNames, UserMapNamesJoints) {
  PerBody<int> joint;
  Names names = test::mixamo_names();
  names[kLeftKnee] = "Genou gauche";
  names[kHead] = "T\xc3\xaate";
  const SkeletonMotion motion = skeleton(names, joint);
  const auto path = write_map(
      "# my rig\r\nleft_knee = Knie  # not in this file\n\n  left_knee=Genou gauche\r\nhead = T\xc3\xaate\n");
  const JointMap map = map_joints(motion, path);
  EXPECT_EQ(map[kLeftKnee], joint[kLeftKnee]);
  EXPECT_EQ(map[kHead], joint[kHead]);
}

TEST(JointNames, TellsWhichNamesOfAUserMapTheSkeletonDoesNotHave) {
  PerBody<int> joint;
  std::vector<std::string> told;
  const SkeletonMotion motion = skeleton(test::mixamo_names(), joint);
  const auto path =
      write_map("head = Kopf\nhead = Haupt\nneck = Hals\nneck = " + test::mixamo_names()[kNeck] + "\n");
  map_joints(motion, path, &told);
  EXPECT_EQ(told, std::vector<std::string>{
                      "the skeleton has no joint of --joint-map's names: head 'Kopf', 'Haupt'"});
}

TEST(JointNames, AMapInUtf8NamesJointsInShiftJisAndGbk) {
  PerBody<int> joint;
  Names names = test::mixamo_names();
  names[kLeftKnee] = escaped_name("\x8d\xb6\x82\xd0\x82\xb4");  // 左ひざ in Shift-JIS
  names[kHead] = escaped_name("\xcd\xb7");                      // 头 in GBK
  const SkeletonMotion motion = skeleton(names, joint);
  const JointMap map = map_joints(motion, write_map("\xef\xbb\xbfleft_knee = 左ひざ\nhead = 头\n"));
  EXPECT_EQ(map[kLeftKnee], joint[kLeftKnee]);
  EXPECT_EQ(map[kHead], joint[kHead]);
  EXPECT_EQ(map_joints(motion, write_map("left_knee = 左ひざ\nhead = 首\n"))[kHead], -1);
}

TEST(JointNames, ReportsErrorsOfAJointMapWithTheirLine) {
  PerBody<int> joint;
  const SkeletonMotion motion = skeleton(test::mixamo_names(), joint);
  EXPECT_NE(names_refusal(motion, write_map("\nleft_knie = x\n")).find("line 2: expected one of the 22"),
            std::string::npos);
  EXPECT_NE(names_refusal(motion, write_map("left_knee x\n")).find("line 1: expected body = joint name"),
            std::string::npos);
  EXPECT_NE(names_refusal(motion, "/no/such/map").find("/no/such/map"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::import
