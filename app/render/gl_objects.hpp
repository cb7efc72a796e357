#pragma once
// The few OpenGL objects that the renderer needs, each freed with its owner.

// <epoxy/gl.h> natively, <GLES3/gl3.h> on the web: the build says which.
#include SUBSTEP_GL_HEADER

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/render/picture.hpp"

namespace substep::gl {

/// Offset of a field, as glVertexAttribPointer takes it.
inline const void* at(std::size_t offset) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets as pointers
  return reinterpret_cast<const void*>(offset);
}

/// What draws, as the driver of the current context calls it.
std::string renderer_name();

/// A vertex and a fragment shader linked together.
class Program {
 public:
  Program() = default;
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  /// Compiles and links. @return false with the compiler's words added to `error`
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

/// A buffer that is rewritten every frame.
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

/// A mesh that is drawn once for each of its bodies.
class BodyMesh {
 public:
  /// @param segments as rounded_box() takes them
  /// @param flats false: for balls alone
  BodyMesh(int segments, bool flats);
  ~BodyMesh();
  BodyMesh(const BodyMesh&) = delete;
  BodyMesh& operator=(const BodyMesh&) = delete;

  /// The bodies that draw() draws from now on.
  void upload(const std::vector<Instance>& bodies);
  /// @param program of them; its `rounded` is set
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

/// A depth texture to draw the light's view into.
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

/// Where the picture is drawn before the panels come over it; it stays there for the next frame.
class Canvas {
 public:
  Canvas() = default;
  ~Canvas() { release(); }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Recreates it if its size differs. @param width, height [pixel]; @param samples per pixel
  void fit(int width, int height, int samples);
  /// To draw to.
  [[nodiscard]] unsigned frame_buffer() const { return frame_buffers_[0]; }
  /// Puts the samples together, once all is drawn, and goes back to the window's frame buffer.
  void resolve() const;
  /// Its colours, smoothly between its pixels; after resolve().
  void bind_texture() const;

 private:
  void release();
  [[nodiscard]] bool has_size(int width, int height) const {
    return width == width_ && height == height_;
  }

  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;
  std::array<GLuint, 2> frame_buffers_{};  // drawn to; of single samples, where there are more
  std::array<GLuint, 2> buffers_{};        // of many samples: colours; depth
  GLuint texture_ = 0;                     // of single samples: colours
};

/// Signals when the graphics have executed the calls before it.
class Fence {
 public:
  Fence() = default;
  ~Fence() { glDeleteSync(sync_); }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /// After the calls made so far, in place of where it was.
  void set();
  [[nodiscard]] bool reached() const;

 private:
  GLsync sync_ = nullptr;
};

}  // namespace substep::gl
