// The tape: a network learns a curve, its gradient against differences, and the gradient of a gradient.
//
// You learn: that a loss is a list of operations on a tape; that every operation's derivative consists of
// operations, so that a gradient can be differentiated again; how a penalty on a gradient uses that.
// Belongs to: docs/method.md §7 (networks, gradient penalty); src/nn/tape.h, src/nn/ops.cpp, src/nn/adam.h.
// Questions: 1. How do the errors of the differences change with h = 1e-1, 1e-3, 1e-5, 1e-9? Why are they
//               least between?
//            2. In a float network the errors would be larger. Why, and what would h have to be there?
//            3. Add 0.01 · mean (dy/dx)² to the loss that Adam reduces. How does the learnt curve change?
#include <cmath>

#include "core/random.h"
#include "nn/adam.h"
#include "nn/gradient.h"
#include "nn/mlp.h"
#include "nn/ops.h"
#include "plot.h"

using namespace mimicx;
using nn::Tape;
using nn::Var;
using Matrix = nn::Matrix<double>;

struct Recorded {
  Var loss, x, y;
  std::vector<Var> parameters;
};

// Mean squared error of the network on the points.
Recorded record_loss(Tape<double>& tape, const nn::Mlp<double>& net, const Matrix& x, const Matrix& y) {
  tape.reset();
  Recorded r;
  r.x = tape.refer(x);
  r.parameters = nn::parameters_on_tape(tape, net);
  r.y = nn::forward(tape, net, r.parameters, r.x);
  r.loss = nn::mean(tape, nn::square(tape, nn::sub(tape, r.y, tape.refer(y))));
  return r;
}

// Mean over the points of (dy/dx)²: a function of the weights that contains a gradient.
Var record_penalty(Tape<double>& tape, const Recorded& r) {
  const Var inputs[] = {r.x};  // the derivative of Σ y by x_i is that of y_i
  return nn::mean(tape, nn::square(tape, nn::gradient<double>(tape, nn::sum(tape, r.y), inputs)[0]));
}

int main() {
  const int n = 64;
  Matrix x(n, 1), y(n, 1);
  for (int i = 0; i < n; ++i) {
    x(i, 0) = -1.0 + 2.0 * i / (n - 1);
    y(i, 0) = std::sin(3.0 * x(i, 0)) + 0.3 * x(i, 0);
  }
  Random random(1);
  nn::Mlp<double> net = nn::make_mlp<double>({1, 24, 24, 1}, 1.0, random);
  const std::vector<Matrix*> parameters = nn::parameters(net);
  Tape<double> tape;

  // One entry of the gradient, and of the gradient of the penalty, against central differences.
  double& weight = (*parameters[2])(3, 5);
  const double h = 1e-5;
  const auto value = [&](bool penalty, double change) {
    weight += change;
    const Recorded r = record_loss(tape, net, x, y);
    const double result = tape.scalar(penalty ? record_penalty(tape, r) : r.loss);
    weight -= change;
    return result;
  };
  for (const bool penalty : {false, true}) {
    const double differences = (value(penalty, h) - value(penalty, -h)) / (2 * h);
    const Recorded r = record_loss(tape, net, x, y);
    const Var of = penalty ? record_penalty(tape, r) : r.loss;
    const double by_tape = tape.value(nn::gradient<double>(tape, of, r.parameters)[2])(3, 5);
    std::printf("%s: tape %+.8f, differences off by %.0e, %d nodes\n",
                penalty ? "gradient of mean (dy/dx)²" : "gradient of the loss     ", by_tape,
                std::abs(differences - by_tape), tape.size());
  }

  nn::Adam<double> adam = nn::make_adam<double>(parameters);
  tour::Curve losses = tour::line("", 0);
  for (int step = 0; step <= 1000; ++step) {
    const Recorded r = record_loss(tape, net, x, y);
    std::vector<Matrix> gradients;
    const Var loss = r.loss;
    for (const Var g : nn::gradient<double>(tape, loss, r.parameters)) gradients.push_back(tape.value(g));
    if (step % 10 == 0) tour::add(losses, step, tape.scalar(r.loss));
    if (step % 500 == 0)
      std::printf("step %4d: loss %.5f, mean (dy/dx)² %.2f\n", step, tape.scalar(r.loss),
                  tape.scalar(record_penalty(tape, r)));
    nn::adam_step<double>(adam, parameters, gradients, 5e-3);
  }
  tour::Curve truth = tour::line("y", 4, tour::Style::kDashed), learnt = tour::line("network", 0);
  nn::Workspace<double> workspace;
  Matrix out;
  nn::evaluate(net, x, workspace, out);
  for (int i = 0; i < n; ++i) tour::add(truth, x(i, 0), y(i, 0));
  for (int i = 0; i < n; ++i) tour::add(learnt, x(i, 0), out(i, 0));
  tour::save_picture(
      "3_tape", "A network learns a curve",
      {{"the loss", "step", "mean squared error", {losses}, true}, {"the curve", "x", "y", {truth, learnt}}});
}
