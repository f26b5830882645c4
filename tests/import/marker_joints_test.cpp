#include "import/opensim/marker_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/npz/npy.h"
#include "core/units.h"
#include "import/made_markers.h"
#include "import/motion_file.h"
#include "import/opensim/functional_axis.h"
#include "import/text_input.h"
#include "motion/synthetic_clip.h"

namespace mimicx::import {
namespace {

motion::Clip walking() {
  motion::Clip clip = test::synthetic_clip("walk", 3);
  clip.keypoints.reset();
  return clip;
}

PerFrame<PerBody<Vector3d>> joints_of(const Markers& markers) {
  std::vector<std::string> decisions, warnings;
  return joints_of_markers(markers, Vector3d::UnitY(), decisions, warnings);
}

/// Mean distance of a joint from the clip's, mm.
double distance(const PerFrame<PerBody<Vector3d>>& joints, const motion::Clip& clip, int body) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const Quaterniond up = rotation_to_z_up('y');
  double sum = 0.0;
  for (int t = 0; t < poses.count(); ++t) sum += (up * joints[t][body] - poses[t].p_WB[body]).norm();
  return kMm * sum / static_cast<double>(poses.size());
}

Markers without(const Markers& markers, const std::string& word) {
  Markers rest = markers;
  rest.names.clear();
  rest.tracks.clear();
  for (std::size_t i = 0; i < markers.names.size(); ++i)
    if (markers.names[i].find(word) == std::string::npos) {
      rest.names.push_back(markers.names[i]);
      rest.tracks.push_back(markers.tracks[i]);
    }
  return rest;
}

std::string message(const auto& action) {
  try {
    action();
  } catch (const DataError& error) {
    return error.what();
  }
  return {};
}

/// Two markers in three frames, unseen in every way that files say so.
const std::string kSmall =
    "PathFileType\t4\t(X/Y/Z)\tsmall.trc\r\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\r\n"
    "60.00\t60.00\t      3\t2\tmm\t60.00\r\n"
    "Frame#\tTime\tR.ASIS\t\t\tL.ASIS\t\t\t\r\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\t\r\n"
    "\r\n"
    "1\t0.000\t100\t1000.5\t-20\t\t\t\r\n"
    "2\t0.017\t0\t0.0\t0\t1\t2\t3\r\n"
    "3\t0.033\t104\t1004.5\t-28\tNaN\tnan\t3\r\n";

TEST(Markers, ParsesHeaderUnitsAndUnseenMarkers) {
  const Markers markers = parse_trc(kSmall, "small.trc");
  EXPECT_EQ(markers.fps, 60.0);
  EXPECT_EQ(markers.names, (std::vector<std::string>{"R.ASIS", "L.ASIS"}));
  EXPECT_EQ(markers.tracks[0][0], 0.001 * Vector3d(100, 1000.5, -20));
  EXPECT_FALSE(markers.tracks[0][1].allFinite()) << "a marker at the origin was not seen";
  EXPECT_FALSE(markers.tracks[1][0].allFinite()) << "blank";
  EXPECT_EQ(markers.tracks[1][1], 0.001 * Vector3d(1, 2, 3));
  EXPECT_FALSE(markers.tracks[1][2].allFinite()) << "nan";
  EXPECT_EQ(parse_trc(kSmall, "small.trc", 0.01).tracks[0][0].x(), 1.0) << "as asked for";
  EXPECT_EQ(recognise(kSmall), MotionFormat::kMarkers);
}

TEST(Markers, NameLineExpectedAndFoundOfBadFiles) {
  const auto with = [](const std::string& what, const std::string& instead) {
    std::string text = kSmall;
    text.replace(text.find(what), what.size(), instead);
    return message([&] { parse_trc(text, "small.trc"); });
  };
  EXPECT_EQ(with("mm", "furlong"), "small.trc: line 3: expected Units of mm, cm or m, found 'furlong'");
  EXPECT_EQ(with("60.00", "0"), "small.trc: line 3: expected DataRate over 0 and up to 2000, found '0'");
  EXPECT_EQ(with("\t2\tmm", "\t3\tmm"),
            "small.trc: line 4: expected 'Frame#', 'Time' and names of as many markers as NumMarkers says, "
            "found '2 names'");
  EXPECT_EQ(with("1004.5", "10o4.5"),
            "small.trc: line 9: expected a coordinate, or a blank cell, found '10o4.5'");
  EXPECT_EQ(with("\tNaN\tnan\t3\r\n", ""),
            "small.trc: line 9: expected 8 cells divided by tabs, found '5 cells'");
  EXPECT_EQ(with("      3", "4"),
            "small.trc: line 9: expected as many rows as NumFrames says, found '3 rows'");
  EXPECT_NE(with("PathFileType", "Path").find("line 1: expected 'PathFileType'"), std::string::npos);
  EXPECT_NE(with("Units", "Unit").find("expected a value of Units, found none"), std::string::npos);
}

TEST(Markers, CellsBehindTheLastMarkerAreRefused) {
  std::string text = kSmall;
  text.insert(text.find("\t1\t2\t3\r\n") + 6, "\t \t");
  EXPECT_NO_THROW(parse_trc(text, "small.trc")) << "blank ones";
  text = kSmall;
  text.insert(text.find("\t1\t2\t3\r\n"), "\t7");
  EXPECT_EQ(message([&] { parse_trc(text, "small.trc"); }),
            "small.trc: line 8: expected 8 cells divided by tabs, found '9 cells'");
}

/// A file of one marker. @param rows  Frame# and Time of each row
std::string counted_rows(const std::vector<std::string>& rows) {
  std::string text = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n60\t" +
                     std::to_string(rows.size()) + "\t1\tmm\nFrame#\tTime\tR.ASIS\t\t\n\t\tX1\tY1\tZ1\n";
  for (const std::string& row : rows) text += row + "\t1\t2\t3\n";
  return text;
}

TEST(Markers, RowsThatAreMissingOrOutOfOrderAreRefused) {
  const std::vector<std::string> sound = {"1\t0.000", "2\t0.017", "3\t0.033", "4\t0.050",
                                          "5\t0.067", "6\t0.083", "7\t0.100"};
  const auto said = [](const std::vector<std::string>& rows) {
    return message([&] { parse_trc(counted_rows(rows), "a.trc"); });
  };
  EXPECT_EQ(said(sound), "");
  std::vector<std::string> rows = sound;
  rows.erase(rows.begin() + 3);
  EXPECT_EQ(said(rows), "a.trc: line 9: expected Frame# 4 (one step after 3), found '5'");
  for (std::string& row : rows) row = row.substr(1);
  EXPECT_NE(said(rows).find("a.trc: line 9: expected Time 0.0"), std::string::npos) << said(rows);
  rows = sound;
  std::swap(rows[2], rows[4]);
  EXPECT_EQ(said(rows), "a.trc: line 8: expected Frame# 3 (one step after 2), found '5'");
  EXPECT_NE(said({sound.rbegin(), sound.rend()}), "");
  rows = sound;
  rows[3] = rows[2];
  EXPECT_NE(said(rows).find("line 9"), std::string::npos) << said(rows);
}

TEST(Markers, CountersThatRoundOrSayNothingAreNoErrors) {
  for (const std::vector<std::string>& rows :
       {std::vector<std::string>{"1\t0.00", "2\t0.01", "3\t0.02", "4\t0.02", "5\t0.03", "6\t0.04"},
        {"2\t0", "4\t0.0333", "6\t0.0667", "8\t0.1", "10\t0.1333"},
        {"\t", "\t", "\t", "\t"},
        {"0\t0", "0\t0", "0\t0", "0\t0"},
        {"1\t0:00", "2\t0:01", "3\t0:07"}})
    EXPECT_EQ(message([&] { parse_trc(counted_rows(rows), "a.trc"); }), "") << rows[1];
}

TEST(Markers, ShortGapsAreFilledAndLongOnesSaid) {
  Track track;
  for (int t = 0; t < 60; ++t) track.emplace_back(t, 2.0 * t, -t);
  const Track whole = track;
  for (const int t : {10, 11, 12, 30}) track[t].setConstant(NAN);
  EXPECT_EQ(fill_gaps(60.0, track), 0.0);
  for (int t = 0; t < 60; ++t) EXPECT_NEAR((track[t] - whole[t]).norm(), 0.0, 1e-12) << t;
  for (const int t : {0, 1, 59}) track[t].setConstant(NAN);
  EXPECT_EQ(fill_gaps(60.0, track), 0.0);
  EXPECT_EQ(track[0], whole[2]);
  EXPECT_EQ(track[59], whole[58]);
  for (int t = 20; t < 33; ++t) track[t].setConstant(NAN);
  EXPECT_NEAR(fill_gaps(60.0, track), 13.0 / 60.0, 1e-12);
}

TEST(FunctionalAxis, IsTheAxisOfAHingeBetweenMovingSegments) {
  const Vector3d axis = Vector3d(0.2, 1.0, -0.3).normalized(), point(0.3, -0.1, 0.5);
  const Vector3d spots[] = {{0.1, 0, 0}, {0, 0.2, 0.05}, {0.1, 0.1, 0.3}};
  std::vector<Track> upper(3), lower(3);
  Track on_axis, directions;
  for (int t = 0; t < 50; ++t) {
    const Quaterniond q = exp_map(Vector3d(0.3 * std::sin(0.1 * t), 0.02 * t, 0.1)),
                      bent = rotation_about(axis, 0.5 + 0.5 * std::sin(0.2 * t));
    const Vector3d moved(0.02 * t, 0.0, 0.01 * t);
    for (std::size_t i = 0; i < 3; ++i) {
      upper[i].push_back(moved + q * spots[i]);
      lower[i].push_back(moved + q * (point + bent * (Vector3d(spots[i]) - Vector3d(0, 0, 0.6))));
    }
    on_axis.push_back(moved + q * point);
    directions.push_back(q * axis);
  }
  const auto line = functional_axis(upper, lower);
  ASSERT_TRUE(line);
  for (int t = 0; t < 50; ++t) {
    EXPECT_NEAR(std::abs(line->direction[t].dot(directions[t])), 1.0, 1e-9);
    EXPECT_NEAR((line->point[t] - on_axis[t]).cross(directions[t]).norm(), 0.0, 1e-6);
  }
  EXPECT_FALSE(functional_axis(upper, upper)) << "a joint that does not turn";
  EXPECT_FALSE(functional_axis({upper[0], upper[1], upper[1]}, lower)) << "markers in one line";
}

TEST(MarkerJoints, AreThePersonsWhereBothSidesOfAJointHaveMarkers) {
  const motion::Clip clip = walking();
  const auto joints = joints_of(test::markers_of(clip));
  ASSERT_EQ(joints.count(), clip.frames());
  for (const int body : {kLeftHip, kRightHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftFoot,
                         kRightFoot, kLeftShoulder, kRightShoulder, kLeftElbow, kRightWrist})
    EXPECT_NEAR(distance(joints, clip, body), 0.0, 1e-3) << body;
  EXPECT_LT(distance(joints, clip, kSpine3), 40.0);
  EXPECT_LT(distance(joints, clip, kHead), 60.0);
}

TEST(MarkerJoints, AreNearWithLateralMarkersAloneAndWithSegmentsAlone) {
  const motion::Clip clip = walking();
  const Markers both = test::markers_of(clip), lateral = without(without(both, "Knee.Med"), "Ankle.Med"),
                segments = without(without(both, "Knee"), "Ankle");
  for (const Markers& markers : {lateral, segments}) {
    const auto joints = joints_of(markers);
    for (const int body : {kLeftAnkle, kRightAnkle})
      EXPECT_LT(distance(joints, clip, body), 25.0) << body << " of " << markers.names.size() << " markers";
    for (const int body :
         {kLeftKnee, kRightKnee})  // this body's stand 24 mm outside the line from hip to ankle
      EXPECT_LT(distance(joints, clip, body), 40.0) << body << " of " << markers.names.size() << " markers";
  }
  const auto joints = joints_of(segments);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  for (int t = 0; t < poses.count(); ++t)
    for (const int body : {kLeftKnee, kRightKnee}) {
      const Vector3d away = rotation_to_z_up('y') * joints[t][body] - poses[t].p_WB[body];
      EXPECT_NEAR(away.cross(poses[t].q_WB[body] * hinge_axis(body)).norm(), 0.0, 1e-6) << "from the axis";
    }
}

TEST(MarkerJoints, SayWhichMarkerIsMissing) {
  const Markers both = test::markers_of(walking());
  const auto said = [&](const Markers& markers) { return message([&] { joints_of(markers); }); };
  EXPECT_EQ(
      said(without(both, "L.ASIS")),
      "made.trc: markers: expected a marker on the left anterior superior iliac spine (ASIS), found none "
      "by its name (docs/formats.md, \"Markers\")");
  EXPECT_NE(said(without(without(both, "R.Knee"), "R.Thigh")).find("right knee: a marker, or three of the"),
            std::string::npos);
  Markers unseen = both;
  for (std::size_t i = 0; i < both.names.size(); ++i)
    if (both.names[i] == "R.Wrist")
      for (int t = 5; t < 20; ++t) unseen.tracks[i][t].setConstant(NAN);
  EXPECT_NE(said(unseen).find("on the right wrist, found R.Wrist, unseen for 0.5 s"), std::string::npos)
      << said(unseen);
}

TEST(MarkerJoints, OtherMarkerSetsGiveTheSameJoints) {
  Markers markers = test::markers_of(walking());
  const auto before = joints_of(markers);
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (std::string& name : markers.names)
      if (name == from) name = to;
  };
  for (const std::string side : {"L", "R"}) {
    const std::string small = side == "L" ? "l" : "r";
    rename(side + ".ASIS", "Subject 1:" + side + "ASI");
    rename(side + ".PSIS", side + "PSI");
    rename(side + ".Knee", small + "_knee_study");
    rename(side + ".Knee.Med", small + "_mknee_study");
    rename(side + ".Ankle", side + "ANK");
    rename(side + ".Ankle.Med", "AnkleMed_" + side);
    rename(side + ".Heel", small + "_calc_study");
    rename(side + ".Toe.Lat", small + "_5meta_study");
    rename(side + ".Acromion", side + "SHO");
    rename(side + ".Elbow", (side == "L" ? "Left" : "Right") + std::string(" Elbow"));
  }
  const auto after = joints_of(markers);
  for (int t = 0; t < before.count(); ++t) EXPECT_EQ(before[t], after[t]) << t;
}

