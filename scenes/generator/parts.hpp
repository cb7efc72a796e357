#pragma once
// What several scenes are put together from.

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"

namespace substep::scenes {

/// A moving body with the inertia of its solid shape, at rest.
Body solid(std::string name, const Shape& shape, double mass, const Vec3& position);

/// Colours of the playground, apart for people who do not see red and green as others do.
inline constexpr std::uint32_t kBrick = 0xc8704a;
inline constexpr std::uint32_t kBrickDark = 0xb05c3a;
inline constexpr std::uint32_t kIron = 0x3c4654;
inline constexpr std::uint32_t kWood = 0xd9b26f;
inline constexpr std::uint32_t kWoodDark = 0xc29a57;
inline constexpr std::uint32_t kPaper = 0xf2ead8;
inline constexpr std::uint32_t kBlue = 0x4f8fd8;
inline constexpr std::uint32_t kTeal = 0x3fb39a;
inline constexpr std::uint32_t kAmber = 0xe8a33d;
inline constexpr std::uint32_t kViolet = 0xa882d8;

/// A box by its full extents [m].
Box box(double x, double y, double z);

/// A static plane y = height, facing up [m].
Body floor_plane(double height = 0.0);

/// The orientation that turns +x to (c, s, 0): a turn about z by an angle between -180 and 180 deg.
/// @param c its cosine  @param s its sine
Quat turn_about_z(double c, double s);

/// A body's local point in the world [m].
Vec3 world_point(const Body& body, const Vec3& local);

}  // namespace substep::scenes
