#include "app/render/gl_objects.hpp"

#include "app/render/rounded_box.hpp"

namespace substep::gl {
namespace {

GLuint compile(GLenum kind, const std::string& source, std::string& error) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == 0) {
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    error += log.data();
  }
  return shader;
}

void bind(GLuint texture) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
}

/// In the bound texture, without repetition.
void interpolate_texels() {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

std::string renderer_name() {
  const GLubyte* name = glGetString(GL_RENDERER);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): characters
  return name != nullptr ? reinterpret_cast<const char*>(name) : "";
}

bool Program::build(const std::string& vertex, const std::string& fragment, std::string& error) {
  const GLuint v = compile(GL_VERTEX_SHADER, vertex, error);
  const GLuint f = compile(GL_FRAGMENT_SHADER, fragment, error);
  id_ = glCreateProgram();
  glAttachShader(id_, v);
  glAttachShader(id_, f);
  glLinkProgram(id_);
  glDeleteShader(v);
  glDeleteShader(f);
  GLint ok = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (ok == 0) {
    std::array<char, 1024> log{};
    glGetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    error += log.data();
  }
  return ok != 0;
}

void Program::set(const char* name, int value) const {
  glUniform1i(glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(glGetUniformLocation(id_, name), value);
}
void Program::set2(const char* name, float x, float y) const {
  glUniform2f(glGetUniformLocation(id_, name), x, y);
}
void Program::set3(const char* name, const float* xyz) const {
  glUniform3fv(glGetUniformLocation(id_, name), 1, xyz);
}
void Program::set4(const char* name, const float* xyzw) const {
  glUniform4fv(glGetUniformLocation(id_, name), 1, xyzw);
}
void Program::set_matrix(const char* name, const float* column_major) const {
  glUniformMatrix4fv(glGetUniformLocation(id_, name), 1, GL_FALSE, column_major);
}

void StreamBuffer::upload(const void* data, std::size_t bytes) const {
  bind();
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
}

BodyMesh::BodyMesh(int segments, bool flats) : rounded_(segments > 0) {
  const RoundedBoxMesh mesh = rounded_box(segments, flats || segments == 0);
  using Vertex = RoundedBoxMesh::Vertex;
  index_count_ = static_cast<int>(mesh.indices.size());
  const auto bytes = [](const auto& list) {
    return static_cast<GLsizeiptr>(list.size() * sizeof(list[0]));
  };
  glGenVertexArrays(1, &array_);
  glBindVertexArray(array_);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, bytes(mesh.vertices), mesh.vertices.data(), GL_STATIC_DRAW);
  glGenBuffers(1, &indices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(mesh.indices), mesh.indices.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), at(offsetof(Vertex, corner)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), at(offsetof(Vertex, normal)));
  instances_.bind();
  constexpr GLsizei kStride = sizeof(Instance);
  glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, position)));
  glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, orientation)));
  glVertexAttribPointer(4, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, half_extents)));
  glVertexAttribPointer(5, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, color)));
  for (GLuint i = 0; i < 6; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribDivisor(i, i < 2 ? 0 : 1);
  }
  glBindVertexArray(0);
}

BodyMesh::~BodyMesh() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
}

void BodyMesh::upload(const std::vector<Instance>& bodies) {
  count_ = static_cast<int>(bodies.size());
  if (count_ > 0) instances_.upload(bodies.data(), bodies.size() * sizeof(Instance));
}

void BodyMesh::draw(const Program& program) const {
  if (count_ == 0) return;
  program.set("rounded", rounded_ ? 1.0F : 0.0F);
  glBindVertexArray(array_);
  glDrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_SHORT, nullptr, count_);
}

ShadowMap::ShadowMap() {
  glGenTextures(1, &texture_);
  fit(1);
  interpolate_texels();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glGenFramebuffers(1, &frame_buffer_);
  bind_target();
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  constexpr GLenum kNone = GL_NONE;
  glDrawBuffers(1, &kNone);
  glReadBuffer(GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ShadowMap::fit(int size) {
  if (size == size_) return;
  size_ = size;
  bind_texture();
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
}

bool ShadowMap::complete() const {
  bind_target();
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return complete;
}

ShadowMap::~ShadowMap() {
  glDeleteFramebuffers(1, &frame_buffer_);
  glDeleteTextures(1, &texture_);
}

void ShadowMap::bind_texture() const { bind(texture_); }

void Canvas::fit(int width, int height, int samples) {
  if (width == width_ && height == height_ && samples == samples_) return;
  release();
  width_ = width;
  height_ = height;
  samples_ = samples;
  glGenFramebuffers(2, frame_buffers_.data());
  glGenRenderbuffers(2, buffers_.data());
  const auto attach = [&](std::size_t buffer, GLenum format, GLenum point) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_.at(buffer));
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
                                     height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffers_.at(buffer));
  };
  glBindFramebuffer(GL_FRAMEBUFFER, frame_buffers_[0]);
  attach(1, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  if (samples > 1) {
    attach(0, GL_RGBA8, GL_COLOR_ATTACHMENT0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_buffers_[1]);
  }
  glGenTextures(1, &texture_);
  bind_texture();
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  interpolate_texels();
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Canvas::release() {
  glDeleteFramebuffers(2, frame_buffers_.data());
  glDeleteRenderbuffers(2, buffers_.data());
  glDeleteTextures(1, &texture_);
  frame_buffers_ = {};
  buffers_ = {};
  texture_ = 0;
}

void Canvas::bind_texture() const { bind(texture_); }

void Canvas::resolve() const {
  if (samples_ > 1) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_buffers_[0]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame_buffers_[1]);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Fence::set() {
  glDeleteSync(sync_);
  sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

bool Fence::reached() const {
  GLint status = GL_UNSIGNALED;
  glGetSynciv(sync_, GL_SYNC_STATUS, 1, nullptr, &status);
  return status == GL_SIGNALED;
}

}  // namespace substep::gl
