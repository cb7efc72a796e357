#pragma once
// What failed in a run, and where, to point at it in the picture.

#include <optional>
#include <string>

#include "app/lab/session.hpp"

namespace substep {

/// The part of a scene that failed: a joint whose anchors came apart, or a body.
struct Failure {
  int joint = -1;            // index, or -1
  int body = -1;             // index, or -1
  Vec3 from = Vec3::Zero();  // the joint's anchor on b, or the body's centre; world [m]
  Vec3 to = Vec3::Zero();    // its anchor on a, or the same as from; world [m]
  double radius = 0.0;       // of the bodies concerned, largest [m]
  std::optional<Exceeded> exceeded;
  std::string name;  // of the joint or body

  [[nodiscard]] Vec3 centre() const { return 0.5 * (from + to); }
};

/// The failure of a run at the frame that failed; nothing if the run holds, or if nothing in
/// particular failed: too much energy.
/// @param poses, report of that frame
std::optional<Failure> failure_of(const Scene& scene, const Poses& poses, const FrameReport& report,
                                  const Verdict& verdict);

}  // namespace substep
