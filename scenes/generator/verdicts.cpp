// Expected verdicts of every shipped scene with every solver and mode, from the paper's claims and
// the theory of the scenes. Rules that follow from runs state a reason.

#include "scenes/generator/verdicts.hpp"

#include <array>
#include <string>
#include <utility>

namespace substep::scenes {
namespace {

constexpr SolverKind kPgs = SolverKind::kPgs;
constexpr SolverKind kBpp = SolverKind::kBpp;
constexpr SolverKind kXpbd = SolverKind::kXpbd;
constexpr SolverKind kNewton = SolverKind::kNewton;

Expectation all_hold(std::string why) { return {.why = std::move(why)}; }

/// @param before [s]
Expectation fails(SolverKind solver, Mode mode, double before, std::string why = {}) {
  return {.solver = solver,
          .mode = mode,
          .verdict = Expected::kFails,
          .before = before,
          .why = std::move(why)};
}

/// One step per frame, with damping or a larger mass against the stiffness.
constexpr std::array kOneStep{Mode::kDamping, Mode::kStiffness};
/// Up to n_cap steps per frame, with damping or a larger inertia against the remaining stiffness.
constexpr std::array kUpToTheCap{Mode::kCapped, Mode::kInertia, Mode::kBlend};

/// A rule for each of several modes.
template <std::size_t Size>
void add_fails(Expectations& rules, SolverKind solver, const std::array<Mode, Size>& modes,
               double before, const std::string& why) {
  for (const Mode mode : modes) rules.push_back(fails(solver, mode, before, why));
}

template <std::size_t Size>
void add_depends(Expectations& rules, SolverKind solver, const std::array<Mode, Size>& modes,
                 const std::string& why) {
  for (const Mode mode : modes) {
    rules.push_back({.solver = solver, .mode = mode, .verdict = Expected::kDepends, .why = why});
  }
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

Expectations verdicts_of_swinging_box() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 1.0, "The step is seven times the stable one."),
      const_fails(kBpp, 4, 4.0, "The stable step is a seventh of a frame."),
      const_fails(kBpp, 6, 10.0, "The stable step is a seventh of a frame."),
      const_holds(kBpp, 7, "Exactly the stable step: alpha = 1 predicts 7."),
      fails(kPgs, Mode::kNone, 1.0),
      const_fails(kPgs, 4, 4.0)};
  add_fails(rules, kPgs, kOneStep, 3.0, "25 sweeps do not converge for a step of a whole frame.");
  rules.push_back(
      fails(kXpbd, Mode::kNone, 2.0, "25 sweeps do not converge for a step of a whole frame."));
  return rules;
}

Expectations verdicts_of_bridge() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 1.0, "The planks tear once the ball loads them."),
      const_fails(kBpp, 4, 3.0), fails(kPgs, Mode::kNone, 1.0), const_fails(kPgs, 4, 3.0)};
  add_fails(rules, kPgs, kOneStep, 3.0, "25 sweeps do not converge for a step of a whole frame.");
  add_fails(rules, kPgs, std::array{Mode::kInertia, Mode::kBlend}, 3.0,
            "Four sub-steps of 25 sweeps do not carry 1000 kg; only the damped mode barely does.");
  rules.push_back(
      fails(kXpbd, Mode::kNone, 3.0, "25 sweeps do not converge for a step of a whole frame."));
  return rules;
}

