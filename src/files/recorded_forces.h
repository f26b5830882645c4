/// The forces that a simulated motion has beside its poses.
///
/// Every recorded number is a mean over the interval that ends at its frame (docs/formats.md), so there is
/// one interval less than there are frames, and the mean belongs to the middle of its interval.
#pragma once

#include <optional>
#include <string>

#include "core/containers.h"
#include "files/archive_members.h"
#include "import/motion_file.h"
#include "motion/clip.h"
#include "physics/model.h"

namespace mimicx::files {

struct RecordedForces {
  PerFrame<PerBody<Vector6d>>
      ground;  ///< [frames] (moment about the joint centre, force), world axes, N·m, N
  PerFrame<PerBody<Vector3d>> torque;  ///< [frames] from the joint on the body, its own frame, N·m; 0 unused
};

/// The forces among the members of the file that the clip was read from; none if it has no forces. Members of
/// these names are another program's where the body is not one that we simulate, or their rows have another
/// shape than ours.
/// @param file  that it was read from, for messages; empty: the clip's name stands for it
/// @throws DataError naming file and member if one of the two is missing, has other frames or is not finite
std::optional<RecordedForces> recorded_forces(const motion::Clip& clip, const std::string& file = {});

/// m/s², of the simulation that a motion comes from, by its member `body_weight`; of other motions kGravity.
double recorded_gravity(const motion::Clip& clip);

/// The settings of that simulation on which an audit depends: gravity, friction and physics rate.
physics::SimulationConfig recorded_simulation(const motion::Clip& clip);

/// The members of which these are read: the weight of a body of this mass, kg, and friction and rate where
/// they are not the usual ones.
Members simulation_members(const physics::SimulationConfig& simulation, double mass);

/// Removes what a simulation recorded beside the poses: joint positions and velocities, forces, weight. They
/// do not belong to a motion of another body, another frame rate or other axes. @return whether there was any
bool remove_recorded(motion::Clip& clip);
/// Why its recorded forces do not belong to a motion that was read so; empty where they do.
std::string other_reading(const motion::Clip& clip, const import::ReadConfig& read);

/// Length of an arrow per force that it shows.
inline constexpr double kMetresPerNewton = 0.001;

/// The middle of interval i (between frames i and i + 1), s.
inline double middle_of_interval(int i, double fps) { return (i + 0.5) / fps; }

}  // namespace mimicx::files
