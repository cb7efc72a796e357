#pragma once
// The content of a picture as plain values: built from a scene and its state, drawn by a Renderer.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace substep {

/// sRGB colour and coverage, each 0..1.
struct Color {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;

  bool operator==(const Color&) const = default;
};

/// One box or ball: sixteen floats, in the layout of the vertex attributes.
struct Instance {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // [m]
  float rounding = 0.0F;                               // radius of a box's edges [m]
  std::array<float, 4> orientation{};                  // quaternion x y z w
  Eigen::Vector3f half_extents =
      Eigen::Vector3f::Zero();  // of a box; of a ball the radius, three times [m]
  float pattern = 0.0F;         // 1: quartered, so that rotation is visible
  Color color;

  bool operator==(const Instance&) const = default;
};

/// One corner of a ribbon that faces the camera.
struct RibbonVertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Color color;

  bool operator==(const RibbonVertex&) const = default;
};

/// A part of the window, as fractions of its width and height from the top left corner.
struct Part {
  float x = 0.0F;
  float y = 0.0F;
  float width = 1.0F;
  float height = 1.0F;

  bool operator==(const Part&) const = default;
};

/// A soft-edged rectangle or disc of darkness on the floor, in the layout of the vertex attributes.
struct SoftShadow {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // on the floor [m]
  float strength = 0.0F;                             // at the centre of a wide one, 0..1
  Eigen::Vector3f along = Eigen::Vector3f::Zero();   // unit, in the floor
  float round = 0.0F;                                // 1: a disc
  float half_u = 0.0F;                               // half extents, to half of the strength [m]
  float half_v = 0.0F;
  float softness = 0.0F;  // half width of the edge [m]
  float padding = 0.0F;

  bool operator==(const SoftShadow&) const = default;
};

/// An infinite floor: a grid that fades with distance, and the shadows on it.
struct Ground {
  bool solid = false;  // a plane of the scene: matte; else only the grid is drawn
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  // [m]
  Eigen::Vector3f normal = Eigen::Vector3f::UnitY();
  Eigen::Vector3f along = Eigen::Vector3f::UnitX();  // one of the grid's directions
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // of the visible part [m]
  float cell = 1.0F;                                 // [m]
  float fade = 30.0F;  // distance from the centre at which it is invisible [m]
  float reach = 1.0F;  // height up to which it darkens bodies [m]

  bool operator==(const Ground&) const = default;
};

/// Colours and light around the bodies.
struct Surroundings {
  Color background_top;
  Color background_bottom;
  Color grid;
  Color floor;           // matte floor; alpha is its coverage at the centre
  Color shade;           // of shadows on it
  float ambient = 0.5F;  // ambient light, 0..1
  float shadow = 0.5F;   // darkness of the light's shadows, 0..1
  float contact = 0.5F;  // darkness of the ambient shadow under bodies, 0..1

  bool operator==(const Surroundings&) const = default;
};

struct Picture : Surroundings {
  Part part;  // of the window; the projection is for the whole window
  Eigen::Matrix4f view_projection = Eigen::Matrix4f::Identity();
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();
  Eigen::Vector3f focus = Eigen::Vector3f::Zero();  // centre of the sharpest shadows [m]
  float focus_radius = 10.0F;                       // [m]
  Eigen::Vector3f to_light{0.4F, 0.9F, 0.3F};       // unit
  std::vector<Instance> boxes;
  std::vector<Instance> balls;
  std::vector<Instance> ghost_boxes;  // translucent, without shadows
  std::vector<Instance> ghost_balls;
  std::vector<RibbonVertex> ribbons;  // triangles
  std::vector<SoftShadow> contacts;   // on the floor
  Ground ground;

  bool operator==(const Picture&) const = default;
};

}  // namespace substep
