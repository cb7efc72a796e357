#pragma once
// Every scene that the project ships, as code: the scene files beside this folder are written from
// here. Nothing beyond sqrt is used, so that every compiler writes the same bytes.

#include <vector>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// An angle by its sine and cosine, so that no libm is needed.
struct Angle {
  double sine;    // [-]
  double cosine;  // [-]
};
inline constexpr Angle kSixtyDegrees{0.86602540378443865, 0.5};

/// Links on hinges with a heavy box at the end, released at an angle.
struct RopeOptions {
  int n = 25;                   // links, >= 1
  double link_length = 0.4;     // [m]
  double end_mass = 1000.0;     // of the box at the end [kg]
  double compliance = 1e-12;    // of all joint rows [m/N, rad/(N m)]
  Angle angle = kSixtyDegrees;  // from straight down
  double link_width = 0.1;      // edge of a link's square cross-section [m]
  double link_mass = 1.0;       // of one link [kg]
  double box_size = 1.0;        // edge of the box at the end [m]
  Vec3 anchor = Vec3::Zero();   // suspension point, world [m]
};
Scene rope_of_n(const RopeOptions& options = {});

/// The rope of 25 links with its anchor at (0, 12, 0), over a floor without contacts.
struct SwingingBoxOptions {
  Angle angle = kSixtyDegrees;  // from straight down
  double compliance = 0.0;      // of all joint rows: hinges are exact [m/N, rad/(N m)]
};
Scene swinging_box(const SwingingBoxOptions& options = {});

/// A heavy ball rolls over hanging planks.
struct BridgeOptions {
  double ball_x = -4.2;     // initial position of the ball [m]
  double ball_speed = 3.0;  // along the plank under it [m/s]
  double span = 9.9;        // horizontal distance of the two ends [m]; they differ by 1 m in height
};
Scene bridge(const BridgeOptions& options = {});
/// The 8 starts of the survival counts.
std::vector<BridgeOptions> bridge_starts();

/// Three balls of growing mass roll over the bridge one after another.
Scene convoy();

/// Layers of four light balls and a plate under a very heavy box.
struct HeavyStackOptions {
  int layers = 5;
  double top_mass = 10000.0;  // [kg]
  double alpha = 0.1;         // of the scene's settings [-]
  bool stress = false;        // diagonal regularisation and a start jitter of the balls
  double compliance = 1e-12;  // of the contacts [m/N]
};
Scene heavy_stack(const HeavyStackOptions& options = {});
Scene heavy_stack_tall();
Scene heavy_stack_stress();
Scene heavy_stack_stress_tall();

/// The three with the constants of the authors' public program.
Scene swinging_box_authors();
Scene bridge_authors();
Scene heavy_stack_authors();

/// A rod on a hinge: the physical pendulum, released at rest from the angle with sine 3/5.
Scene pendulum();
/// A free asymmetric body that rotates about its intermediate axis and flips over (Dzhanibekov).
Scene spinning_top();

/// A box with three unequal moments of inertia on a ball joint, in three-dimensional motion.
Scene spherical_pendulum();
/// A symmetric top at 60 rad/s on a ball joint at its tip, released tilted.
Scene heavy_top();
/// Light links on ball joints with a heavy box at the end, whirled around the vertical.
Scene whirling_chain();

/// A four-bar linkage with a fast crank; conservative.
Scene crank_rocker();
/// A ball thrown up on a light rope, which goes slack and snaps taut; conservative.
Scene thrown_rope();

/// A box on a slope.
struct SlopeOptions {
  // A Pythagorean triple: the slope falls `fall` over `run`, and `length` is exact.
  double fall = 5.0;
  double run = 12.0;
  double length = 13.0;
  double friction = 0.3;  // mu; the box slides if it is below fall/run [-]
};
Scene sliding_box(const SlopeOptions& options = {});

/// Balls fall 2 m and bounce with restitutions from 1 to 0.
Scene bouncing_balls();
/// Five equal balls on rods, 4 mm apart, with elastic impacts; the first is released from the angle
/// with sine 3/5.
Scene newtons_cradle();

/// One ball in free fall from 20 m.
Scene free_fall();

/// Dry bricks in running bond and a ball thrown at them.
struct WallOptions {
  int courses = 8;  // >= 1
  int bricks = 6;   // in a course, >= 1
};
Scene wall(const WallOptions& options = {});

/// A heavy ball on a chain swings into a tower of crates.
Scene wrecking_ball();

/// Pairs of cards that lean on each other, lying cards between the storeys.
/// @param storeys pairs of cards at the bottom, one less in each storey above, >= 1
Scene card_house(int storeys = 4);

/// Four jointed dolls fall down a flight of steps.
Scene ragdoll_drop();

/// All of the files of this folder.
std::vector<Scene> shipped();

}  // namespace substep::scenes
