#include "files/state_members.h"

#include <stdexcept>

#include "files/simulation_settings.h"

namespace mimicx::files {
namespace {

constexpr std::size_t kPositionNumbers = 3 + 4 * kBodies;
constexpr std::size_t kVelocityNumbers = 3 + 3 * kBodies;

/// Calls visit(number) for every one of a state's positions, and for every one of its velocities.
template <class StateType, class Visit>
void for_each_position(StateType& x, const Visit& visit) {
  for (auto* p : {&x.p_root.x, &x.p_root.y, &x.p_root.z}) visit(*p);
  for (auto& q : x.q)
    for (auto* p : {&q.w, &q.x, &q.y, &q.z}) visit(*p);
}
template <class StateType, class Visit>
void for_each_velocity(StateType& x, const Visit& visit) {
  for (auto* p : {&x.v_root.x, &x.v_root.y, &x.v_root.z}) visit(*p);
  for (auto& w : x.omega)
    for (auto* p : {&w.x, &w.y, &w.z}) visit(*p);
}

}  // namespace

void add_states(const std::string& prefix, const std::vector<physics::State<double>>& states,
                Precision precision, Npz& npz) {
  std::vector<double> q, v;
  for (const physics::State<double>& x : states) {
    for_each_position(x, [&](double number) { q.push_back(number); });
    for_each_velocity(x, [&](double number) { v.push_back(number); });
  }
  npz.set(prefix + "q", numbers_member({states.size(), kPositionNumbers}, q, precision));
  npz.set(prefix + "v", numbers_member({states.size(), kVelocityNumbers}, v, precision));
}

std::size_t rows_of(const Npz& npz, const std::string& name) {
  const NpyArray& member = npz.at(name);
  return member.shape.empty() ? 0 : member.shape[0];
}

std::vector<physics::State<double>> read_states(const Npz& npz, const std::string& prefix) {
  const std::size_t count = rows_of(npz, prefix + "q");
  const std::vector<double> q = read_numbers(npz, prefix + "q", count, kPositionNumbers);
  const std::vector<double> v = read_numbers(npz, prefix + "v", count, kVelocityNumbers);
  std::vector<physics::State<double>> states(count);
  const double *q_at = q.data(), *v_at = v.data();
  for (physics::State<double>& x : states) {
    for_each_position(x, [&](double& number) { number = *q_at++; });
    for_each_velocity(x, [&](double& number) { number = *v_at++; });
  }
  return states;
}

double read_number(const Npz& npz, const std::string& name) { return read_numbers(npz, name, 1, 1)[0]; }

physics::SimulationConfig read_simulation(const Npz& npz) {
  physics::SimulationConfig simulation;
  for_each_simulation_setting(simulation,
                              [&](const std::string& name, auto& field) { read_into(npz, name, field); });
  try {
    physics::make_model<double>(make_character(), simulation);  // the simulator is the judge
  } catch (const std::invalid_argument& error) {
    throw DataError(npz.path, "", "the settings of a simulation", error.what());
  }
  return simulation;
}

std::string read_text(const Npz& npz, const std::string& name) {
  const NpyArray& member = npz.at(name);
  if (member.type != NpyArray::Type::kText || member.text.size() != 1)
    throw DataError(npz.path, name, "a text", "something else");
  return member.text[0];
}

}  // namespace mimicx::files