TEST(MarkerJoints, TheBeltOfATreadmillIsTakenOut) {
  motion::Clip clip = walking();
  Markers markers = test::markers_of(clip);
  const Vector3d belt = rotation_to_z_up('y').conjugate() * (clip.trans.back() - clip.trans[0]) /
                        ((clip.frames() - 1) / clip.fps);
  for (Track& track : markers.tracks)
    for (int t = 0; t < track.count(); ++t) track[t] -= t / clip.fps * Vector3d(belt.x(), 0.0, belt.z());
  std::vector<std::string> decisions, warnings;
  const auto joints = joints_of_markers(markers, Vector3d::UnitY(), decisions, warnings);
  EXPECT_EQ(decisions.back().substr(0, 10), "treadmill:") << decisions.back();
  const Vector3d travelled = joints.back()[kPelvis] - joints[0][kPelvis];
  const Vector3d there = clip.trans.back() - clip.trans[0];
  EXPECT_NEAR(travelled.norm() / Vector3d(there.x(), there.y(), 0.0).norm(), 1.0, 0.05);
  decisions.clear();
  joints_of_markers(test::markers_of(clip), Vector3d::UnitY(), decisions, warnings);
  EXPECT_NE(decisions.back().substr(0, 10), "treadmill:") << "it walks over ground";
}

