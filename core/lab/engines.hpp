#pragma once
// What other engines treat explicitly, and the names of what sets their step.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace substep {

/// How an engine evaluates a term: at the end of the step, or at its start.
enum class Treated : std::uint8_t { kImplicit, kExplicit };

/// Every one of them steps explicitly in the geometric stiffness of joints.
struct Engine {
  std::string_view name;  // on the command line
  const char* title;
  Treated stiffness;  // of drives and springs
  Treated damping;    // of drives
  bool assumed;       // the treatment of drives is the safe assumption, not what the engine says
  const char* step;   // what its users set; %1 is the step, %2 their number in a frame
  bool damps_springs = false;  // the damping of springs is implicit, whatever that of drives is
  bool explicit_velocities = false;  // gyroscopic and Coriolis forces are known to be explicit
};

inline constexpr std::array kEngines{
    Engine{"substep", "substep", Treated::kImplicit, Treated::kImplicit, false,
           "drift exact; mode const with n = %2, or adaptive with alpha = 1"},
    Engine{"mujoco", "MuJoCo, integrator Euler", Treated::kExplicit, Treated::kExplicit, false,
           "option timestep=\"%1\"", true, true},
    Engine{"mujoco-implicitfast", "MuJoCo, integrator implicitfast", Treated::kExplicit,
           Treated::kImplicit, false, "option timestep=\"%1\" integrator=\"implicitfast\"", false,
           true},
    Engine{"mujoco-discrete", "MuJoCo, integrator discrete", Treated::kImplicit, Treated::kImplicit,
           false, "option timestep=\"%1\" integrator=\"discrete\""},
    Engine{"drake", "Drake, discrete", Treated::kImplicit, Treated::kImplicit, false,
           "MultibodyPlant time_step = %1"},
    Engine{"rapier", "Rapier", Treated::kImplicit, Treated::kImplicit, true,
           "num_solver_iterations = %2"},
    Engine{"box2d", "Box2D", Treated::kImplicit, Treated::kImplicit, true, "subStepCount = %2"},
    Engine{"box3d", "Box3D", Treated::kImplicit, Treated::kImplicit, true, "subStepCount = %2"},
    Engine{"jolt", "Jolt", Treated::kImplicit, Treated::kImplicit, true,
           "inCollisionSteps = %2; its iterations do not matter"},
    Engine{"physx", "PhysX", Treated::kImplicit, Treated::kImplicit, true,
           "PGS: simulate(%1); TGS: %2 position iterations"},
    Engine{"bullet", "Bullet", Treated::kExplicit, Treated::kExplicit, true, "fixedTimeStep = %1"},
    Engine{"genesis", "Genesis", Treated::kExplicit, Treated::kExplicit, true, "substeps = %2"},
    Engine{"newton", "Newton", Treated::kExplicit, Treated::kExplicit, true, "substeps = %2"},
    Engine{"ode", "ODE", Treated::kExplicit, Treated::kExplicit, true, "dWorldStep(world, %1)"},
    Engine{"dart", "DART", Treated::kExplicit, Treated::kExplicit, true, "setTimeStep(%1)"}};

/// The engine of that name, or null.
const Engine* engine_of(std::string_view name);

/// Its setting with this step and number of steps per frame. @param step [s]
std::string setting_of(const Engine& engine, double step, int count);

}  // namespace substep
