/// The simulator behind `mimicx_simulator` of include/mimicx.h: one body in doubles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "physics/step.h"

namespace mimicx::c_interface {

/// Numbers that the caller sees: where they are, and their shape.
struct NumberView {
  double* data;
  std::vector<int> shape;
};

class Simulator {
 public:
  explicit Simulator(const std::array<double, kBetas>& betas);
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// @throws std::invalid_argument for an unknown setting or an impossible value
  void set(const std::string& name, double value);
  void stand();
  /// The numbers of a name of mimicx.h. @throws std::invalid_argument for an unknown name
  NumberView numbers(const std::string& name);
  /// @throws std::runtime_error where the state is none, or becomes none; it is then as before
  void step(int steps);

 private:
  void look();

  Character character_;
  physics::SimulationConfig config_;
  physics::Model<double> model_;
  physics::State<double> state_;
  physics::Target<double> target_;
  physics::Wrench<double> push_{};
  physics::Data<double> data_{};
  physics::Applied<double> mean_{};  ///< means over the last steps
};

}  // namespace mimicx::c_interface
