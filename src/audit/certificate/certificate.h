/// NAME.cert: a motion with what another program needs to check it.              docs/certificate.md
///
/// It holds the body, the constants, the scene and every physics step: the state (the simulator's own bits),
/// the velocities after the step, PD targets, torques and the force on every contact point. The velocities
/// after a step, torques and forces are those of the step taken in double precision from the recorded state,
/// so that Newton and Euler hold to rounding; the recorded next state differs from it by float32 rounding.
#pragma once

#include <filesystem>
#include <string>

#include "audit/substeps.h"

namespace mimicx::audit {

/// What a certificate binds its steps to.
struct CertifiedMotion {
  std::string motion_bytes;  ///< of motions/NAME.npz
  int steps_per_frame = 8;
};

/// The bytes of the certificate.
/// @throws std::invalid_argument for settings of the simulator other than the page's
std::string certificate_of(const SubstepMotion& motion, const CertifiedMotion& about);

/// RUN/substeps/NAME.npz of RUN/motions/NAME.npz, where NAME may have folders ("walks/walk_1"); empty where
/// there is none.
std::filesystem::path steps_of_motion(const std::filesystem::path& motion);

/// Reads motions/NAME.npz and substeps/NAME.npz of a run and makes their certificate.
/// @throws DataError if a file is missing, the frames are not the states, or the scenes differ
std::string certify_file(const std::filesystem::path& motion);

/// Whether the certificate's controls give its states again, from the first state alone, and its steps their
/// velocities, torques and forces: the same bits.
struct CertificateReplay {
  long steps = 0;
  long first_state = -1;  ///< the first step whose next state has other bits; −1: none
  long first_step = -1;   ///< the first step with other velocities, torques or forces
};
/// @throws DataError if the file is no certificate of version 6
CertificateReplay replay_certificate(const std::filesystem::path& path);

}  // namespace mimicx::audit
