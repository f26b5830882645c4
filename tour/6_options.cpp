// Options: motions become points, points clusters, clusters policies, and a selector says which policy acts.
//
// You learn: the 68 features of Eq. 1 and what makes motions near; hierarchical k-means; the dynamic
// programme of Eq. 4 with the corrected recursion; what a switch costs.
// Belongs to: docs/method.md §6, §8 (features and clusters, selector); Eqs. 1, 4, 5.
// Questions: 1. Which two kinds of motion are nearest, and which kind of feature tells them apart?
//            2. At which penalty on a switch does one option do the whole walk?
//            3. Charge no rescues: charge_rescues(rolled, 0). What becomes of R(O) and the switches, and why
//            is the larger R(O) worth less?
#include <algorithm>

#include "motions.h"
#include "pipeline/options/features.h"
#include "pipeline/options/kmeans.h"
#include "pipeline/options/option_rewards.h"
#include "pipeline/options/option_set.h"
#include "pipeline/options/selector.h"
#include "plot.h"

using namespace mimicx;
using namespace mimicx::pipeline::options;

int main(int argc, char** argv) {
  const char* kinds[] = {"walk", "squat", "jump"};
  Points points(6, kFeatures);  // two motions of each kind
  for (int k = 0; k < 6; ++k) {
    const auto features = scaled_features(motion_features(tour::motion_of_kind(kinds[k / 2], 1 + k % 2)));
    for (int f = 0; f < kFeatures; ++f) points(k, f) = features[f];
  }
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      const Eigen::RowVectorXd apart = points.row(2 * a) - points.row(2 * b + (a == b ? 1 : 0));
      const auto share = [&](const FeatureKind& kind) {
        return apart.segment(kind.first, kind.entries).squaredNorm() / apart.squaredNorm();
      };
      const FeatureKind& most = *std::ranges::max_element(kFeatureKinds, {}, share);
      std::printf("distance %-5s to %-5s: %5.2f; %2.0f %% of its square from %s\n", kinds[a], kinds[b],
                  apart.norm(), 100 * share(most), most.name.data());
    }
  const ClusterTree tree = complete_tree(points, 1);
  const double radius = radius_for_clusters(tree, 3);
  std::printf("three clusters at l_max = %.2f:", radius);
  for (const ClusterNode& node : cut_tree(tree, radius))
    if (node.is_leaf()) {
      std::printf(" {");
      for (const int member : node.members) std::printf(" %s", kinds[member / 2]);
      std::printf(" }");
    }
  std::printf("\n");

  // The options that come with the program, side by side on a walk.
  const auto set = read_options(argc > 1 ? argv[1] : MIMICX_SOURCE_DIR "/data/options");
  std::vector<const Option*> options;
  for (const TrainedOption& trained : set->options) options.push_back(&trained.option);
  const rl::tracking::TrackingConfig config;
  const auto clip =
      encoded_for(rl::tracking::make_tracking_clip(tour::motion_of_kind("walk", 4), config), options);
  const SideBySide rolled = roll_out_side_by_side(clip, config, options, {});
  const OptionRewards rewards = charge_rescues(rolled, 30);
  for (const double penalty : {0.0, -0.05, -1.0}) {
    const Arrangement best = select_options(rewards, penalty);
    int switches = 0;
    for (int t = 1; t < best.options.count(); ++t) switches += best.options[t] != best.options[t - 1];
    std::printf("w_p = %5.2f: R(O) = %.1f with %d switches\n", penalty, best.value, switches);
  }

  const Arrangement best = select_options(rewards, 0.0);
  tour::Curve acts = tour::line("acts", 1);
  std::vector<tour::Curve> curves;
  for (int option = 0; option < static_cast<int>(options.size()); ++option) {
    tour::Curve curve = tour::line("option " + std::to_string(option), option % 6);
    for (int t = 0; t < rewards.count(); ++t) tour::add(curve, t, rewards[t][option]);
    curves.push_back(curve);
  }
  for (int t = 0; t < best.options.count(); ++t) tour::add(acts, t, best.options[t]);
  tour::save_picture("6_options", "Rewards of the options on a walk, and the arrangement",
                     {{"rewards r'", "frame", "reward", curves, false, true},
                      {"the arrangement at w_p = 0", "frame", "option", {acts}, false, true}});
}