Expectations verdicts_of_convoy() {
  Expectations rules{
      all_hold("Steps below the criterion of Eq. 5 are stable, and damping makes them so."),
      fails(kBpp, Mode::kNone, 2.0, "Ten kilograms are enough to tear the planks."),
      const_fails(kBpp, 4, 7.0, "Enough for 100 kg, too few for 1000 kg."),
      fails(kPgs, Mode::kNone, 4.0, "25 sweeps are soft enough for 10 kg, not for 100 kg."),
      const_fails(kPgs, 4, 7.0, "Enough for 100 kg, too few for 1000 kg."),
      fails(kXpbd, Mode::kNone, 7.0, "25 sweeps of a whole frame do not converge."),
      const_fails(kXpbd, 4, 8.0, "25 sweeps do not carry 1000 kg in four sub-steps.")};
  add_fails(rules, kPgs, kOneStep, 7.0, "25 sweeps of a whole frame do not converge.");
  add_fails(rules, kPgs, std::array{Mode::kInertia, Mode::kBlend}, 8.0,
            "Four sub-steps of 25 sweeps do not carry 1000 kg, except with damping.");
  return rules;
}

Expectations verdicts_of_heavy_stack() {
  return {
      all_hold("Symmetric, and solved to double precision: the true constrained stiffness is 0."),
      all_fail(kPgs, 2.0, "25 sweeps do not converge for this mass on layers of 1 kg."),
      all_fail(kXpbd, 2.0, "25 sweeps do not converge for this mass on layers of 1 kg.")};
}

Expectations verdicts_of_heavy_stack_stress() {
  Expectations rules{all_hold("Small sub-steps reduce the error of the regularisation."),
                     fails(kBpp, Mode::kNone, 1.5),
                     const_fails(kBpp, 4, 4.0),
                     const_fails(kBpp, 8, 8.0),
                     fails(kNewton, Mode::kNone, 1.5),
                     const_fails(kNewton, 4, 4.0),
                     const_fails(kNewton, 8, 8.0)};
  add_fails(rules, kBpp, kOneStep, 1.5,
            "One step per frame: the failure is not a rotation, so damping and stiffness do not "
            "prevent it.");
  add_fails(rules, kBpp, kUpToTheCap, 4.0, "At most four sub-steps, which are too few.");
  for (const SolverKind sweeping : {kPgs, kXpbd}) {
    rules.push_back(all_fail(sweeping, 2.0,
                             "25 sweeps do not converge for ten tonnes on five layers of 1 kg."));
  }
  return rules;
}

Expectations verdicts_of_heavy_stack_stress_tall() {
  Expectations rules{
      all_hold("alpha = 0.05 just holds; 0.1 falls."),
      fails(kBpp, Mode::kNone, 1.5),
      const_fails(kBpp, 4, 4.0),
      const_fails(kBpp, 16, 10.0, "Fewer sub-steps than with alpha = 0.1, which falls."),
      fails(kNewton, Mode::kNone, 1.5),
      const_fails(kNewton, 4, 4.0),
      const_fails(kNewton, 16, 10.0)};
  add_fails(rules, kBpp, kOneStep, 1.5,
            "One step per frame: the failure is not a rotation, so damping and stiffness do not "
            "prevent it.");
  add_fails(rules, kBpp, kUpToTheCap, 4.0, "At most four sub-steps, which are too few.");
  for (const SolverKind sweeping : {kPgs, kXpbd}) {
    rules.push_back(all_fail(sweeping, 2.0,
                             "25 sweeps do not converge for twenty tonnes on ten layers of 1 kg."));
  }
  return rules;
}

Expectations verdicts_of_swinging_box_authors() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 2.0,
            "A tension of 13 kN on long links: the stable step is a third of a frame."),
      fails(kPgs, Mode::kNone, 2.0),
      fails(kPgs, Mode::kAdaptive, 4.0,
            "25 sweeps leave the joints open, and changes of N between 2 and 14 add 5 kJ in 2 s. "
            "It holds with a decision after every sub-step, or with alpha = 0.05.")};
  add_fails(rules, kPgs, kOneStep, 3.0, "25 sweeps do not converge for a step of a whole frame.");
  rules.push_back(
      fails(kXpbd, Mode::kNone, 3.0, "25 sweeps do not converge for a step of a whole frame."));
  return rules;
}

