// Clusters of motions: the file, the words, and which motion goes where.
#include "pipeline/options/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/file.h"
#include "core/random.h"
#include "core/temporary_folder.h"
#include "motion/prepare/prepare.h"
#include "pipeline/options/cluster_words.h"
#include "record/json.h"
#include "synth/data_set.h"

namespace mimicx::pipeline::options {
namespace {

/// Upright, every joint at `speed` (m/s) in the plane.
MotionFeatures travelling(double speed) {
  MotionFeatures f{};
  f[kRootHeight] = 0.93;
  for (std::size_t j = 0; j < kBodies; ++j) f[kPlanarVelocity + j] = speed * speed;
  return f;
}

MotionFeatures noisy(MotionFeatures f, Random& random) {
  for (std::size_t k = 0; k < kFeatures; ++k) f[k] += 0.1 * random.uniform() * feature_units()[k];
  return f;
}

/// Ten each that stand and walk, three that lie.
std::vector<NamedFeatures> some_motions() {
  Random random(1, {0});
  std::vector<NamedFeatures> motions;
  for (int i = 0; i < 10; ++i) {
    motions.push_back({"stand" + std::to_string(i), noisy(travelling(0.0), random)});
    motions.push_back({"walk" + std::to_string(i), noisy(travelling(1.3), random)});
  }
  for (int i = 0; i < 3; ++i) {
    MotionFeatures lying = noisy(travelling(0.0), random);
    lying[kRootHeight] = 0.2;
    motions.push_back({"lie" + std::to_string(i), lying});
  }
  return motions;
}

double scaled_distance(const MotionFeatures& a, const MotionFeatures& b) {
  double squared = 0.0;
  for (std::size_t k = 0; k < kFeatures; ++k) squared += std::pow((a[k] - b[k]) / feature_units()[k], 2);
  return std::sqrt(squared);
}

ClusterConfig three() {
  ClusterConfig settings;
  settings.clusters = 3;
  return settings;
}

TEST(Clusters, SeparateKindsOfMotion) {
  const Clusters clusters = cluster_motions(some_motions(), three());
  ASSERT_EQ(clusters.clusters.size(), 3u);
  for (const auto& c : clusters.clusters) {
    const std::string kind = c.members[0].substr(0, 3);
    EXPECT_EQ(c.members.size(), kind == "lie" ? 3u : 10u);
    for (const auto& m : c.members) EXPECT_EQ(m.substr(0, 3), kind);
  }
}

/// Motions of the training split of two seeds each, true.
List<NamedFeatures> synthetic_motions(const std::vector<std::string>& kinds) {
  List<NamedFeatures> motions;
  for (const std::string& kind : kinds)
    for (const std::uint64_t seed : {synth::kTrainingSeed, synth::kTrainingSeed + 1}) {
      const motion::Clip clip = synth::synthesize({.kind = kind, .seed = seed, .betas_from_seed = true});
      motions.push_back({clip.name, motion_features(motion::prepare_reference(clip, {}, nullptr))});
    }
  return motions;
}

TEST(Clusters, TurningOnTheSpotIsNotStandingOrWaving) {
  ClusterConfig two;
  two.clusters = 2;
  for (const MotionCluster& cluster :
       cluster_motions(synthetic_motions({"turn_in_place", "stand", "wave", "bow", "side_step"}), two)
           .clusters) {
    const bool turns = cluster.members[0].starts_with("turn");
    EXPECT_EQ(cluster.members.size(), turns ? 2u : 8u);
    for (const std::string& member : cluster.members) EXPECT_EQ(member.starts_with("turn"), turns) << member;
  }
}

TEST(Clusters, MembersAreWithinTheRadius) {
  const auto motions = some_motions();
  const auto features = [&](const std::string& name) {
    return std::find_if(motions.begin(), motions.end(), [&](const auto& m) { return m.name == name; })
        ->features;
  };
  for (double radius : {0.2, 0.5, 2.0}) {
    ClusterConfig settings;
    settings.radius = radius;
    std::size_t members = 0;
    for (const auto& c : cluster_motions(motions, settings).clusters) {
      members += c.members.size();
      for (const auto& a : c.members)
        for (const auto& b : c.members) EXPECT_LE(scaled_distance(features(a), features(b)), radius + 1e-12);
    }
    EXPECT_EQ(members, motions.size());
  }
}

TEST(Clusters, DoNotDependOnTheInputOrder) {
  auto motions = some_motions();
  const std::string expected = format_clusters(cluster_motions(motions, three()));
  std::reverse(motions.begin(), motions.end());
  EXPECT_EQ(format_clusters(cluster_motions(motions, three())), expected);
  std::rotate(motions.begin(), motions.begin() + 5, motions.end());
  EXPECT_EQ(format_clusters(cluster_motions(motions, three())), expected);
}

TEST(Clusters, NewMotionGoesToTheNearestCentre) {
  const auto motions = some_motions();
  const Clusters clusters = cluster_motions(motions, three());
  for (const auto& m : motions) {
    const auto& members = clusters.clusters[nearest_cluster(clusters, m.features)].members;
    EXPECT_NE(std::find(members.begin(), members.end(), m.name), members.end()) << m.name;
  }
}

TEST(Clusters, FileReadsBackAsTheSameBytes) {
  TemporaryFolder folder;
  const Clusters clusters = cluster_motions(some_motions(), three());
  write_clusters(folder.path / "c.json", clusters);
  const Clusters back = read_clusters(folder.path / "c.json");
  EXPECT_EQ(format_clusters(back), format_clusters(clusters));
  EXPECT_EQ(back.clusters[1].centre, clusters.clusters[1].centre);
  EXPECT_EQ(back.settings.clusters, 3);
}

TEST(Clusters, JoinedPartsAreNumberedConsecutively) {
  const Clusters part = cluster_motions(some_motions(), three());
  const Clusters both = joined({part, part});
  ASSERT_EQ(both.clusters.size(), 6u);
  for (int c = 0; c < 6; ++c) {
    EXPECT_EQ(both.clusters[c].members, part.clusters[c % 3].members);
    EXPECT_EQ(both.clusters[c].centre, part.clusters[c % 3].centre);
  }
  EXPECT_EQ(both.settings.clusters, 6);
  EXPECT_EQ(both.settings.radius, part.settings.radius);
  List<MotionFeatures> centres;
  for (const MotionCluster& cluster : both.clusters) centres.push_back(cluster.centre);
  for (int c = 0; c < 6; ++c)
    EXPECT_EQ(both.clusters[c].description, describe_cluster(centres, c)) << "among all of them";
  const auto branches = static_cast<int>(part.tree.size());
  ASSERT_EQ(both.tree.size(), 2 * part.tree.size());
  for (int b = 0; b < 2 * branches; ++b) {
    const int of = b / branches;
    const ClusterBranch &one = part.tree.at(static_cast<std::size_t>(b % branches)),
                        &joint = both.tree.at(static_cast<std::size_t>(b));
    EXPECT_EQ(joint.parent, one.parent < 0 ? -1 : one.parent + of * branches);
    EXPECT_EQ(joint.cluster, one.cluster < 0 ? -1 : one.cluster + of * 3);
    EXPECT_EQ(joint.motions, one.motions);
    EXPECT_EQ(joint.diameter, one.diameter);
  }
  EXPECT_EQ(format_clusters(joined({part})), format_clusters(part));
  EXPECT_THROW(joined({}), std::invalid_argument);
}

TEST(Clusters, KeepTheFeaturesOfTheirMembers) {
  TemporaryFolder folder;
  const std::vector<NamedFeatures> motions = some_motions();
  write_clusters(folder.path / "c.json", cluster_motions(motions, three()));
  std::size_t found = 0;
  for (const MotionCluster& cluster : read_clusters(folder.path / "c.json").clusters) {
    ASSERT_EQ(cluster.features.size(), cluster.members.size());
    for (std::size_t i = 0; i < cluster.members.size(); ++i)
      for (const NamedFeatures& motion : motions)
        if (motion.name == cluster.members[i]) {
          EXPECT_EQ(motion.features, cluster.features[static_cast<int>(i)]) << motion.name;
          ++found;
        }
  }
  EXPECT_EQ(found, motions.size());
}

TEST(Clusters, OlderFilesReadWithoutMemberFeatures) {
  TemporaryFolder folder;
  Clusters clusters = cluster_motions(some_motions(), three());
  for (MotionCluster& cluster : clusters.clusters) cluster.features.clear();
  write_clusters(folder.path / "c.json", clusters);
  EXPECT_EQ(read_file(folder.path / "c.json").find("features"), std::string::npos);
  for (const MotionCluster& cluster : read_clusters(folder.path / "c.json").clusters)
    EXPECT_TRUE(cluster.features.empty());
  clusters.clusters[0].features.resize(1);  // of one member alone
  clusters.clusters[0].features[0].fill(0.0);
  write_clusters(folder.path / "c.json", clusters);
  EXPECT_THROW(read_clusters(folder.path / "c.json"), DataError);
}

/// The file with another text in place of the first unit and its name.
std::string with_first_unit(const std::string& file, const std::string& text) {
  const auto unit = file.find("\"root_height\": ");
  return file.substr(0, unit) + text + file.substr(file.find(',', unit));
}

// Files of earlier programs: their distances stay in their units, and motions are compared in today's.
TEST(Clusters, FilesOfOtherUnitsKeepThem) {
  TemporaryFolder folder;
  const Clusters today = cluster_motions(some_motions(), three());
  const std::string text = with_first_unit(format_clusters(today), "\"root_height\": 7.5");
  std::ofstream(folder.path / "c.json") << text;
  const Clusters back = read_clusters(folder.path / "c.json");
  EXPECT_EQ(back.units[kRootHeight], 7.5);
  EXPECT_EQ(record::Json::parse(format_clusters(back)), record::Json::parse(text));
  for (const auto& m : some_motions())
    EXPECT_EQ(nearest_cluster(back, m.features), nearest_cluster(today, m.features)) << m.name;
}

TEST(Clusters, RejectFilesOfOtherFeatures) {
  TemporaryFolder folder;
  const auto path = folder.path / "c.json";
  const auto write = [&](const std::string& text) { std::ofstream(path) << text; };
  write(with_first_unit(format_clusters(cluster_motions(some_motions(), three())), "\"shoe_size\": 7"));
  EXPECT_THROW(read_clusters(path), DataError);
  for (const char* bad : {"", "{}", "nonsense", "[1, 2]"}) {
    write(bad);
    EXPECT_THROW(read_clusters(path), DataError) << bad;
  }
  EXPECT_THROW(read_clusters(folder.path / "none.json"), DataError);
}

TEST(Clusters, RejectImpossibleSettings) {
  const auto motions = some_motions();
  ClusterConfig settings;
  settings.clusters = 24;
  EXPECT_THROW(cluster_motions(motions, settings), std::invalid_argument);
  EXPECT_THROW(cluster_motions({}, {}), std::invalid_argument);
  EXPECT_THROW(cluster_motions({motions[0], motions[0]}, {}), std::invalid_argument);
  auto broken = motions;
  broken[3].features[5] = std::nan("");
  EXPECT_THROW(cluster_motions(broken, {}), std::invalid_argument);
}

TEST(ClusterWords, DescribeAMotion) {
  EXPECT_EQ(describe_motion(travelling(0.0)),
            "calm, upright (hips at 0.93 m), stays in place, feet stay down, arms quiet");
  MotionFeatures f = travelling(1.1);
  f[kRootHeight] = 0.6;
  f[kRootTurning] = 4.0;  // 2 rad/s
  f[kPlanarVelocity + kLeftWrist] = f[kPlanarVelocity + kRightWrist] = 5.0;
  f[kVerticalVelocity + kLeftFoot] = 0.5;
  for (std::size_t j = 0; j < kBodies; ++j) f[kAcceleration + j] = 64.0;
  EXPECT_EQ(describe_motion(f),
            "vigorous, low (hips at 0.60 m), moves about at 1.1 m/s, turns (115 degrees/s), feet swing high, "
            "arms busy");
}

TEST(ClusterWords, NameOnlyTheClusterThatDiffers) {
  const std::vector<MotionFeatures> centres = {travelling(0.0), travelling(1.2), travelling(2.5)};
  EXPECT_EQ(describe_cluster(centres, 1).find("fastest"), std::string::npos);
  EXPECT_NE(describe_cluster(centres, 2).find("of all the fastest"), std::string::npos);
}

TEST(ClusterWords, TreeShowsEveryClusterAndMember) {
  const auto motions = some_motions();
  const std::string tree = format_cluster_tree(cluster_motions(motions, three()));
  EXPECT_EQ(tree.substr(0, 10), "23 motions");
  for (const char* words : {"\n  cluster ", "cluster 0: ", "cluster 1: ", "cluster 2: "})
    EXPECT_NE(tree.find(words), std::string::npos) << tree;
  for (const auto& m : motions) EXPECT_NE(tree.find("- " + m.name + "\n"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::pipeline::options