TEST(MarkerJoints, AFileIsReadAsAMotionInEitherUnit) {
  const motion::Clip truth = walking();
  const std::string text = test::format_trc(test::markers_of(truth));
  const motion::Clip clip = motion_from(text, "walk.trc");
  EXPECT_EQ(clip.fps, truth.fps);
  EXPECT_EQ(clip.summary.at(0), "markers: 30 frames per second, y up, metres");
  const PerFrame<BodyPoses> ours = motion::poses_of(clip), theirs = motion::poses_of(truth);
  ASSERT_EQ(ours.count(), theirs.count());
  for (int t = 0; t < ours.count(); t += 10)
    for (const int body : {kLeftKnee, kRightAnkle, kLeftWrist})
      EXPECT_LT((ours[t].p_WB[body] - theirs[t].p_WB[body]).norm(), 0.05) << t << ' ' << body;
  EXPECT_EQ(motion_from(test::format_trc(test::markers_of(truth), "m"), "walk.trc").frames(), clip.frames());
  const auto pelvis = [&](std::optional<double> metres) {
    return skeleton_of_markers(text, "walk", "walk.trc", {}, metres).translation[0][0];
  };
  EXPECT_NEAR(pelvis(0.002).x() / pelvis({}).x(), 2.0, 0.05) << "--scale";
}

