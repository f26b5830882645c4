#include "pipeline/pretrain.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "core/bits.h"
#include "core/npz/npz.h"
#include "core/setting.h"
#include "files/inputs.h"
#include "pipeline/options_folder.h"
#include "record/folder_lock.h"
#include "record/json.h"
#include "record/run_folder.h"
#include "record/utf8_names.h"
#include "run/preparation.h"

namespace mimicx::pipeline {
namespace {

struct Motions {
  std::vector<motion::Reference> references;
  std::vector<options::NamedFeatures> features;
  record::Json record = record::Json::array();  ///< of every input
  bool all_good = true;
};

Motions read_motions(const std::vector<files::MotionInput>& inputs, const PretrainConfig& config,
                     const record::RunContext& context) {
  Motions motions;
  const std::vector<std::string> files = files::paths_of(inputs);
  std::set<std::string> taken;
  context.progress.start("preparing motions", 0.0, static_cast<double>(files.size()), "motions");
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::string reason;
    try {
      run::PreparedMotion motion = run::prepare_motion(files[i], config.read, config.correction);
      run::tell_decisions(files[i], motion.input, context.messages);
      // Names identify motions in the set; files of the same name in two folders get different names.
      const std::string name = record::unique_name(inputs[i].name, taken);
      motions.features.push_back({name, options::motion_features(motion.reference)});
      taken.insert(name);
      motions.references.push_back(std::move(motion.reference));
    } catch (const std::exception& error) {
      reason = error.what();
      motions.all_good = false;
      context.messages << "  " << reason << '\n';
    }
    motions.record.push_back({{"input", record::to_utf8(files[i])},
                              {"status", reason.empty() ? "ok" : "failed"},
                              {"reason", record::to_utf8(reason)}});
    context.progress.update(static_cast<double>(i + 1), "");
  }
  context.progress.finish("prepared " + std::to_string(motions.references.size()) + " of " +
                          std::to_string(files.size()) + " motions");
  return motions;
}

record::Json settings_json(const PretrainConfig& config) {
  record::Json settings = record::to_json(settings_of(config.training));
  for (const auto& [name, value] : run::settings_of(config.correction)) settings[name] = value != 0.0;
  settings["encoder"] = config.use_encoder;
  settings["encoder_steps"] = config.encoder.steps;
  settings["cluster_radius"] = config.clusters.radius;
  settings["clusters"] = config.clusters.clusters.value_or(0);
  return settings;
}

/// Everything that the results depend on; a folder holds one run with one such record.
record::Json pretraining_record(const PretrainConfig& config, const std::vector<std::string>& files) {
  record::Json inputs = record::Json::array();
  for (const std::string& file : files)
    inputs.push_back({{"input", record::to_utf8(file)}, {"checksum", record::checksum_or_none(file)}});
  return {{"version", MIMICX_VERSION},
          {"target", kArithmetic},
          {"seed", config.training.seed},
          {"samples", config.training.samples},
          {"settings", settings_json(config)},
          {"reading", record::to_utf8(run::reading_of(config.read))},
          {"inputs", inputs}};
}

nn::AutoEncoder make_encoder(const std::vector<std::shared_ptr<const rl::tracking::TrackingClip>>& clips,
                             const nn::AutoEncoderConfig& config, std::uint64_t seed,
                             nn::AutoEncoderStats& stats, const std::function<void(int)>& progress) {
  Eigen::Index rows = 0;
  for (const auto& clip : clips) rows += static_cast<Eigen::Index>(clip->poses.size());
  nn::Matrix<float> samples(rows, rl::tracking::kPoseFeatures);
  Eigen::Index next = 0;
  for (const auto& clip : clips) {
    const nn::Matrix<float> inputs = options::encoder_inputs(*clip);
    samples.middleRows(next, inputs.rows()) = inputs;
    next += inputs.rows();
  }
  return nn::train_autoencoder(samples, config, seed, &stats, progress);
}

/// The samples of every option after each of the run's budgets. [option][budget], ascending
/// @param motions  of every option
std::vector<std::vector<std::int64_t>> budgets_of_options(const record::Json& record,
                                                          const std::vector<int>& motions) {
  auto budgets = record.value("earlier_samples", record::Json::array()).get<std::vector<std::int64_t>>();
  budgets.push_back(record.at("samples").get<std::int64_t>());
  std::vector<std::vector<std::int64_t>> shares(motions.size());
  for (const std::int64_t budget : budgets) {
    const std::vector<std::int64_t> share = share_samples(budget, motions);
    for (std::size_t k = 0; k < shares.size(); ++k) shares[k].push_back(share[k]);
  }
  return shares;
}

/// A trained option and its entry in the manifest.
struct OptionTraining {
  options::TrainedOption trained;
  record::Json record;
  bool interrupted = false;
};

/// Encoder and policy of one cluster.
/// @param budgets  samples of the option, ascending; each is spent before the next
/// @param identity  of the option (options_folder.h)
OptionTraining train_option(const PretrainConfig& config, const record::RunContext& context,
                            const options::MotionCluster& cluster, int index,
                            const std::vector<std::int64_t>& budgets, const std::string& identity,
                            const Motions& motions) {
  const std::string name = "option" + std::to_string(index);
  TrainingConfig training = config.training;
  training.seed += static_cast<std::uint64_t>(index);
  std::vector<std::shared_ptr<const rl::tracking::TrackingClip>> clips;
  for (const std::string& member : cluster.members)
    for (std::size_t i = 0; i < motions.features.size(); ++i)
      if (motions.features[i].name == member)
        clips.push_back(rl::tracking::make_tracking_clip(motions.references[i], training.tracking));

  OptionTraining made;
  options::Option option;
  nn::AutoEncoderStats losses;
  if (config.use_encoder) {
    nn::AutoEncoderConfig encoder = config.encoder;
    encoder.steps =
        encoder_steps(encoder, budgets.front());  // frozen, so that a continued policy keeps its encoder
    context.progress.start(name + ", encoder", 0.0, encoder.steps, "steps");
    option.encoder = make_encoder(clips, encoder, training.seed, losses,
                                  [&](int steps) { context.progress.update(steps, ""); });
  }
  for (auto& clip : clips) clip = options::encoded_for(clip, {&option});
  const rl::Agent start = untrained_agent(training, clips.front()->state_size());

  const record::RunFolder folder{config.out};
  const TrainingFiles files = {folder.checkpoint(name), folder.log(name), folder.falls(name), identity};
  TrainingControl control;
  control.threads = config.threads;
  control.should_stop = context.should_stop;
  const std::string label = name + " (" + std::to_string(clips.size()) + " motions)";
  TrainingResult result;
  for (const std::int64_t budget : budgets) {
    training.samples = budget;
    control.progress = progress_of_training(context.progress, label, budget);
    result = train(clips, {start}, training, files, control);
    if (result.interrupted) break;
  }
  option.agent = result.agents.front();
  made.interrupted = result.interrupted;
  made.trained = {option, cluster.description, cluster.centre, static_cast<int>(clips.size()),
                  result.samples};
  record::Json members = record::Json::array();
  for (const std::string& member : cluster.members) members.push_back(record::to_utf8(member));
  made.record = {{"name", name},
                 {"description", cluster.description},
                 {"members", members},
                 {"samples", result.samples},
                 {"seed", training.seed},
                 {"encoder_loss_first", losses.first_loss},
                 {"encoder_loss_last", losses.last_loss}};
  return made;
}

}  // namespace

