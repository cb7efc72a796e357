#include "app/native/host.hpp"

#include <imgui.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "app/render/png.hpp"

namespace substep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "scene_folder";  // the last folder of scene files

// An unused path in the working folder: bridge.png, bridge-2.png, ...
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

// The settings folder by the XDG rules; empty without a home.
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
  write_file(folder / key, value);  // a failure is ignored: the value is optional
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
  app.host.copy_link = [this](const std::string& more) { copy_link(more); };
  app.host.open_link = [this] { open_link(); };
  app.host.open_file = [this] {
    const std::string last = recall(kFolder);
    app_.browser.show(last.empty() ? fs::path(".") : fs::path(last));
    if (!app_.browser.problem().empty()) app_.browser.show(".");
  };
  app.host.remember = remember;
  app.host.recall = recall;
}

void NativeHost::save(const std::string& name, const std::string& bytes) {
  const fs::path path = free_path(name);
  app_.tell(path.string() + (write_file(path, bytes) ? " was written" : " could not be written"));
}

// The URL of the page, if the build defines it by CMake's SUBSTEP_PAGE_URL. Without it the link is
// only the fragment, to be appended to the address of any copy of the page.
void NativeHost::copy_link(const std::string& more) {
  const std::string page = SUBSTEP_PAGE_URL;
  ImGui::SetClipboardText((page + "#" + app_.link() + more).c_str());
  std::string said = "Link copied";
  if (is_own(app_.link_scene())) {
    said += ": it only names this scene, so send its file as well";
  } else if (page.empty()) {
    said += ": append it to the page's address, or open it here";
  }
  app_.tell(said);
}

void NativeHost::open_link() {
  const char* text = ImGui::GetClipboardText();
  const std::string link = text != nullptr ? text : "";
  const std::size_t mark = link.find('#');
  const std::string fragment = link.substr(mark == std::string::npos ? 0 : mark + 1);
  if (!fragment.starts_with("scene=")) {
    app_.tell("The clipboard has no link to an experiment");
    return;
  }
  app_.open_link(fragment);
  if (!app_.held()) app_.session.play();
}

void NativeHost::record(bool on) {
  if (on) {
    pictures_ = free_path(app_.session.scene().name + "_video");
    count_ = 0;
    std::error_code error;
    app_.desk.recording = fs::create_directory(pictures_, error);
    if (!app_.desk.recording) app_.tell(pictures_.string() + " could not be made");
  } else {
    app_.desk.recording = false;
    app_.tell(std::to_string(count_) + " pictures, 60 per second, are in " + pictures_.string());
  }
}

void NativeHost::after_frame(int width, int height) {
  if (app_.browser.folder() != folder_) {
    folder_ = app_.browser.folder();
    if (app_.host.remember) app_.host.remember(kFolder, folder_.string());
  }
  if (!app_.desk.recording) return;
  char name[32];
  std::snprintf(name, sizeof name, "%05d.png", count_ + 1);
  if (write_file(pictures_ / name, picture_of(app_, width, height))) {
    ++count_;
  } else {  // the disk is full
    record(false);
  }
}

}  // namespace substep