TEST(MarkerJoints, TimesThatContradictTheRateGiveAWarning) {
  Markers markers = test::markers_of(walking());
  EXPECT_EQ(motion_from(test::format_trc(markers), "walk.trc").warnings, std::vector<std::string>{});
  std::string text = test::format_trc(markers);
  text.replace(text.find("\n30\t") + 1, 2, "60");
  const motion::Clip clip = motion_from(text, "walk.trc");
  EXPECT_EQ(clip.fps, 60.0);
  EXPECT_EQ(clip.warnings.at(0),
            "two frame rates: DataRate says 60, the Time column 30; DataRate counts without --fps 30");
}

TEST(MarkerJoints, UnitsThatNoBodyHasAreRefused) {
  const Markers markers = test::markers_of(walking());
  for (const auto& [written, said] : {std::pair("mm", "m"), {"mm", "cm"}, {"m", "mm"}}) {
    std::string text = test::format_trc(markers, written);
    const std::string unit = std::string("\t") + written + "\n";
    text.replace(text.find(unit), unit.size(), std::string("\t") + said + "\n");
    EXPECT_NE(
        message([&] { motion_from(text, "walk.trc"); }).find("walk.trc: line 3: expected Units that give"),
        std::string::npos)
        << written << " as " << said;
    ReadConfig config;
    config.scale = std::string(written) == "m" ? 1.0 : 0.001;
    EXPECT_EQ(motion_from(text, "walk.trc", config).frames(), walking().frames());
  }
}

