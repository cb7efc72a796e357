#pragma once

#include <array>
#include <deque>
#include <string_view>

#include "app/lab/session.hpp"
#include "app/render/camera.hpp"
#include "app/render/picture.hpp"

namespace substep {

/// Optional parts of the picture.
struct ViewOptions {
  bool tint = true;       // tint bodies by k/M
  bool joints = true;     // pins of joints
  bool trail = true;      // path of the tracked body
  bool labels = true;     // masses
  bool forces = false;    // of joints and contacts
  bool contacts = false;  // points and normals
  bool frames = false;    // of joints
  bool errors = false;    // gaps of joints, exaggerated
  bool axes = false;      // of bodies
};

/// Names of the options in links and scripts.
struct ViewSwitch {
  std::string_view key;
  bool ViewOptions::*member;
};
inline constexpr std::array<ViewSwitch, 9> kViewSwitches{{{"tint", &ViewOptions::tint},
                                                          {"joints", &ViewOptions::joints},
                                                          {"trail", &ViewOptions::trail},
                                                          {"masses", &ViewOptions::labels},
                                                          {"forces", &ViewOptions::forces},
                                                          {"contacts", &ViewOptions::contacts},
                                                          {"frames", &ViewOptions::frames},
                                                          {"errors", &ViewOptions::errors},
                                                          {"axes", &ViewOptions::axes}}};

/// Colours and light of the view.
struct ViewPalette : Surroundings {
  Color body;
  Color fixture;  // static bodies
  Color joint;
  Color trail;
  Color stiff_low;   // tint of k/M = 0
  Color stiff_mid;   // tint of half of the largest k/M
  Color stiff_high;  // tint of the body that sets N
};

/// A run to draw: its scene and poses, and the state for the tint.
struct Seen {
  const Scene* scene = nullptr;
  const Poses* poses = nullptr;
  const State* state = nullptr;             // with K, for the tint; null: no tint
  const std::deque<Vec3>* trail = nullptr;  // null: none
};

/// The view of a session: owns the camera and builds the picture.
class SceneView {
 public:
  OrbitCamera camera;

  /// Resets the camera for a new scene, and follows a motion that leaves its picture.
  /// @param keep leaves the camera where it is for a new scene, as after an edit of its text
  void follow(const Session& session, bool keep = false);
  /// Places the camera for a scene. @param poses its start
  void place(const Scene& scene, const Poses& poses);
  void frame_all(const Session& session);
  /// A sphere around a part of the scene at least this large, with some of what is around it.
  [[nodiscard]] Bounds bounds_around(const Vec3& centre, double radius) const;
  /// @param view the rectangle of the run in the window
  void build(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
             const ViewRect& view, double window_width, double window_height, Picture& out) const;
  /// Adds the bodies of another run to the picture, in one translucent colour.
  static void add_ghost(const Scene& scene, const Poses& poses, const Color& color, Picture& out);

 private:
  void note_start(const Scene& scene, const Poses& poses);
  void follow_motion(const Session& session);
  static void add_bodies(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
                         Picture& out);
  void add_joints(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
                  Picture& out) const;
  static void add_trail(const std::deque<Vec3>& trail, const Color& color, const Vec3& eye,
                        double pixel, Picture& out);
  void place_ground(const Scene& scene, Picture& out) const;
  [[nodiscard]] Bounds bounds(const Scene& scene, const Poses& poses) const;

  Bounds home_;                  // of the scene at its start
  double half_width_ = 0.0;      // that the camera of the scene shows at its target [m]
  Vec3 start_ = Vec3::Zero();    // of what the camera follows, from the target of the camera [m]
  Vec3 carried_ = Vec3::Zero();  // how far the camera follows the motion [m]
  double lowest_ = 0.0;          // of the bodies at the start [m]
  int generation_ = -1;
};

}  // namespace substep
