/// A short planned motion and its teacher, made once for all tests.
#pragma once

#include "control/fixtures.h"
#include "teaching/student.h"

namespace mimicx::teaching {

inline const motion::Reference& short_squat() {
  static const motion::Reference reference = control::synthetic_reference("squat", 501, 45);
  return reference;
}
inline const control::Plan& plan_of_squat() {
  static const control::Plan plan = control::make_plan(control::system_of(short_squat()), {}, {.threads = 2});
  return plan;
}
inline const Teacher& teacher_of_squat() {
  static const Teacher teacher = make_teacher(short_squat(), plan_of_squat(), {}, {}, {.threads = 2}).value();
  return teacher;
}

}  // namespace mimicx::teaching
