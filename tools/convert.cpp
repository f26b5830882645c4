#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "arguments.h"
#include "commands.h"
#include "motion/import/motion_file.h"
#include "motion/resample.h"
#include "pipeline/output/qpos.h"
#include "pipeline/preparation.h"
#include "pipeline/record/outputs.h"

namespace mimicx::tools {
namespace {

struct Arguments {
  std::filesystem::path in, out;
  motion::import::ReadConfig read;
  std::string rate = "input";
  bool force = false;
};

int convert(const Arguments& a) {
  if (!motion::import::is_written(a.out.extension().string()))
    throw UsageError(a.out.string() + ": motions are written as " + motion::import::written_suffixes() +
                     ", not '" + a.out.extension().string() + "'");
  pipeline::record::Outputs({a.in.string()}, a.force).claim(a.out, motion::import::written_opening(a.out));
  motion::Clip clip = motion::import::read_motion(a.in, a.read);
  if (a.rate == "30") clip = motion::resampled(clip, 30.0);
  pipeline::tell_decisions(a.in.string(), clip, std::cerr);
  if (a.out.has_parent_path()) std::filesystem::create_directories(a.out.parent_path());
  if (a.out.stem().extension() == ".qpos" && motion::import::lower_suffix(a.out) == ".npz")
    pipeline::output::write_qpos(a.out, clip);
  else
    motion::import::write_motion(a.out, clip);
  return kAllGood;
}

}  // namespace

void declare_convert(CLI::App& app, Action& action) {
  const auto a = std::make_shared<Arguments>();
  auto* command = app.add_subcommand("convert", "Write a motion in another format, chosen by the suffix");
  command->add_option("IN", a->in, "motion")->required();
  command
      ->add_option("OUT", a->out,
                   "where to write it: " + motion::import::written_suffixes() + "; .qpos.npz: for MuJoCo")
      ->required();
  add_read_arguments(*command, a->read);
  command->add_option("--rate", a->rate, "frame rate of OUT: input or 30")
      ->check(CLI::IsMember({"input", "30"}))
      ->capture_default_str();
  add_force(*command, a->force);
  command->callback([a, &action] { action = [a] { return convert(*a); }; });
}

}  // namespace mimicx::tools
