#include "synth/noise/estimator_error.h"

#include "character/character.h"

namespace mimicx::synth {

double relative_joint_error(int body) {
  switch (body) {
    case kLeftHip:
    case kRightHip:
      return 0.9;
    case kSpine1:
    case kSpine2:
    case kSpine3:
    case kLeftCollar:
    case kRightCollar:
      return 0.45;
    case kLeftAnkle:
    case kRightAnkle:
      return 1.3;
    case kLeftFoot:
    case kRightFoot:
      return 0.6;
    case kNeck:
    case kHead:
      return 0.8;
    case kLeftShoulder:
    case kRightShoulder:
      return 1.2;
    case kLeftElbow:
    case kRightElbow:
    case kLeftWrist:
    case kRightWrist:
      return 1.4;
    default:
      return 1.0;
  }
}

}  // namespace mimicx::synth