Expectations verdicts_of_bridge_authors() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 2.0, "The planks tear once the ball loads them."),
      const_fails(kBpp, 4, 3.0, "A tension of 100 kN: the stable step is a tenth of a frame."),
      fails(kPgs, Mode::kNone, 2.0),
      const_fails(kPgs, 4, 3.0),
      fails(kXpbd, Mode::kNone, 3.0),
      const_fails(kXpbd, 4, 5.0, "A tension of 100 kN on compliant joints.")};
  add_fails(rules, kPgs, kOneStep, 3.0, "25 sweeps do not converge for a step of a whole frame.");
  return rules;
}

Expectations verdicts_of_heavy_stack_authors() {
  return {
      all_hold("Symmetric, and solved to double precision: the true constrained stiffness is 0."),
      all_fail(kPgs, 5.0, "25 sweeps do not converge for twenty tonnes on four layers of 1 kg."),
      all_fail(kXpbd, 5.0, "25 sweeps do not converge for twenty tonnes on four layers of 1 kg.")};
}

Expectations verdicts_of_wrecking_ball() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 2.0, "The stable step is a sixth of a frame."),
      const_fails(kBpp, 4, 5.0, "The stable step is a sixth of a frame."),
      fails(kPgs, Mode::kNone, 2.0),
      const_fails(kPgs, 4, 5.0),
      fails(kXpbd, Mode::kNone, 5.0, "25 sweeps do not converge for a step of a whole frame.")};
  add_depends(
      rules, kBpp, std::array{Mode::kAdaptive},
      "Fallen crates make N jump between 1 and 64, and the full drift law then adds energy to the "
      "chain; the time depends on where they fall. Islands hold, as does soft drift.");
  for (const int n : {4, 16}) {
    rules.push_back(const_fails(kXpbd, n, 5.0,
                                "The residual of 25 sweeps at the impact becomes velocity; with "
                                "100 sweeps, 16 sub-steps hold."));
  }
  add_depends(rules, kBpp, std::array{Mode::kInertia, Mode::kBlend},
              "The links end up among the crates, where with four sub-steps a joint opens after 4 "
              "to 9 s, depending on rounding.");
  add_depends(
      rules, kPgs, kOneStep,
      "The joints open to nine tenths of the limit: the verdict depends on where the crates fall.");
  return rules;
}

Expectations verdicts_of_ragdoll_drop() {
  Expectations rules{
      all_hold("Masses of the same order; but at a landing a limb rotates far within a frame."),
      fails(kBpp, Mode::kNone, 2.0, "At a landing a limb rotates too far within a frame.")};
  for (const SolverKind solver : {kBpp, kPgs}) {
    add_depends(rules, solver, kOneStep,
                "Whether a joint opens at a landing depends on how the dolls tumble.");
  }
  rules.push_back(
      fails(kNewton, Mode::kNone, 2.0,
            "With one sub-step per frame, a landing needs more than 25 Newton steps; 200 hold."));
  rules.push_back(fails(kXpbd, Mode::kNone, 2.0,
                        "With one sub-step per frame, 25 sweeps do not converge at a landing."));
  return rules;
}

Expectations verdicts_of_card_house() {
  Expectations rules{
      all_hold("At rest: the stiffness allows one step per frame."),
      const_holds(kBpp, 8,
                  "The scene's own setting: in a step this short no card rolls over its edge.")};
  for (const SolverKind sweeping : {kPgs, kXpbd}) {
    rules.push_back(all_fail(sweeping, 10.0, "The residual of 25 sweeps lets the cards creep."));
    for (const int n : {8, 16}) {
      rules.push_back(
          const_holds(sweeping, n, "Hundreds of sweeps per frame: the cards creep slowly."));
    }
  }
  return rules;
}

Expectations verdicts_of_newtons_cradle() {
  Expectations rules{all_hold("Bodies that do not load each other; impacts add no energy.")};
  for (const SolverKind solver : {kBpp, kPgs}) {
    rules.push_back(const_holds(solver, 32, "The scene's own number of sub-steps."));
  }
  return rules;
}

