// The simulator in packs of the widths that this build does not use, for the tests that compare widths.
#define MIMICX_OTHER_WIDTHS
#include "physics/control_interval.cpp"
#include "physics/step.cpp"
