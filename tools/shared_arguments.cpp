#include "shared_arguments.h"

#include "commands.h"
#include "core/parallel.h"
#include "files/scene_file.h"

namespace mimicx::tools {

void add_read_arguments(Command& command, import::ReadConfig& read, bool prepares) {
  command.choice("--up", read.up, {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}, {"-x", 'X'}, {"-y", 'Y'}, {"-z", 'Z'}},
                 "the axis that points up in the files; default: detected");
  command.number("--scale", read.scale, kPositive,
                 "metres per unit of length in the files; default: detected");
  command.number("--fps", read.fps, {0.1, 2000.0}, "frame rate of the motions; default: that of the files");
  command.number("--floor", read.floor, kAnyNumber,
                 "height of the floor in the files, m, z up; default: detected");
  command.text(
      "--scene",
      [&read, prepares](const std::string& file) {
        read.scene_from_motion = file == "auto";
        if (read.scene_from_motion && !prepares)
          throw UsageError(
              "--scene: expected a file, as `mimicx scene` writes it, found auto, which is for commands that "
              "simulate");
        if (!read.scene_from_motion) read.scene = files::read_scene(file);
      },
      prepares ? "FILE|auto" : "FILE",
      std::string("stairs, boxes and chairs of the motions, their floor at z = 0: a JSON file of "
                  "docs/scenes.md; ") +
          (prepares ? "auto: found from each motion; " : "") + "default: the files' own, else a flat floor");
  command.number(
      "--mass", read.mass, {1.0, 500.0},
      "mass of the person, kg; default: the usual one of the stature, where the shape comes from joints");
  command.number("--height", read.height, {0.3, 3.0},
                 "stature of the person, m; default: that of the file's shape");
  command.choice("--body", read.standard_body, {{"file", false}, {"standard", true}},
                 "file: the file's body shape, if it has one; standard: the standard body");
  command.existing("--smplx", read.smplx, "your SMPLX_NEUTRAL.npz: gives SMPL-X betas their joints");
  command.existing("--joint-map", read.joint_map,
                   "more joint names for BVH skeletons: a text file, docs/formats.md");
  command.text(
      "--root", [&read](const std::string& name) { read.root = name; }, "NAME",
      "of a BVH with several skeletons: name or number of the one to read");
  command.number("--person", read.person, kFromOne, "of an npz with several people: which one, from 1");
  command.flag("--verbose", read.verbose, "print all decisions about a file, not three lines of them");
}

void add_threads(Command& command, int& threads) {
  threads = available_threads();
  command.number("--threads", threads, {1.0, 1024.0}, "worker threads; they do not influence the results");
}

void add_force(Command& command, bool& force) {
  command.flag("--force", force, "overwrite files that this program did not write; never inputs");
}

void add_json(Command& command, std::filesystem::path& json) {
  command.path("--json", json, "also write the results as JSON; -: to standard output");
}

void add_seed(Command& command, std::uint64_t& seed) {
  command.number("--seed", seed, kFromZero, "seed of all random numbers");
}

void add_cluster_arguments(Command& command, pipeline::options::ClusterConfig& clusters) {
  const Option radius = command.number("--radius", clusters.radius, kFromZero,
                                       "no two motions of a cluster are farther apart than this");
  command
      .number("--clusters", clusters.clusters, kFromOne,
              "number of clusters to make, whatever their size; instead of --radius")
      .excludes(radius);
}

}  // namespace mimicx::tools
