#pragma once
// Common parts of scenes.

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// An empty scene with the paper's settings. A gap of 0.1 m fails; the energy is not judged.
Scene paper_scene();

/// A moving body with the inertia of its solid shape, at rest.
Body solid(std::string name, const Shape& shape, double mass, const Vec3& position);

/// Colours of the playground: distinguishable with red-green colour blindness, and different from
/// the bright orange that marks bodies that need small steps.
inline constexpr std::uint32_t kBrick = 0xb07a6c;
inline constexpr std::uint32_t kBrickDark = 0x9a6659;
inline constexpr std::uint32_t kIron = 0x5a6676;
inline constexpr std::uint32_t kWood = 0xd8c08c;
inline constexpr std::uint32_t kWoodDark = 0xc2a874;
inline constexpr std::uint32_t kPaper = 0xf2ead8;
inline constexpr std::uint32_t kBlue = 0x5b93d6;
inline constexpr std::uint32_t kTeal = 0x4bb59e;
inline constexpr std::uint32_t kRose = 0xcf7fa3;
inline constexpr std::uint32_t kViolet = 0xa38ad6;

/// A box by its full extents [m].
Box box(double x, double y, double z);

/// A static plane y = height, facing up [m].
Body floor_plane(double height = 0.0);

/// Base of the playground scenes: a floor, and slightly compliant contacts, because piles have
/// redundant contact points.
/// @param margin gap below which a contact has rows [m]
void add_ground(double friction, double margin, Scene& scene);

/// Joins the planks of a bridge, bodies 1 to `planks` after the floor, to each other and to the
/// world by two ball joints in every gap.
/// @param pitch distance of a plank's two pivots, along its x [m]  @param half_width z of the two
/// joints [m]  @param left, right the ends of the bridge, world [m]
void join_planks(int planks, double pitch, double half_width, const Vec3& left, const Vec3& right,
                 Scene& scene);

BallJoint ball_joint(std::string name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b);

/// Axis z of both bodies.
HingeJoint hinge_joint(std::string name, int a, const Vec3& anchor_a, int b, const Vec3& anchor_b);

/// The rotation of +x to (c, s, 0), about z by an angle between -180 and 180 deg.
/// @param c its cosine  @param s its sine
Quat turn_about_z(double c, double s);

/// A body's local point in the world [m].
Vec3 world_point(const Body& body, const Vec3& local);

}  // namespace substep::scenes
