#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "app/render/cover.hpp"
#include "app/render/gl_objects.hpp"
#include "app/render/picture.hpp"
#include "app/render/renderer.hpp"

namespace substep {

/// What a quality is made of.
struct Grain {
  double scale;     // of the window's width and height [-]
  int samples;      // per pixel
  int shadow_size;  // [texel]
  float taps;       // of the shadow map per pixel
};
Grain grain_of(Quality quality);

/// Where pictures are drawn, all of it.
struct Target {
  GLuint frame_buffer = 0;  // with a depth buffer
  int width = 0;            // [pixel]
  int height = 0;
};

/// Draws pictures, in the OpenGL context in which it was made.
class PicturePainter {
 public:
  /// Before anything else. @return false with the reason added to `error`
  bool build(std::string& error);
  ~PicturePainter();
  PicturePainter() = default;
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  /// Each picture in its part of the target.
  /// @param hidden parts of the target that are not shaded, from its top left corner
  void paint(std::span<const Picture> pictures, Quality quality, const Target& target,
             std::span<const PixelRect> hidden);

 private:
  // What bodies are made of.
  struct Meshes {
    Meshes(int box_segments, const gl::StreamBuffer& boxes, int ball_segments,
           const gl::StreamBuffer& balls)
        : rounded(box_segments > 0 ? 1.0F : 0.0F),
          box(box_segments, true, boxes),
          ball(ball_segments, false, balls) {}
    float rounded;  // the edges of boxes, 0: not
    gl::RoundedBox box;
    gl::RoundedBox ball;
  };

  // World to the light's clip space: a box around the focus, seen from far along the light.
  [[nodiscard]] Eigen::Matrix4f light_matrix(const Picture& picture) const;
  void draw_picture(const Picture& picture, const Target& target,
                    std::span<const PixelRect> hidden);
  void draw_background(const Picture& picture);
  void draw_shadows(const Picture& picture, const Eigen::Matrix4f& light);
  void draw_bodies(const Picture& picture, const Eigen::Matrix4f& light);
  void draw_ghosts(const Picture& picture);
  static void draw_meshes(const Meshes& meshes, const gl::Program& program,
                          const std::vector<Instance>& boxes, const std::vector<Instance>& balls);
  void draw_ground(const Picture& picture, const Eigen::Matrix4f& light);
  void draw_ribbons(const Picture& picture);

  gl::StreamBuffer box_instances_;
  gl::StreamBuffer ball_instances_;
  gl::StreamBuffer ribbon_vertices_;
  Meshes fine_{3, box_instances_, 8, ball_instances_};
  Meshes coarse_{1, box_instances_, 3, ball_instances_};
  Meshes sketch_{0, box_instances_, 2, ball_instances_};
  const Meshes* meshes_ = &fine_;
  const Meshes* shadow_meshes_ = &fine_;
  gl::ShadowMap shadow_map_;
  gl::Program background_;
  gl::Program body_;
  gl::Program shadow_;
  gl::Program ground_;
  gl::Program ribbon_;
  GLuint empty_array_ = 0;
  GLuint ribbon_array_ = 0;
  float shadow_taps_ = 4.0F;
};

}  // namespace substep
