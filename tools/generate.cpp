// Trains a generator of motions on labelled motions, and scores what it makes. Part of tools/paper, Table 3.
//   generate OUT MODEL TRAIN TRUTH TEST [SEED [STEPS [CLIPS]]]
//     OUT     folder for motions/LABEL_NUMBER.npz and scores.json
//     MODEL   diffusion, codes, or none: the motions of TRAIN are scored themselves
//     TRAIN   folder of motions named LABEL_NUMBER.npz that the generator learns
//     TRUTH   exact motions that train the recogniser; its seed is 1 always
//     TEST    exact motions to compare with, of the same labels
//     SEED    of the generator; default 1
//     STEPS   minibatches of every training, of the recogniser's at most 1500; default 8000
//     CLIPS   motions made of every label; default 20
// Everything is scored on the standard body.
// Exit status: 0 done, 1 a file could not be read or written, 2 usage.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "generate/code_generator.h"
#include "generate/diffusion_generator.h"
#include "generate/recogniser.h"
#include "motion/clip_file.h"
#include "motion/metrics.h"
#include "record/json.h"

namespace mimicx::tools {
namespace {

using generate::LabelledMotion;

std::string label_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.rfind('_'));
}

std::vector<std::filesystem::path> motions_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".npz") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<LabelledMotion> read_all(const std::filesystem::path& folder,
                                     const std::vector<std::string>& labels) {
  std::vector<LabelledMotion> motions;
  for (const auto& file : motions_in(folder)) {
    const auto label = std::lower_bound(labels.begin(), labels.end(), label_of(file));
    if (label == labels.end() || *label != label_of(file))
      raise(DataError(file.string(), "name", "a label of the folder TRUTH", label_of(file)));
    motions.push_back(
        {static_cast<int>(label - labels.begin()), generate::pose_numbers(motion::read_clip(file))});
  }
  if (motions.empty()) raise(DataError(folder.string(), "folder", "motions", "none"));
  return motions;
}

template <class Generator>
std::vector<LabelledMotion> made_by(const Generator& generator, int labels, int clips) {
  std::vector<LabelledMotion> made;
  for (int label = 0; label < labels; ++label)
    for (auto& numbers : generator.generate(label, clips)) made.push_back({label, std::move(numbers)});
  return made;
}

struct Run {
  std::filesystem::path out, train, truth, test;
  std::string model;
  std::uint64_t seed = 1;
  int steps = 8000, clips = 20;
};

/// Means over the motions of the metrics that need no truth; writes the motions.
record::Json physical_scores(const Run& run, const std::vector<LabelledMotion>& motions,
                             const std::vector<std::string>& labels) {
  std::vector<double> sums(motion::metric_definitions().size(), 0.0);
  std::filesystem::create_directories(run.out / "motions");
  std::vector<int> made(labels.size(), 0);
  for (const LabelledMotion& motion : motions) {
    const auto label = static_cast<std::size_t>(motion.label);
    const std::string name = labels[label] + "_" + std::to_string(++made[label]);
    const motion::Clip clip = generate::clip_of_numbers(name, motion.numbers);
    if (run.model != "none") motion::write_clip(run.out / "motions" / (name + ".npz"), clip);
    const motion::Metrics metrics = motion::evaluate_motion(
        motion::sample_motion(make_character(), motion::poses_of(clip), clip.fps), nullptr);
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += (metrics.*motion::metric_definitions()[k].value).value / static_cast<double>(motions.size());
  }
  record::Json scores = record::Json::object();
  for (std::size_t k = 0; k < sums.size(); ++k)
    for (const std::string name : {"FS", "GP", "Float", "Jitter"})
      if (name == motion::metric_definitions()[k].name) scores[name] = record::number(sums[k]);
  return scores;
}

void train_and_score(const Run& run) {
  std::set<std::string> names;
  for (const auto& file : motions_in(run.truth)) names.insert(label_of(file));
  const std::vector<std::string> labels(names.begin(), names.end());
  const auto count = static_cast<int>(labels.size());
  const std::vector<LabelledMotion> truth = read_all(run.truth, labels), test = read_all(run.test, labels);
  std::vector<LabelledMotion> motions = read_all(run.train, labels);
  record::Json result = {{"model", run.model},
                         {"seed", run.seed},
                         {"steps", run.steps},
                         {"trained_on", static_cast<int>(motions.size())}};
  if (run.model == "diffusion") {
    generate::DiffusionConfig config;
    config.steps = run.steps;
    const generate::DiffusionGenerator generator(motions, count, config, run.seed);
    result["loss"] = record::number(generator.last_loss());
    motions = made_by(generator, count, run.clips);
  } else if (run.model == "codes") {
    generate::CodeConfig config;
    config.coder_steps = config.predictor_steps = run.steps;
    const generate::CodeGenerator generator(motions, count, config, run.seed);
    result["loss"] = record::number(generator.coder_loss());
    result["predictor_loss"] = record::number(generator.predictor_loss());
    motions = made_by(generator, count, run.clips);
  }
  result["motions"] = static_cast<int>(motions.size());
  generate::RecogniserConfig recognition;
  recognition.steps = std::min(recognition.steps, run.steps);
  const auto scores = generate::Recogniser(truth, count, recognition, 1).scores(motions, test);
  for (int k = 0; k < 3; ++k) result["top" + std::to_string(k + 1)] = record::number(scores.precision[k]);
  result["FID"] = record::number(scores.fid);
  result["distance"] = record::number(scores.multimodal_distance);
  result["diversity"] = record::number(scores.diversity);
  const record::Json physical = physical_scores(run, motions, labels);
  for (const auto& [name, value] : physical.items()) result[name] = value;
  write_file_atomically(run.out / "scores.json", result.dump(1) + "\n");
}

}  // namespace
}  // namespace mimicx::tools

int main(int argc, char** argv) {
  mimicx::tools::Run run;
  if (argc > 2) run.model = argv[2];
  if (argc > 6) run.seed = std::strtoull(argv[6], nullptr, 10);
  if (argc > 7) run.steps = std::atoi(argv[7]);
  if (argc > 8) run.clips = std::atoi(argv[8]);
  const bool known = run.model == "diffusion" || run.model == "codes" || run.model == "none";
  if (argc < 6 || argc > 9 || !known || run.steps < 1 || run.clips < 2) {
    std::fprintf(stderr,
                 "usage: generate OUT diffusion|codes|none TRAIN TRUTH TEST [SEED [STEPS [CLIPS]]]\n");
    return 2;
  }
  run.out = argv[1];
  run.train = argv[3];
  run.truth = argv[4];
  run.test = argv[5];
  try {
    mimicx::tools::train_and_score(run);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate: %s\n", error.what());
    return 1;
  }
}
