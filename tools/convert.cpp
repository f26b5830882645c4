#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.h"
#include "motion/clip.h"

namespace mimicx {
namespace {

int convert(const std::filesystem::path& in, const std::filesystem::path& out) {
  for (const auto& path : {in, out})
    if (path.extension() != ".npz")
      throw UsageError(path.string() + ": convert reads and writes .npz in the AMASS layout, not '" +
                       path.extension().string() + "'");
  const Clip clip = read_clip(in);
  for (const auto& warning : clip.warnings) std::cerr << in.string() << ": " << warning << '\n';
  if (out.has_parent_path()) std::filesystem::create_directories(out.parent_path());
  write_clip(out, clip);
  return kAllGood;
}

}  // namespace

void add_convert(CLI::App& app, Run& run) {
  auto* command = app.add_subcommand("convert", "Write a motion in this program's own layout");
  const auto in = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  command->add_option("IN", *in, "motion: AMASS-style .npz")->required();
  command->add_option("OUT", *out, "where to write it: .npz")->required();
  command->callback([&run, in, out] { run = [in, out] { return convert(*in, *out); }; });
}

}  // namespace mimicx
