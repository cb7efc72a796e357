#pragma once

#include <filesystem>
#include <string>

#include "app/app.hpp"

namespace substep {

/// What the application asks of its window: files in the working folder, settings kept in the
/// person's configuration folder, videos as numbered pictures. Where something cannot be written
/// the application says so and goes on.
class NativeHost {
 public:
  /// Serves the application, which must not outlive this.
  explicit NativeHost(App& app);
  /// After each frame on the screen, while its pixels are there to be read.
  /// @param width, height of the frame buffer [pixel]
  void after_frame(int width, int height);

 private:
  void save(const std::string& name, const std::string& bytes);
  void record(bool on);
  void copy_link();
  void open_link();

  App& app_;
  std::filesystem::path folder_;    // that scene files were looked for in last
  std::filesystem::path pictures_;  // folder of the video
  int count_ = 0;                   // pictures of the video
};

/// What the window shows, as a PNG file. @param width, height of the frame buffer [pixel]
std::string picture_of(App& app, int width, int height);

/// Writes through a file beside it, so that a crash leaves the old file or the new one.
/// @return whether it could
bool write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace substep