TEST(MarkerJoints, AnotherUpAxisIsFoundAndSaid) {
  const motion::Clip truth = walking();
  Markers markers = test::markers_of(truth);
  for (Track& track : markers.tracks)
    for (Vector3d& place : track) place = rotation_to_z_up('y') * place;
  const std::string text = test::format_trc(markers);
  const motion::Clip clip = motion_from(text, "walk.trc");
  EXPECT_EQ(clip.summary.at(0), "markers: 30 frames per second, z up, metres");
  EXPECT_NE(clip.warnings.at(0).find("up axis z, not y as is usual for markers"), std::string::npos);
  EXPECT_LT((motion::poses_of(clip)[0].p_WB[kHead] - motion::poses_of(truth)[0].p_WB[kHead]).norm(), 0.1);
  ReadConfig config;
  config.up = 'y';
  EXPECT_EQ(motion_from(text, "walk.trc", config).summary.at(0),
            "markers: 30 frames per second, y up, metres")
      << "the user's setting counts";
}

/// OpenSim's examples, against joints that others placed (../shared/forces), relative to the left wrist: both
/// have it from its markers alone, and their belts differ by 1 %.
TEST(MarkerJoints, OfSharedFilesAreNearThoseOfOpenSim) {
  const std::filesystem::path shared = std::filesystem::path(MIMICX_SHARED_DIR) / "forces";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "needs ../shared";
  for (const std::string name : {"walk_g10", "walk_raj"}) {
    const auto frames = skeleton_of_markers(read_text(shared / "raw" / (name + ".trc")), name, name + ".trc");
    const std::string bytes = read_text(shared / "in" / (name + ".npy"));
    const NpyArray theirs =
        parse_npy(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), name, "");
    const std::vector<double> values = theirs.to_double();
    for (const int body :
         {kLeftHip, kRightHip, kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot,
          kLeftShoulder, kRightShoulder, kLeftElbow, kRightElbow, kLeftWrist, kRightWrist}) {
      double sum = 0.0;
      int count = 0;
      for (int t = 0; t < frames.frames(); ++t) {
        const double at = 120.0 * t / frames.fps;
        const auto row = static_cast<std::size_t>(std::lround(at));
        if (std::abs(at - std::round(at)) > 1e-6 || row >= theirs.shape[0]) continue;
        const SkeletonPose pose = pose_of(frames, t);
        const double* joints = &values[3 * kBodies * row];
        const Vector3d p = rotation_to_z_up('y') * (pose.p[body] - pose.p[kLeftWrist]);
        sum += kMm * (p - Vector3d(joints + 3 * body) + Vector3d(joints + 3 * kLeftWrist)).norm();
        ++count;
      }
      RecordProperty(name + "_" + std::string(kBodyNames[body]), std::to_string(sum / count));
      EXPECT_LT(sum / count, body < kLeftFoot ? 42.0 : 60.0) << name << ' ' << kBodyNames[body];
    }
  }
}

}  // namespace
}  // namespace mimicx::import
