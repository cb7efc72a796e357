// What every shipped scene should come to under every solver, mode and integrator: the one table.
// The paper's claims and the scenes' own theory stand behind it; what a run showed to be otherwise
// says why.

#include "scenes/generator/verdicts.hpp"

#include <utility>

namespace substep::scenes {
namespace {

constexpr SolverKind kPgs = SolverKind::kPgs;
constexpr SolverKind kBpp = SolverKind::kBpp;

Expectation all_hold(std::string why) { return {.why = std::move(why)}; }

/// @param before [s]
Expectation fails(SolverKind solver, Mode mode, double before, std::string why = {}) {
  return {.solver = solver,
          .mode = mode,
          .verdict = Expected::kFails,
          .before = before,
          .why = std::move(why)};
}

Expectation const_fails(SolverKind solver, int n, double before, std::string why = {}) {
  Expectation rule = fails(solver, Mode::kConst, before, std::move(why));
  rule.n = n;
  return rule;
}

Expectation const_holds(SolverKind solver, int n, std::string why = {}) {
  return {.solver = solver, .mode = Mode::kConst, .n = n, .why = std::move(why)};
}

Expectation all_fail(SolverKind solver, double before, std::string why) {
  return {.solver = solver, .verdict = Expected::kFails, .before = before, .why = std::move(why)};
}

Expectations swinging_box() {
  return {all_hold("Steps below the criterion of Eq. 5 are stable, and damping makes them so."),
          fails(kBpp, Mode::kNone, 1.0, "The step is seven times the stable one."),
          const_fails(kBpp, 4, 4.0, "The stable step is a seventh of a frame."),
          const_fails(kBpp, 6, 10.0, "The stable step is a seventh of a frame."),
          const_holds(kBpp, 7, "The stable step, to the last sub-step: alpha = 1 predicts 7."),
          fails(kPgs, Mode::kNone, 1.0),
          const_fails(kPgs, 4, 4.0),
          fails(kPgs, Mode::kDamping, 3.0, "Damping does not make 25 sweeps converge."),
          fails(kPgs, Mode::kCapped, 4.0,
                "At four sub-steps the links stretch by what 25 sweeps leave over.")};
}

Expectations bridge() {
  return {all_hold("Steps below the criterion of Eq. 5 are stable, and damping makes them so."),
          fails(kBpp, Mode::kNone, 1.0, "The planks tear once the ball loads them."),
          const_fails(kBpp, 4, 3.0),
          fails(kPgs, Mode::kNone, 1.0),
          const_fails(kPgs, 4, 3.0),
          fails(kPgs, Mode::kDamping, 3.0, "Damping does not make 25 sweeps converge."),
          fails(kPgs, Mode::kCapped, 3.0, "Four sub-steps of 25 sweeps do not carry 1000 kg.")};
}

Expectations heavy_stack() {
  return {
      all_hold("Symmetric, and exact to double precision: the true constrained stiffness is 0."),
      all_fail(kPgs, 2.0, "25 sweeps do not carry ten tonnes up five layers of 1 kg.")};
}

Expectations heavy_stack_stress() {
  return {all_hold("Small steps cure by conditioning what the regularisation takes away."),
          fails(kBpp, Mode::kNone, 1.5),
          fails(kBpp, Mode::kDamping, 1.5, "Damping slows a spin, and the stack does not spin."),
          const_fails(kBpp, 4, 4.0),
          const_fails(kBpp, 8, 8.0),
          fails(kBpp, Mode::kCapped, 4.0, "A cap of four is four sub-steps, damped in vain."),
          all_fail(kPgs, 2.0, "25 sweeps do not carry ten tonnes up five layers of 1 kg.")};
}

Expectations heavy_stack_stress_tall() {
  return {all_hold("alpha = 0.05, by a hair: 0.1 falls."),
          fails(kBpp, Mode::kNone, 1.5),
          fails(kBpp, Mode::kDamping, 1.5),
          const_fails(kBpp, 4, 4.0),
          const_fails(kBpp, 16, 10.0, "Fewer than alpha = 0.1 takes, and that falls."),
          fails(kBpp, Mode::kCapped, 4.0),
          all_fail(kPgs, 2.0, "25 sweeps do not carry twenty tonnes up ten layers of 1 kg.")};
}

Expectations wrecking_ball() {
  return {all_hold("Steps below the criterion of Eq. 5 are stable, and damping makes them so."),
          fails(kBpp, Mode::kNone, 2.0, "The stable step is a sixth of a frame."),
          const_fails(kBpp, 4, 5.0, "The stable step is a sixth of a frame."),
          fails(kPgs, Mode::kNone, 2.0),
          const_fails(kPgs, 4, 5.0),
          fails(kPgs, Mode::kDamping, 3.0, "Damping does not make 25 sweeps converge.")};
}

Expectations card_house() {
  return {all_hold("At rest in friction: nothing to be unstable."),
          all_fail(kPgs, 10.0, "What 25 sweeps leave over lets the cards creep.")};
}

}  // namespace

Expectations verdicts_of(const std::string& name) {
  if (name == "swinging_box") return swinging_box();
  if (name == "bridge") return bridge();
  if (name == "heavy_stack" || name == "heavy_stack_tall") return heavy_stack();
  if (name == "heavy_stack_stress") return heavy_stack_stress();
  if (name == "heavy_stack_stress_tall") return heavy_stack_stress_tall();
  if (name == "wrecking_ball") return wrecking_ball();
  if (name == "card_house") return card_house();
  if (name == "ragdoll_drop") return {all_hold("Masses of one order: no stiffness to speak of.")};
  if (name == "wall") return {all_hold("No joint to tear: all numbers stay finite.")};
  return {all_hold("One body, or bodies that do not load each other.")};
}

}  // namespace substep::scenes
