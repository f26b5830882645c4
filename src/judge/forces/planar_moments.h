/// Moments in ankles, knees and hips about the leftward axis of the hips, N·m/kg: computed from measured
/// forces (`planar_moments`), and recorded by a simulation (`recorded_moments`).
///
/// From below: the floor's force at its centre of pressure and the segments' weights and accelerations, as
/// point masses (D. A. Winter, "Biomechanics and Motor Control of Human Movement" (2009), ch. 5; shares and
/// centres of mass of foot, shank and thigh of P. de Leva, J. Biomech. 29 (1996)). Accelerations are those of
/// least-squares cubics over seven frames (A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964)).
///
/// Moments are those of the upper segment on the lower one. Positive plantar-flexes the ankle, flexes the
/// knee and extends the hip.
#pragma once

#include "audit/audit.h"
#include "core/containers.h"

namespace mimicx::judge {

/// [left, right][ankle, knee, hip]
using LegMoments = Array<Array<double, 3>, 2>;

struct PressedLegs {
  const PerFrame<PerBody<Vector3d>>& joints;     ///< m
  const PerFrame<Array<Vector3d, 2>>& force;     ///< of the floor on each foot, N
  const PerFrame<Array<Vector3d, 2>>& pressure;  ///< m; not finite: none, z alone: on the floor at 0
  const PerFrame<Matrix3d>& axes;                ///< columns forward, left, up
  double mass = 0.0;                             ///< kg
  double fps = 30.0;
};

PerFrame<LegMoments> planar_moments(const PressedLegs& legs);

/// The recorded torques of a simulated motion about the same axis.
PerFrame<LegMoments> recorded_moments(const audit::SimulatedFrames& motion);

/// Second derivative of a series of points, per s².
PerFrame<Vector3d> smooth_accelerations(const PerFrame<Vector3d>& points, double fps);

}  // namespace mimicx::judge