NamedValues manifest_settings(const PretrainConfig& config) {
  NamedValues values;
  const record::Json settings = settings_json(config);  // items() refers to it
  for (const auto& [name, value] : settings.items())
    values.emplace_back(name, value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>());
  return values;
}

int encoder_steps(const nn::AutoEncoderConfig& config, std::int64_t samples) {
  return static_cast<int>(std::clamp<std::int64_t>(samples / 10, 100, std::max(config.steps, 100)));
}

std::vector<std::int64_t> share_samples(std::int64_t samples, const std::vector<int>& motions) {
  double total = 0.0;
  for (const int n : motions) total += std::sqrt(n);
  std::vector<std::int64_t> shares;
  for (const int n : motions)
    shares.push_back(std::llround(static_cast<double>(samples) * std::sqrt(n) / total));
  return shares;
}

record::RunOutcome pretrain(const PretrainConfig& config, const record::RunContext& context) {
  const std::vector<files::MotionInput> inputs =
      files::find_motions(config.inputs, config.out, &context.messages);
  const std::vector<std::string> files = files::paths_of(inputs);
  const record::RunFolder folder{config.out};
  claim_options(folder, files, config.force);
  const record::FolderLock lock(folder.root);
  record::Json record = pretraining_record(config, files);
  if (let_budget_grow(folder, record)) {
    context.messages << folder.root.string() << ": goes on from a training of "
                     << record.at("earlier_samples").elements().back().get<std::int64_t>()
                     << " samples; one begun with more would explore longer, and be another\n";
  } else if (const auto outcome = finished_outcome(folder, record)) {
    context.messages << folder.root.string() << ": these options are trained already\n";
    return *outcome;
  }
  begin_options(folder, record);

  const Motions motions = read_motions(inputs, config, context);
  if (motions.references.empty()) throw std::invalid_argument("no motion could be read");
  const options::Clusters clusters = options::cluster_motions(motions.features, config.clusters);
  options::write_clusters(config.out / "clusters.json", clusters);
  context.messages << options::format_kind_shares(clusters) << options::format_cluster_tree(clusters);

  std::vector<int> sizes;
  for (const options::MotionCluster& cluster : clusters.clusters)
    sizes.push_back(static_cast<int>(cluster.members.size()));
  const std::vector<std::vector<std::int64_t>> budgets = budgets_of_options(record, sizes);
  options::OptionSet set;
  set.actions = config.training.tracking.actions;
  record::Json trained = record::Json::array();
  for (int index = 0; index < clusters.clusters.count(); ++index) {
    const options::MotionCluster& cluster = clusters.clusters[index];
    const std::vector<std::int64_t>& shares = budgets[static_cast<std::size_t>(index)];
    // The first budget decides how long the encoder is trained.
    const std::string identity =
        identity_of_option(record, cluster.members) + ' ' + std::to_string(shares.front());
    OptionTraining made = train_option(config, context, cluster, index, shares, identity, motions);
    if (made.interrupted) {
      context.progress.finish("interrupted; the same command continues");
      return record::RunOutcome::kInterrupted;
    }
    context.progress.finish(made.record["name"].get<std::string>() + ": done, " + made.trained.description);
    set.options.push_back(std::move(made.trained));
    trained.push_back(made.record);
  }
  finish_options(folder, set, record, motions.record, trained);
  return motions.all_good ? record::RunOutcome::kAllGood : record::RunOutcome::kSomeFailed;
}

}  // namespace mimicx::pipeline
