#pragma once
// The OpenGL objects of the renderer, each freed with its owner.

// <epoxy/gl.h> natively, <GLES3/gl3.h> on the web: chosen by the build.
#include SUBSTEP_GL_HEADER

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/render/picture.hpp"

namespace substep::gl {

/// Offset of a field, as a pointer for glVertexAttribPointer.
inline const void* at(std::size_t offset) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets as pointers
  return reinterpret_cast<const void*>(offset);
}

/// GL_RENDERER of the current context.
std::string renderer_name();

/// A vertex and a fragment shader linked together.
class Program {
 public:
  Program() = default;
  ~Program() { glDeleteProgram(id_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Compiles and links. @return false on error, with the compiler's log appended to `error`
  bool build(const std::string& vertex, const std::string& fragment, std::string& error);
  void use() const { glUseProgram(id_); }
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set2(const char* name, float x, float y) const;
  void set3(const char* name, const float* xyz) const;
  void set4(const char* name, const float* xyzw) const;
  void set_matrix(const char* name, const float* column_major) const;

 private:
  GLuint id_ = 0;
};

/// A vertex buffer that is rewritten every frame.
class StreamBuffer {
 public:
  StreamBuffer() { glGenBuffers(1, &id_); }
  ~StreamBuffer() { glDeleteBuffers(1, &id_); }
  StreamBuffer(const StreamBuffer&) = delete;
  StreamBuffer& operator=(const StreamBuffer&) = delete;

  void bind() const { glBindBuffer(GL_ARRAY_BUFFER, id_); }
  void upload(const void* data, std::size_t bytes) const;

 private:
  GLuint id_ = 0;
};

/// An instanced mesh of bodies.
class BodyMesh {
 public:
  /// @param segments see rounded_box()
  /// @param flats false: for balls only
  BodyMesh(int segments, bool flats);
  ~BodyMesh();
  BodyMesh(const BodyMesh&) = delete;
  BodyMesh& operator=(const BodyMesh&) = delete;

  /// Sets the bodies for draw().
  void upload(const std::vector<Instance>& bodies);
  /// @param program draws the bodies; its uniform `rounded` is set
  void draw(const Program& program) const;

 private:
  StreamBuffer instances_;
  GLuint array_ = 0;
  GLuint vertices_ = 0;
  GLuint indices_ = 0;
  int index_count_ = 0;
  int count_ = 0;  // of bodies
  bool rounded_;
};

/// A depth texture for the light's view.
class ShadowMap {
 public:
  ShadowMap();
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  /// Recreates it if its size differs. @param size of its edges [pixel]
  void fit(int size);
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool complete() const;
  void bind_target() const { glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer_); }
  void bind_texture() const;

 private:
  int size_ = 0;
  GLuint texture_ = 0;
  GLuint frame_buffer_ = 0;
};

/// The frame buffer of the picture, without the panels; its content persists to the next frame.
class Canvas {
 public:
  Canvas() = default;
  ~Canvas() { release(); }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Recreates it if its size differs. @param width, height [pixel]; @param samples per pixel
  void fit(int width, int height, int samples);
  /// The frame buffer to draw to.
  [[nodiscard]] unsigned frame_buffer() const { return frame_buffers_[0]; }
  /// Resolves multisampling after drawing, and binds the window's frame buffer.
  void resolve() const;
  /// Binds its colours with linear filtering; call after resolve().
  void bind_texture() const;

 private:
  void release();

  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;
  std::array<GLuint, 2> frame_buffers_{};  // drawn to; single-sampled, if the first is multisampled
  std::array<GLuint, 2> buffers_{};        // multisampled: colours; depth
  GLuint texture_ = 0;                     // single-sampled: colours
};

/// Signals when the GPU has executed the preceding calls.
class Fence {
 public:
  Fence() = default;
  ~Fence() { glDeleteSync(sync_); }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /// Inserts the fence after the calls made so far; replaces an earlier one.
  void set();
  [[nodiscard]] bool reached() const;

 private:
  GLsync sync_ = nullptr;
};

}  // namespace substep::gl
