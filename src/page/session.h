/// What a browser page is told when a motion is dropped on it: the file is cleaned by a plan in a folder of
/// its own, exactly as `mimicx plan FILE --out FOLDER --gains` does it, shown by the report's player, saved
/// in other formats, and played with (playground.h).
///
/// The page has no logic of its own: what it shows are the words and numbers that come out of here. In a
/// browser the folder is one in memory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "page/playground.h"
#include "record/run_context.h"
#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "report/report_bodies.h"

namespace mimicx::page {

/// An empty report, which the page adds motions to: metrics and skin, no clip.
std::string empty_report();

class Session {
 public:
  /// @param folder  where motions get a folder each, numbered from 0 on
  explicit Session(std::filesystem::path folder);

  /// Reads, fits, prepares and plans a motion, and looks at it as a report does.
  /// @return JSON: `number`; `ok`; `row` and `clip` as in a report, `bodies` by key; of a failure the
  /// row's reason is the program's own message
  /// @throws DataError or std::invalid_argument where not even that can be said
  std::string plan(const std::filesystem::path& motion, const record::RunContext& context);

  /// Takes up what `plan` of an earlier session has left in the folder of the motion with the number that is
  /// next here: a browser's program that is stopped keeps nothing, but the page that it ran in may.
  /// @param motion  as `plan` was told it @return JSON: `number`
  /// @throws DataError where no such run is there
  std::string take_up(const std::filesystem::path& motion);

  /// The cleaned motion as `mimicx plan` leaves it where the suffix is that of the input, else as
  /// `mimicx convert` writes it. @param number  of the motion @param suffix  with its dot
  /// @throws DataError, std::invalid_argument as these do; also where there is no cleaned motion
  std::string saved(int number, const std::string& suffix) const;

  /// Begins to play with a motion that was followed. @throws as `saved`
  Playground play(int number) const;

  /// A shape of bones and skin that clips of this session may name. @return its key
  std::string body_of(const Character& character) { return bodies_.take(character); }
  /// All of them, as JSON by key.
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
