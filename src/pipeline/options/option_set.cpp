#include "pipeline/options/option_set.h"

#include <limits>

#include "core/error.h"
#include "core/number_text.h"
#include "record/run_folder.h"

namespace mimicx::pipeline::options {
namespace {

constexpr const char *kCount = "options.count", *kAbsolute = "options.absolute_actions",
                     *kNoFeedForward = "options.no_feed_forward", *kNoRamp = "options.no_ramp",
                     *kMaxAction = "options.max_action";

std::string prefix_of(int k) { return "option" + std::to_string(k) + "."; }

void require_sizes(const Npz& archive, const std::string& key, const nn::Mlp<float>& network, int inputs,
                   int outputs) {
  if (network.inputs() != inputs || network.outputs() != outputs)
    throw DataError(archive.path, key,
                    std::to_string(inputs) + " inputs and " + std::to_string(outputs) + " outputs",
                    std::to_string(network.inputs()) + " and " + std::to_string(network.outputs()));
}

/// @throws DataError if the sizes of a network are not those of poses, code, state, action and value
void check_shape(const Npz& archive, const std::string& prefix, const Option& option) {
  int state = rl::tracking::kStateSize;
  if (option.encoder) {
    const nn::AutoEncoder& coder = *option.encoder;
    constexpr int kPose = rl::tracking::kPoseFeatures;
    require_sizes(archive, prefix + "encoder.encoder", coder.encoder, kPose, coder.code_size());
    require_sizes(archive, prefix + "encoder.decoder", coder.decoder, coder.code_size(), kPose);
    if (coder.inputs.features() != kPose)
      throw DataError(archive.path, prefix + "encoder.inputs.mean", std::to_string(kPose) + " numbers",
                      std::to_string(coder.inputs.features()));
    state = rl::tracking::kEncodedRest + coder.code_size();
  }
  require_sizes(archive, prefix + "agent.actor", option.agent.actor, state, kDofs);
  require_sizes(archive, prefix + "agent.critic", option.agent.critic, state, 1);
}

/// @throws DataError if the option observes a state of another size than the first one of its set
void check_state_size(const Npz& archive, const std::string& prefix, const Option& first,
                      const Option& option) {
  const int expected = first.agent.actor.inputs(), found = option.agent.actor.inputs();
  if (found != expected)
    throw DataError(archive.path, prefix + "agent.actor.sizes",
                    std::to_string(expected) + " inputs, as those of the first option",
                    std::to_string(found));
}

}  // namespace

int first_option(const OptionSets& sets, int set) {
  int first = 0;
  for (int s = 0; s < set; ++s) first += sets[s]->options.count();
  return first;
}

std::string checksum_of(const OptionSets& sets) {
  std::string checksums;
  for (const auto& set : sets) checksums += (checksums.empty() ? "" : "+") + set->checksum;
  return checksums;
}

void write_options(const std::filesystem::path& path, const OptionSet& set) {
  Npz archive;
  archive.set(kCount, NpyArray::scalar_int(static_cast<std::int64_t>(set.options.size())));
  const auto mark = [&](const char* name, bool holds) {
    if (holds) archive.set(name, NpyArray::scalar_int(1));
  };
  mark(kAbsolute, set.actions.mode == rl::tracking::ActionMode::kAbsolute);
  mark(kNoFeedForward, !set.actions.velocity_feed_forward);
  mark(kNoRamp, !set.actions.ramp);
  if (set.actions.max_action != rl::tracking::ActionSettings{}.max_action)
    archive.set(kMaxAction, NpyArray::scalar(set.actions.max_action));
  for (int k = 0; k < set.options.count(); ++k) {
    const TrainedOption& trained = set.options[k];
    const std::string prefix = prefix_of(k);
    save(archive, prefix, trained.option);
    archive.set(prefix + "description", NpyArray::scalar_text(trained.description));
    archive.set(prefix + "centre", NpyArray::from_double({trained.centre.size()}, trained.centre.data()));
    archive.set(prefix + "motions", NpyArray::scalar_int(trained.motions));
    archive.set(prefix + "samples", NpyArray::scalar_int(trained.samples));
  }
  write_npz(path, archive);
}

std::shared_ptr<const OptionSet> read_options(const std::filesystem::path& path) {
  const std::filesystem::path file = std::filesystem::is_directory(path) ? path / "options.npz" : path;
  auto set = std::make_shared<OptionSet>(options_from(read_npz(file)));
  set->checksum = record::file_checksum(file);
  if (const auto clusters = file.parent_path() / "clusters.json"; std::filesystem::exists(clusters))
    set->clusters = clusters;
  return set;
}

OptionSet options_from(const Npz& archive) {
  const double count = number_at(archive, kCount);
  if (!(count >= 1.0 && count <= 1000.0))
    throw DataError(archive.path, kCount, "1 to 1000 options", std::to_string(count));
  OptionSet set;
  const auto marked = [&](const char* name) { return archive.has(name) && number_at(archive, name) != 0.0; };
  if (marked(kAbsolute)) set.actions.mode = rl::tracking::ActionMode::kAbsolute;
  set.actions.velocity_feed_forward = !marked(kNoFeedForward);
  set.actions.ramp = !marked(kNoRamp);
  if (archive.has(kMaxAction)) set.actions.max_action = number_at(archive, kMaxAction);
  if (!(set.actions.max_action >= 0.0 && set.actions.max_action <= 1e9))
    throw DataError(archive.path, kMaxAction, "radians", text_of(set.actions.max_action));
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const std::string prefix = prefix_of(k);
    const auto whole = [&](const char* key, std::int64_t most) {
      const std::int64_t value = whole_number_at(archive, prefix + key);
      if (value < 0 || value > most)
        throw DataError(archive.path, prefix + key, "a count", std::to_string(value));
      return value;
    };
    TrainedOption trained;
    trained.option = load_option(archive, prefix);
    check_shape(archive, prefix, trained.option);
    trained.description = text_at(archive, prefix + "description");
    const NpyArray& member = archive.at(prefix + "centre");
    if (member.type == NpyArray::Type::kText)
      throw DataError(archive.path, prefix + "centre", "numbers", "text");
    const std::vector<double> centre = member.to_double();
    if (centre.size() != trained.centre.size())
      throw DataError(archive.path, prefix + "centre", std::to_string(trained.centre.size()) + " numbers",
                      std::to_string(centre.size()));
    std::copy(centre.begin(), centre.end(), trained.centre.begin());
    trained.motions = static_cast<int>(whole("motions", std::numeric_limits<int>::max()));
    trained.samples = whole("samples", std::numeric_limits<std::int64_t>::max());
    set.options.push_back(std::move(trained));
    check_state_size(archive, prefix, set.options.front().option, set.options.back().option);
  }
  return set;
}

std::string actions_in_words(const rl::tracking::ActionSettings& actions) {
  return std::string("residual_actions=") +
         (actions.mode == rl::tracking::ActionMode::kResidual ? "1" : "0") +
         ", velocity_feed_forward=" + (actions.velocity_feed_forward ? "1" : "0") +
         ", target_ramp=" + (actions.ramp ? "1" : "0") +
         (actions.max_action == rl::tracking::ActionSettings{}.max_action
              ? ""
              : ", max_action=" + text_of(actions.max_action));
}

}  // namespace mimicx::pipeline::options
