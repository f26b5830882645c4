#include <iostream>
#include <memory>

#include "commands.h"
#include "core/file.h"
#include "motion/import/motion_file.h"
#include "motion/resample.h"
#include "pipeline/output/qpos.h"
#include "pipeline/preparation.h"
#include "pipeline/record/outputs.h"
#include "shared_arguments.h"

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
  make_folder(a.out.parent_path());
  if (a.out.stem().extension() == ".qpos" && motion::import::lower_suffix(a.out) == ".npz")
    pipeline::output::write_qpos(a.out, clip);
  else
    motion::import::write_motion(a.out, clip);
  return kAllGood;
}

}  // namespace

void declare_convert(CommandLine& line) {
  const auto a = std::make_shared<Arguments>();
  Command command =
      line.add("convert", "Write a motion in another format, chosen by the suffix",
               "mimicx convert clip.bvh clip.npz                   # AMASS layout\n"
               "mimicx convert clip.npz clip.qpos.npz --rate 30    # MuJoCo, 30 frames per second");
  command.file("IN", a->in, "motion");
  command.file("OUT", a->out,
               "where to write it: " + motion::import::written_suffixes() + "; .qpos.npz: for MuJoCo");
  add_read_arguments(command, a->read);
  command.one_of("--rate", a->rate, {"input", "30"}, "frame rate of OUT");
  add_force(command, a->force);
  command.action([a] { return convert(*a); });
}

}  // namespace mimicx::tools
