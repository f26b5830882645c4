/// The browser page's work on motions. Each motion is cleaned by a plan in a folder of its own, exactly as by
/// `mimicx plan FILE --out FOLDER --gains`. It can then be shown by the report's player, saved in other
/// formats, and simulated interactively (playground.h).
///
/// The page has no logic of its own: it shows the words and numbers of this class. In a browser the folder is
/// in memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "page/playground.h"
#include "record/progress.h"
#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/report_bodies.h"

namespace mimicx::page {

/// An empty report with metrics and skin but no clip. The page adds motions to it.
std::string empty_report();

class Session {
 public:
  /// @param folder  gets a folder per motion, numbered from 0
  explicit Session(std::filesystem::path folder);

  /// Reads, fits, prepares and plans a motion, and evaluates it as a report does.
  /// @return JSON: `number`; `ok`; `row` and `clip` as in a report, `bodies` by key. For a failure the row's
  /// reason is the program's message
  /// @throws DataError or std::invalid_argument where no row can be made
  std::string plan(const std::filesystem::path& motion, const record::RunContext& context);

  /// Restores a motion that an earlier session has planned, from the folder with the next number. A stopped
  /// worker of the browser loses its files; the page keeps them and puts them back.
  /// @param motion  the file given to `plan` then @return JSON: `number`
  /// @throws DataError where the folder holds no such run
  std::string take_up(const std::filesystem::path& motion);

  /// The bytes of the cleaned motion: as written by `mimicx plan` if the suffix is that of the input, else as
  /// written by `mimicx convert`. @param number  of the motion @param suffix  with its dot
  /// @throws DataError, std::invalid_argument as these do, and where there is no cleaned motion
  std::string saved(int number, const std::string& suffix) const;

  /// A playground for a motion whose plan succeeded. @throws as `saved`
  Playground play(int number) const;

  /// Registers a body's bones and skin for the clips of this session. @return its key
  std::string body_of(const Character& character) { return bodies_.take(character); }
  /// All registered bodies, as JSON by key.
  std::string bodies_json() const;

 private:
  struct Done {
    record::RunFolder folder;
    record::SequenceEntry entry;
    std::filesystem::path input;
  };
  const Done& done(int number) const;
  int keep(const std::filesystem::path& motion);
  std::filesystem::path next_folder() const { return folder_ / std::to_string(done_.size()); }

  std::filesystem::path folder_;
  std::vector<Done> done_;
  report::ReportBodies bodies_;
};

}  // namespace mimicx::page
