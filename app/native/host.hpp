#pragma once

#include <filesystem>
#include <string>

#include "app/app.hpp"

namespace substep {

/// Services for the application's window: files in the working folder, settings in the user's
/// configuration folder, videos as numbered pictures. Write errors are reported and not fatal.
class NativeHost {
 public:
  /// Sets app's host functions; the application must not outlive this object.
  explicit NativeHost(App& app);
  /// Call after each drawn frame, before its pixels are replaced.
  /// @param width, height of the frame buffer [pixel]
  void after_frame(int width, int height);

 private:
  void save(const std::string& name, const std::string& bytes);
  void record(bool on);
  void copy_link(const std::string& more);
  void open_link();

  App& app_;
  std::filesystem::path folder_;    // last folder of scene files
  std::filesystem::path pictures_;  // folder of the video
  int count_ = 0;                   // pictures of the video
};

/// The window's content as a PNG file. @param width, height of the frame buffer [pixel]
std::string picture_of(App& app, int width, int height);

/// Writes via a temporary file, so that a crash leaves either the old file or the new one.
/// @return whether it succeeded
bool write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace substep
