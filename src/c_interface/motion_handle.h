/// The motion behind `mimicx_motion` of include/mimicx.h: read from memory, cleaned as by `mimicx plan`,
/// written to memory.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/npz/npz.h"
#include "import/motion_file.h"
#include "plan/plan_command.h"
#include "record/sequence_entry.h"

namespace mimicx::c_interface {

/// Told what is being done; true stops the work.
using Watcher = std::function<bool(const std::string& doing)>;

class Motion {
 public:
  Motion();

  /// @throws std::invalid_argument for an unknown name or an impossible value
  void set(const std::string& name, const std::string& value);
  /// Takes the bytes of a file. @throws DataError where they are no motion
  void read(std::string bytes, const std::string& name);
  /// Adds a member to an archive that is read when it is needed.
  void put(const std::string& member, NpyArray array);

  /// @return whether the work went to its end; false: `watch` stopped it
  /// @throws DataError and others where no motion could be made
  bool clean(const Watcher& watch);
  /// Whether the body followed to the end; the reason why it did not.
  bool followed() const { return entry_ && entry_->ok; }
  const std::string& reason() const { return entry_->reason; }

  /// @throws DataError without a motion, or without such a member
  const NpyArray& array(const std::string& member);
  std::string members();
  /// Empty before `clean`.
  std::string record() const;
  std::string audit();
  std::string written(const std::string& suffix);

 private:
  void load();

  plan::PlanMotionsConfig config_;
  std::string name_, bytes_;    ///< the motion as a file
  import::ReadConfig read_;     ///< how it is read
  std::optional<Npz> put_;      ///< being given, member by member
  std::optional<Npz> archive_;  ///< its arrays
  std::optional<record::SequenceEntry> entry_;
  std::string clean_suffix_, clean_bytes_;  ///< the copy in the input's format
};

}  // namespace mimicx::c_interface
