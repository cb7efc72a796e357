#include "app/native/host.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "app/png.hpp"

namespace substep {
namespace {

namespace fs = std::filesystem;

// A path in the working folder that is not taken: bridge.png, bridge-2.png, ...
fs::path free_path(const std::string& name) {
  std::error_code error;
  const fs::path wanted(name);
  fs::path path = fs::current_path(error) / wanted;
  for (int i = 2; fs::exists(path, error); ++i) {
    std::string numbered = wanted.stem().string();
    numbered.append("-").append(std::to_string(i)).append(wanted.extension().string());
    path.replace_filename(numbered);
  }
  return path;
}

// Folder of the settings by the XDG rules, or empty where there is no home.
fs::path config_folder() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return fs::path(config) / "substep";
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / ".config" / "substep" : fs::path();
}

void remember(const std::string& key, const std::string& value) {
  const fs::path folder = config_folder();
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  write_file(folder / key, value);  // where it cannot be written it is not kept: nothing needs it
}

std::string recall(const std::string& key) {
  std::ifstream file(config_folder() / key, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

bool write_file(const fs::path& path, const std::string& bytes) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {  // /dev/null, a pipe
    std::ofstream file(path, std::ios::binary);
    return (file << bytes).flush().good();
  }
  const fs::path scratch = path.string() + ".new";
  std::ofstream file(scratch, std::ios::binary);
  file << bytes;
  file.close();
  if (file.good()) fs::rename(scratch, path, error);
  if (file.good() && !error) return true;
  fs::remove(scratch, error);
  return false;
}

std::string picture_of(App& app, int width, int height) {
  return encode_png(width, height, app.renderer->pixels(0, 0, width, height));
}

NativeHost::NativeHost(App& app) : app_(app) {
  app.host.save_file = [this](const std::string& name, const std::string& bytes) {
    save(name, bytes);
  };
  app.host.record = [this](bool on) { record(on); };
  app.host.remember = remember;
  app.host.recall = recall;
}

void NativeHost::save(const std::string& name, const std::string& bytes) {
  const fs::path path = free_path(name);
  app_.tell(path.string() + (write_file(path, bytes) ? " was written" : " could not be written"));
}

void NativeHost::record(bool on) {
  if (on) {
    pictures_ = free_path(app_.session.scene().name + "_video");
    count_ = 0;
    std::error_code error;
    app_.recording = fs::create_directory(pictures_, error);
    if (!app_.recording) app_.tell(pictures_.string() + " could not be made");
  } else {
    app_.recording = false;
    app_.tell(std::to_string(count_) + " pictures, 60 a second, are in " + pictures_.string());
  }
}

void NativeHost::after_frame(int width, int height) {
  if (!app_.recording) return;
  char name[32];
  std::snprintf(name, sizeof name, "%05d.png", count_ + 1);
  if (write_file(pictures_ / name, picture_of(app_, width, height))) {
    ++count_;
  } else {  // the disk is full
    record(false);
  }
}

}  // namespace substep
