#include "app/lab/exam_ghost.hpp"

#include <algorithm>
#include <utility>

#include "scenes/generator/exam.hpp"

namespace substep {
namespace {

constexpr std::string_view kGroup = "exam";

bool same_bodies(const Scene& a, const Scene& b) {
  return std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(),
                    [](const Body& x, const Body& y) {
                      return x.mass == y.mass && x.position == y.position &&
                             x.velocity == y.velocity;
                    });
}

/// The exact motion of a scene, if it has one. Another load or seed has another motion.
std::function<ExamMotion()> motion_of(const Scene& scene) {
  if (scene.group != kGroup) return {};
  for (const ExamEntry& entry : scenes::exam()) {
    if ("exam_" + entry.name != scene.name) continue;
    ExamCase exam = entry.build();
    if (same_bodies(exam.scene, scene) && exam.scene.effects == scene.effects) return exam.motion;
  }
  return {};
}

}  // namespace

void add_exam(Library& library) {
  for (const ExamEntry& entry : scenes::exam()) {
    const ExamCase exam = entry.build();
    Scene scene = exam.scene;
    if (exam.motion) scene.look_for += "; the transparent bodies follow it";
    scene.look_for += ".";
    // The exam's frames are as long as the row spacing of its tables, too long for display.
    scene.frame = std::min(scene.frame, 1.0 / 60.0);
    scene.settings = Settings{};
    scene.settings.mode = Mode::kConst;
    scene.settings.integrator = Integrator::kLeapfrog;
    library.add_shipped(std::move(scene));
  }
}

const Poses* ExamGhost::at(const Session& session) {
  if (session.shared_scene() != scene_) {
    scene_ = session.shared_scene();
    start_ = motion_of(*scene_);
    motion_ = nullptr;
  }
  if (!start_) return nullptr;
  const double frame = scene_->frame;
  const double t = std::max(0.0, session.state().time - (1.0 - session.between()) * frame);
  if (!motion_ || t < t_) {  // motions only run forwards
    motion_ = start_();
    poses_ = {{}, {}};
    for (const Body& body : scene_->bodies) {
      poses_.x.push_back(body.position);
      poses_.q.push_back(body.orientation);
    }
  }
  motion_(t, poses_.x, poses_.q);
  t_ = t;
  return &poses_;
}

}  // namespace substep