Expectations verdicts_of_whirling_chain() {
  Expectations rules{
      all_hold("Sub-steps that satisfy Eq. 5 are stable; damping makes longer ones satisfy it."),
      fails(kBpp, Mode::kNone, 1.0, "A frame is longer than the stable step of the links."),
      fails(kPgs, Mode::kNone, 1.0)};
  add_depends(
      rules, kXpbd, std::array{Mode::kNone},
      "25 sweeps for a step of a whole frame leave a joint open by about the limit, 0.1 m.");
  return rules;
}

Expectations verdicts_of_crank_rocker() {
  return {all_hold("Exact joints at a constant or held N keep the energy; Newton's damps it."),
          fails(kBpp, Mode::kNone, 1.0, "A frame is half a radian of the crank."),
          fails(kPgs, Mode::kNone, 1.0, "A frame is half a radian of the crank.")};
}

Expectations verdicts_of_thrown_rope() {
  const std::string snap = "The snap needs some 150 sub-steps in its frame.";
  Expectations rules{
      all_hold("N rises within the frame of a snap (redo) and is held; Newton's method damps."),
      fails(kBpp, Mode::kNone, 2.0, snap),
      const_fails(kBpp, 4, 2.0, snap),
      const_fails(kBpp, 16, 8.0, snap),
      fails(kPgs, Mode::kNone, 2.0, snap),
      fails(kXpbd, Mode::kNone, 2.0, snap),
      const_fails(kXpbd, 4, 2.0, snap)};
  add_fails(rules, kBpp, std::array{Mode::kInertia, Mode::kBlend}, 2.0,
            "Four sub-steps resolve no snap, and a larger inertia does not damp it.");
  add_depends(rules, kBpp, kOneStep,
              "With Euler the damping holds, with leapfrog the start fails.");
  add_depends(rules, kPgs, std::array{Mode::kConst},
              "How much 16 sub-steps of 25 sweeps gain at a snap depends on the phase.");
  rules.push_back(const_fails(kPgs, 4, 2.0, snap));
  add_fails(rules, kPgs, kOneStep, 2.0, "25 sweeps do not converge for a step of a whole frame.");
  add_fails(rules, kPgs, kUpToTheCap, 2.0, snap);
  return rules;
}

}  // namespace

Expectations verdicts_of(const std::string& name) {
  if (name == "swinging_box") return verdicts_of_swinging_box();
  if (name == "bridge") return verdicts_of_bridge();
  if (name == "convoy") return verdicts_of_convoy();
  if (name == "heavy_stack" || name == "heavy_stack_tall") return verdicts_of_heavy_stack();
  if (name == "heavy_stack_stress") return verdicts_of_heavy_stack_stress();
  if (name == "heavy_stack_stress_tall") return verdicts_of_heavy_stack_stress_tall();
  if (name == "swinging_box_authors") return verdicts_of_swinging_box_authors();
  if (name == "bridge_authors") return verdicts_of_bridge_authors();
  if (name == "heavy_stack_authors") return verdicts_of_heavy_stack_authors();
  if (name == "wrecking_ball") return verdicts_of_wrecking_ball();
  if (name == "card_house") return verdicts_of_card_house();
  if (name == "ragdoll_drop") return verdicts_of_ragdoll_drop();
  if (name == "newtons_cradle") return verdicts_of_newtons_cradle();
  if (name == "whirling_chain") return verdicts_of_whirling_chain();
  if (name == "crank_rocker") return verdicts_of_crank_rocker();
  if (name == "thrown_rope") return verdicts_of_thrown_rope();
  if (name == "wall")
    return {all_hold("There is no joint that could open: all numbers stay finite.")};
  return {all_hold("One body, or bodies that do not load each other.")};
}

}  // namespace substep::scenes
