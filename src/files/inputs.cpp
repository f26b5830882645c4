#include "files/inputs.h"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "import/motion_file.h"
#include "record/outputs.h"
#include "record/run_folder.h"

namespace mimicx::files {
namespace {

constexpr std::size_t kNamesSaid = 8;  ///< of the skipped files of a folder

std::filesystem::path whole_path(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path found = std::filesystem::weakly_canonical(path, error);
  return error ? path : found;
}

/// AMASS has files of the same suffix beside its motions that hold only a body shape.
bool is_shape_file(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  return stem == "shape" || stem.ends_with("_stagei");
}

bool is_input(const std::filesystem::path& path) {
  return import::is_motion_file(path) && path.stem().extension() != ".clean" && !is_shape_file(path);
}

/// The motion files of a folder and its subfolders.
class Folder {
 public:
  Folder(const std::filesystem::path& root, const std::filesystem::path& out)
      : root_(root), out_(out.empty() ? out : whole_path(out)) {
    if (record::holds_run(root)) return;
    look_into(root);
    std::sort(files_.begin(), files_.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    std::erase_if(files_, [&](const MotionInput& file) {
      const auto [same, first] = seen_.emplace(whole_path(file.path), inside(file.path));
      if (!first) skipped_.push_back(inside(file.path) + " is " + same->second);
      return !first;
    });
    std::sort(skipped_.begin(), skipped_.end());
  }
  const std::vector<MotionInput>& files() const { return files_; }

  /// "in: skipped: notes.txt, walk.clean.npz, b.npz is a.npz (no motions, made by an earlier run, or read
  /// under another name)"
  void tell_skipped(std::ostream& messages) const {
    if (skipped_.empty()) return;
    messages << on_one_line(root_.string()) << ": skipped: ";
    for (std::size_t i = 0; i < std::min(kNamesSaid, skipped_.size()); ++i)
      messages << (i > 0 ? ", " : "") << on_one_line(skipped_[i]);
    if (skipped_.size() > kNamesSaid) messages << " and " << skipped_.size() - kNamesSaid << " more";
    messages << " (no motions, made by an earlier run, or read under another name)\n";
  }

 private:
  void look_into(const std::filesystem::path& folder) {
    const auto [same, first] =
        seen_.emplace(whole_path(folder), folder == root_ ? "." : inside(folder) + "/");
    if (!first) {  // links may be circular
      skipped_.push_back(inside(folder) + "/ is " + same->second);
      return;
    }
    std::error_code error, none;
    std::filesystem::directory_iterator at(folder, error);
    if (error) files_.push_back({folder.string(), inside(folder)});  // reading it reports the error
    std::vector<std::pair<bool, std::filesystem::path>> entries;     // links behind what they may lead to
    for (; !error && at != std::filesystem::directory_iterator(); at.increment(error))
      entries.emplace_back(at->is_symlink(none), at->path());
    std::sort(entries.begin(), entries.end());
    for (const auto& [link, path] : entries) {
      if (!std::filesystem::is_directory(path, none))
        is_input(path) ? files_.push_back({path.string(), inside(path, path.stem())})
                       : skipped_.push_back(inside(path));
      else if (path.extension() == ".mimicx" || whole_path(path) == out_ || record::holds_run(path))
        skipped_.push_back(inside(path) + "/");
      else
        look_into(path);
    }
  }
  std::string inside(const std::filesystem::path& path) const { return inside(path, path.filename()); }
  /// Relative to the root, ending with `last`.
  std::string inside(const std::filesystem::path& path, const std::filesystem::path& last) const {
    return (path.parent_path().lexically_relative(root_) / last).lexically_normal().generic_string();
  }

  std::filesystem::path root_, out_;
  std::map<std::filesystem::path, std::string> seen_;  ///< files and folders, with the names they are read by
  std::vector<MotionInput> files_;
  std::vector<std::string> skipped_;
};

/// A path as it would be typed from here: without detours, "./" and slashes at its end, and relative where it
/// is below the current folder. So results do not depend on how it was typed.
std::string tidy(const std::string& typed) {
  std::filesystem::path path = std::filesystem::path(typed).lexically_normal();
  if (whole_path(path) != whole_path(typed)) return typed;  // "link/.." is not where the link is
  if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
  std::error_code error;
  const std::filesystem::path here = std::filesystem::current_path(error);
  if (path.is_absolute() && !error) {
    const std::filesystem::path relative = path.lexically_relative(here);
    if (!relative.empty() && relative != "." && *relative.begin() != "..") path = relative;
  }
  return path.empty() ? typed : path.string();
}

/// Every file once, as it was spelled first. Other spellings are links and are said.
std::vector<MotionInput> each_once(const std::vector<MotionInput>& files, std::ostream* messages) {
  std::vector<MotionInput> once;
  std::map<std::filesystem::path, std::string> seen;
  for (const MotionInput& file : files) {
    const auto [same, first] = seen.emplace(whole_path(file.path), file.path);
    if (first)
      once.push_back(file);
    else if (messages != nullptr && same->second != file.path)
      *messages << on_one_line(file.path + ": skipped: it is " + same->second) << '\n';
  }
  return once;
}

}  // namespace

std::vector<MotionInput> find_motions(const std::vector<std::string>& inputs,
                                      const std::filesystem::path& out, std::ostream* messages) {
  std::vector<MotionInput> files;
  for (const std::string& typed : inputs) {
    const std::string input = tidy(typed);
    const MotionInput itself{input, std::filesystem::path(input).stem().string()};
    std::error_code error;
    const bool is_folder = std::filesystem::is_directory(input, error);
    if (is_folder) std::filesystem::directory_iterator(input, error);
    if (!is_folder || error) {  // an unreadable folder is listed itself: reading it reports the error
      files.push_back(itself);
      continue;
    }
    const Folder folder(input, out);
    if (messages != nullptr) folder.tell_skipped(*messages);
    if (folder.files().empty() && inputs.size() == 1)
      throw DataError(input, "", "motion files in this folder",
                      record::holds_run(input) ? "a run: its motions are in motions/" : "none");
    if (folder.files().empty()) files.push_back(itself);
    files.insert(files.end(), folder.files().begin(), folder.files().end());
  }
  return each_once(files, messages);
}

void require_results_apart(const std::vector<std::string>& inputs, const std::filesystem::path& out,
                           const std::vector<std::filesystem::path>& results) {
  for (const std::string& input : inputs) {
    if (!is_within(input, out)) continue;
    for (const std::filesystem::path& result : results)
      if (is_within(result, input))
        throw record::OutputRefused(
            "--out: expected a folder for the results alone, found that of the inputs, " + input);
  }
}

std::vector<std::string> paths_of(const std::vector<MotionInput>& inputs) {
  std::vector<std::string> paths;
  for (const MotionInput& input : inputs) paths.push_back(input.path);
  return paths;
}

std::vector<std::string> unique_names(const std::vector<MotionInput>& inputs) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const MotionInput& input : inputs) {
    names.push_back(record::unique_name(input.name, taken));
    taken.insert(names.back());
  }
  return names;
}

}  // namespace mimicx::files
