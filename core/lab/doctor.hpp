#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/engines.hpp"
#include "core/lab/linear_model.hpp"
#include "core/model/budget.hpp"
#include "core/model/range.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A limit is held with a margin if the step is shorter by this factor.
inline constexpr double kSafeMargin = 1.4;

/// What a model is asked.
struct DoctorQuestion {
  double step = 0.0;                    // of the engine [s]; 0: the frame of the scene
  const Engine* engine = &kEngines[0];  // whose treatment of drives counts
  int held = 0;          // steps over which laws of drives outside the engine are held; 0: the
                         // engine has drives
  double seconds = 0.0;  // of each run [s]; 0: as the scene says, at most kMostSeconds
  bool runs = true;      // else only the start is analysed
  Budget budget = {};    // of each frame of a run
};
inline constexpr double kMostSeconds = 5.0;

// What may be asked.
inline constexpr Range kStepRange{1e-5, 1.0, false, false, "s"};
inline constexpr Range kRunRange{1e-3, 86400.0, false, false, "s"};
inline constexpr int kMostHeld = 1000;

/// A model's group of bodies at one time: the largest step of its linearisation.
struct GroupLimit {
  std::size_t group = 0;                   // in Diagnosis::groups
  double time = 0.0;                       // [s]
  double step = kNoLimit;                  // with drives as the engine treats them [s]
  double geometric = kNoLimit;             // 2/w_max of the geometric stiffness alone [s]
  double criterion = kNoLimit;             // 2/sqrt(r), of the paper's Eq. 9 [s]
  std::vector<LinearModel::Share> joints;  // of the geometric stiffness in the mode of `step`
  std::vector<LinearModel::Share> bodies;  // of its kinetic energy
  std::vector<LinearModel::Share> drives;  // of the stiffness and damping of drives in it
};

struct GroupFacts {
  std::vector<int> bodies;
  int freedom = 0;    // degrees of freedom
  int redundant = 0;  // rows of rigid joints that others imply
};

/// The drive and the spring of one joint at the start, its other joints free.
struct DriveLimit {
  int joint = -1;
  double inertia = 0.0;             // of its coordinate, armatures included [kg m^2 or kg]
  double stiffness = 0.0;           // of both [N m/rad or N/m]
  double damping = 0.0;             // of both [N m s/rad or N s/m]
  double explicit_step = kNoLimit;  // stiffness and damping explicit [s]
  double damped_step = kNoLimit;    // damping implicit [s]
  double held_step = kNoLimit;      // as a law held over DoctorQuestion::held steps [s]
  double delay_step = kNoLimit;     // of it, the part that no armature changes [s]
  double step = kNoLimit;           // as the question has it [s]
  double armature = 0.0;            // to add for the asked step, with kSafeMargin [kg m^2 or kg]
};

struct Finding {
  bool fails = false;  // else a warning
  std::string text;
};

/// One run of the scene.
struct DoctorRun {
  std::string what;  // "from its start"
  bool holds = true;
  std::string verdict;
  double seconds = 0.0;           // [s]
  double operations = 0.0;        // of the solver, per second of the model
  double gain = 0.0;              // largest rise of the energy over that of the start [J]
  bool by_shadow = false;         // judged by the energy that the scheme keeps, ShadowEnergy
  std::vector<double> criterion;  // 2/sqrt(r) after each frame [s]
  int leader = -1;                // body that determines the smallest of them
  double leader_time = 0.0;       // [s]
  std::vector<GroupLimit> worst;  // of each group, over the analysed times
};

/// A change that was tried with the asked step.
struct TriedRemedy {
  std::string text;
  bool holds = false;
  std::string verdict;
  double step = kNoLimit;   // foretold with it; of changes of the model [s]
  double operations = 0.0;  // of the solver, per second of the model
  double cost = 1.0;        // of them, relative to the run with the asked step [-]
  double moved = 0.0;       // largest distance of a body from a fine run of the model [m]
  double shorter = 0.0;     // the step, if it is another [s]; else 0
  double gain = 0.0;        // DoctorRun::gain, if the run holds by its shadow energy [J]; else 0
  std::shared_ptr<const Scene> changed;  // the model, if it is another; else null
};

struct Diagnosis {
  enum class Verdict : std::uint8_t { kHolds, kHoldsNarrowly, kFails, kNotUnderstood };
  Verdict verdict = Verdict::kNotUnderstood;
  std::string problem;  // if not understood
  DoctorQuestion question;
  double step = kNoLimit;   // the smallest foretold [s]
  std::string limited_by;   // what sets it
  std::vector<int> joints;  // that set it, the first most
  bool by_drive = false;    // a drive: the run with the asked step, whose drives are implicit, does
                            // not show it
  std::vector<GroupFacts> groups;
  int too_large = 0;              // bodies of groups that were not analysed
  std::vector<GroupLimit> start;  // of each group
  std::vector<DriveLimit> drives;
  std::vector<Finding> findings;
  std::vector<DoctorRun> runs;
  std::optional<DoctorRun> at_step;   // with the asked step, geometric stiffness explicit
  std::vector<TriedRemedy> remedies;  // if it does not hold with a margin
};

/// Answers a question about a scene. A question out of the ranges above is not understood.
Diagnosis diagnose(std::shared_ptr<const Scene> scene, const DoctorQuestion& question);

/// The run that Diagnosis::at_step judges, with its settings: the scene after the doctor's shake,
/// in frames that are one step of the paper's scheme, with joints that close exactly. @param step
/// [s] @param gain that the energy is allowed, 0: as the scene says [J]
Scene scene_at_step(const Scene& scene, double step, double gain = 0.0);

/// The gain for scene_at_step() with which a window judges a run as the doctor did [J].
double gain_of(const Diagnosis& diagnosis, double step);

/// The static checks alone.
std::vector<Finding> static_findings(const Scene& scene, const State& state);

}  // namespace substep
