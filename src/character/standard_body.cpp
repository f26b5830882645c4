#include "character/standard_body.h"

#include "core/units.h"

namespace mimicx {

Vector3d standard_offset(int body) {
  switch (body) {
    case kLeftHip:
    case kRightHip:
      return {0.066, -0.088, -0.006};
    case kSpine1:
      return {0.0, 0.108, -0.026};
    case kLeftKnee:
    case kRightKnee:
      return {0.040, -0.382, -0.004};
    case kSpine2:
      return {0.0, 0.136, 0.001};
    case kLeftAnkle:
    case kRightAnkle:
      return {-0.012, -0.402, -0.040};
    case kSpine3:
      return {0.0, 0.054, 0.026};
    case kLeftFoot:
    case kRightFoot:
      return {0.024, -0.056, 0.122};
    case kNeck:
      return {0.0, 0.214, -0.042};
    case kLeftCollar:
    case kRightCollar:
      return {0.074, 0.118, -0.034};
    case kHead:
      return {0.0, 0.066, 0.050};
    case kLeftShoulder:
    case kRightShoulder:
      return {0.096, 0.034, -0.010};
    case kLeftElbow:
    case kRightElbow:
      return {0.258, -0.014, -0.026};
    case kLeftWrist:
    case kRightWrist:
      return {0.250, 0.008, -0.001};
    default:
      return Vector3d::Zero();
  }
}

double mass_share(int body) {
  switch (body) {
    case kPelvis:
      return 0.118;
    case kSpine1:
      return 0.082;
    case kSpine2:
      return 0.082;
    case kSpine3:
      return 0.112;
    case kNeck:
      return 0.012;
    case kHead:
      return 0.056;
    case kLeftHip:
    case kRightHip:
      return 0.1446;
    case kLeftKnee:
    case kRightKnee:
      return 0.0457;
    case kLeftAnkle:
    case kRightAnkle:
      return 0.0113;
    case kLeftFoot:
    case kRightFoot:
      return 0.0022;
    case kLeftCollar:
    case kRightCollar:
      return 0.0204;
    case kLeftShoulder:
    case kRightShoulder:
      return 0.0263;
    case kLeftElbow:
    case kRightElbow:
      return 0.0150;
    default:
      return 0.0035;
  }
}

std::vector<std::array<int, 2>> make_self_pairs() {
  std::vector<std::array<int, 2>> pairs;
  for (int arm : {kLeftElbow, kRightElbow, kLeftWrist, kRightWrist}) {
    for (int other : {kPelvis, kSpine1, kSpine2, kSpine3, kHead, kLeftHip, kRightHip})
      pairs.push_back({arm, other});
    for (int lower_leg : {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle})
      if (arm == kLeftWrist || arm == kRightWrist) pairs.push_back({arm, lower_leg});
  }
  pairs.insert(pairs.end(), {{kLeftWrist, kRightWrist},
                             {kLeftWrist, kRightElbow},
                             {kLeftElbow, kRightWrist},
                             {kLeftElbow, kRightElbow},
                             {kLeftHip, kRightHip},
                             {kLeftHip, kRightKnee},
                             {kLeftKnee, kRightHip},
                             {kLeftKnee, kRightKnee},
                             {kLeftAnkle, kRightAnkle},
                             {kLeftAnkle, kRightKnee},
                             {kLeftKnee, kRightAnkle},
                             {kLeftFoot, kRightAnkle},
                             {kLeftAnkle, kRightFoot},
                             {kLeftFoot, kRightFoot}});
  return pairs;
}

JointParameters standard_joint(int body) {
  JointParameters j;
  j.armature = 0.02;
  const auto pd = [&](double kp, double limit) {
    j.kp = kp;
    j.kd = 0.1 * kp;
    j.torque_limit = limit;
  };
  const auto range = [&](Vector3d centre_deg, Vector3d half_deg) {
    j.centre = kDegree * centre_deg;
    j.half_range = kDegree * half_deg;
  };
  const double x = is_right(body) ? -1.0 : 1.0;  // mirror: rotations about y and z change sign
  switch (body) {
    case kLeftHip:
    case kRightHip:
      pd(500, 250);
      range({-45, 0, 10 * x}, {95, 75, 75});
      break;
    case kLeftKnee:
    case kRightKnee:
      pd(500, 220);
      range({75, 75, 75}, {82, 82, 82});
      break;
    case kLeftAnkle:
    case kRightAnkle:
      pd(400, 160);
      range({12, 0, 0}, {62, 60, 50});
      break;
    case kLeftFoot:
    case kRightFoot:
      pd(100, 40);
      range({-15, 0, 0}, {65, 30, 30});
      break;
    case kSpine1:
    case kSpine2:
    case kSpine3:
      pd(1000, 250);
      range({10, 0, 0}, {50, 45, 45});
      break;
    case kNeck:
      pd(150, 50);
      range({0, 0, 0}, {55, 65, 50});
      break;
    case kHead:
      pd(100, 40);
      range({0, 0, 0}, {55, 65, 50});
      break;
    case kLeftCollar:
    case kRightCollar:
      pd(500, 130);
      range({0, 0, 5 * x}, {45, 45, 45});
      break;
    case kLeftShoulder:
    case kRightShoulder:
      pd(400, 120);
      range({0, -25 * x, -10 * x}, {130, 125, 130});
      break;
    case kLeftElbow:
    case kRightElbow:
      pd(300, 80);
      range({77, 77, 77}, {85, 85, 85});
      break;
    case kLeftWrist:
    case kRightWrist:
      pd(80, 20);
      range({0, 0, 0}, {140, 90, 95});
      break;
    default:
      break;
  }
  if (body == kLeftFoot || body == kRightFoot || body >= kLeftWrist || body == kNeck || body == kHead)
    j.armature = 0.01;
  return j;
}

}  // namespace mimicx
