// What the machine says of itself: instructions on the emulated microcontroller, nothing on a PC.
#pragma once

#include <cstdint>

/// Ticks of something that is done again and again.
class Counted {
 public:
  void begin();
  void end();
  double mean() const { return times_ > 0 ? total_ / times_ : 0.0; }
  double most() const { return most_; }

 private:
  std::uint32_t began_ = 0;
  double total_ = 0.0, most_ = 0.0;
  int times_ = 0;
};

/// @param thinking  a step of the policy  @param moving  `substeps` of the physics
void print_counts(const Counted& thinking, const Counted& moving, int substeps);
