// The application in a native window.

#include <epoxy/gl.h>
// GLFW must not include another OpenGL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/app.hpp"
#include "app/cli/within.hpp"
#include "app/native/host.hpp"
#include "app/render/gl_renderer.hpp"
#include "app/shell/arrangement.hpp"
#include "app/ui/context.hpp"
#include "core/model/setting_fields.hpp"
#include "core/model/text_checks.hpp"

namespace substep {
namespace {

struct Options {
  std::string scene;
  std::string scenes = SUBSTEP_SCENES_DIR;
  std::vector<std::string> settings;  // "alpha=0.2"
  std::string open;                   // a scene file, opened as if dropped on the window
  std::string link;                   // the fragment of a link, from '#'
  std::string screenshot;
  int frames = 60;
  int width = 1280;
  int height = 800;
  double scale = 0.0;  // 0: the display's
  bool light = false;
  bool bare = false;
};

struct Window {
  GLFWwindow* handle = nullptr;
  App* app = nullptr;
  double scale = 0.0;
};

Window& window_of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

// Frame buffer pixels per logical pixel.
double pixel_ratio(const Window& window) {
  if (window.scale > 0.0) return window.scale;
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window.handle, &x, &y);
  return std::max(1.0, static_cast<double>(x));
}

// Window coordinates, GLFW's unit of the pointer, per logical pixel.
double window_ratio(const Window& window) {
  int window_width = 0;
  int buffer_width = 0;
  int height = 0;
  glfwGetWindowSize(window.handle, &window_width, &height);
  glfwGetFramebufferSize(window.handle, &buffer_width, &height);
  if (buffer_width == 0) return 1.0;
  return pixel_ratio(window) * window_width / buffer_width;
}

void drop_files(GLFWwindow* handle, int count, const char** paths) {
  if (count < 1) return;
  window_of(handle).app->open_file(paths[0]);
}

void listen(GLFWwindow* handle) {
  glfwSetWindowFocusCallback(handle, ImGui_ImplGlfw_WindowFocusCallback);
  glfwSetCursorEnterCallback(handle, ImGui_ImplGlfw_CursorEnterCallback);
  glfwSetCursorPosCallback(handle, [](GLFWwindow* w, double x, double y) {
    const double ratio = window_ratio(window_of(w));
    ImGui_ImplGlfw_CursorPosCallback(w, x / ratio, y / ratio);
  });
  glfwSetMouseButtonCallback(handle, ImGui_ImplGlfw_MouseButtonCallback);
  glfwSetScrollCallback(handle, ImGui_ImplGlfw_ScrollCallback);
  glfwSetKeyCallback(handle, ImGui_ImplGlfw_KeyCallback);
  glfwSetCharCallback(handle, ImGui_ImplGlfw_CharCallback);
  glfwSetDropCallback(handle, drop_files);
}

// Applies the command line. @return error message, or ""
std::string apply(const Options& options, App& app) {
  app.desk.dark = !options.light;  // a link may choose another theme
  app.desk.panels = !options.bare;
  if (!options.scene.empty() && !app.open(options.scene)) {
    SceneResult result = read_scene_file(options.scene);
    if (!result.scene) {
      std::string all;
      for (const Problem& problem : result.problems) all.append(to_string(problem)).append("\n");
      return options.scene + ":\n" + all;
    }
    app.run(result.scene);
  }
  for (const std::string& pair : options.settings) {
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string key = pair.substr(0, equals);
    const std::string value = pair.substr(std::min(equals + 1, pair.size()));
    const std::string problem = app.set(key, value);
    if (!problem.empty()) return key + ": " + problem + "\n";
  }
  if (!options.open.empty()) app.open_file(options.open);
  if (!options.link.empty()) app.open_link(options.link);
  if (!app.held()) app.session.play();
  const bool plain = options.scene.empty() && options.settings.empty() && options.open.empty() &&
                     options.link.empty() && !options.bare;
  if (plain) app.introduction.offer(app);
  return "";
}

int run(const Options& options) {
  glfwSetErrorCallback([](int, const char* text) { std::fprintf(stderr, "GLFW: %s\n", text); });
  if (glfwInit() == GLFW_FALSE) {
    std::fputs("substep: no display to open a window on\n", stderr);
    return 2;
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, options.screenshot.empty() ? GLFW_TRUE : GLFW_FALSE);
  Window window;
  window.scale = options.scale;
  const double size_scale = std::max(1.0, options.scale);
  window.handle =
      glfwCreateWindow(static_cast<int>(options.width * size_scale),
                       static_cast<int>(options.height * size_scale), "substep", nullptr, nullptr);
  if (window.handle == nullptr) {
    std::fputs("substep: no window with OpenGL 3.3 could be opened\n", stderr);
    glfwTerminate();
    return 2;
  }
  glfwSetWindowUserPointer(window.handle, &window);
  glfwMakeContextCurrent(window.handle);
  glfwSwapInterval(options.screenshot.empty() ? 1 : 0);

  int status = 0;
  {
    const ui::Context context;
    ImGui_ImplGlfw_InitForOpenGL(window.handle, false);
    std::string error;
    auto renderer = make_gl_renderer(error);
    Library library(options.scenes);
    if (!library.scenes().empty()) add_exam(library);
    if (!renderer || library.scenes().empty()) {
      std::fprintf(
          stderr, "substep: %s\n",
          renderer ? visible_text("no scenes in " + options.scenes).c_str() : error.c_str());
      renderer.reset();  // while its context exists
      ImGui_ImplGlfw_Shutdown();
      glfwTerminate();
      return 2;
    }
    App app(std::move(library), std::move(renderer));
    window.app = &app;
    NativeHost host(app);
    // Pictures for tests and pages do not depend on earlier visits.
    if (!options.screenshot.empty()) app.host.remember = nullptr, app.host.recall = nullptr;
    app.recall_scenes();
    recall_arrangement(app);
    listen(window.handle);
    const std::string problem = apply(options, app);
    if (!problem.empty()) {
      std::fprintf(stderr, "substep: %s", visible_lines(problem).c_str());
      status = 2;
    }

    double before = glfwGetTime();
    for (int i = 0; status == 0 && glfwWindowShouldClose(window.handle) == GLFW_FALSE; ++i) {
      glfwPollEvents();
      ImGui_ImplGlfw_NewFrame();
      int width = 0;
      int height = 0;
      glfwGetFramebufferSize(window.handle, &width, &height);
      if (width == 0 || height == 0) {  // minimised
        glfwWaitEventsTimeout(0.1);
        continue;
      }
      const auto ratio = static_cast<float>(pixel_ratio(window));
      ImGuiIO& io = ImGui::GetIO();
      io.DisplaySize = {static_cast<float>(width) / ratio, static_cast<float>(height) / ratio};
      io.DisplayFramebufferScale = {ratio, ratio};
      const double now = glfwGetTime();
      // Pictures for tests and pages are of a moment that does not depend on the machine.
      const bool by_clock = options.screenshot.empty() && !app.desk.recording;
      const double dt = by_clock ? now - before : 1.0 / 60.0;
      before = now;
      frame(app, dt);
      host.after_frame(width, height);
      if (!options.screenshot.empty() && i + 1 >= options.frames) {
        if (!write_file(options.screenshot, picture_of(app, width, height))) {
          std::fprintf(stderr, "substep: %s could not be written\n",
                       visible_text(options.screenshot).c_str());
          status = 2;
        }
        break;
      }
      glfwSwapBuffers(window.handle);
    }
    app.renderer.reset();
    ImGui_ImplGlfw_Shutdown();
  }
  glfwDestroyWindow(window.handle);
  glfwTerminate();
  return status;
}

int start(int argc, char** argv) {
  Options options;
  CLI::App cli{"substep: a laboratory for stable constrained rigid bodies"};
  cli.add_option("--scene", options.scene, "name of a shipped scene, or a scene file");
  cli.add_option("--scenes", options.scenes, "folder of the shipped scenes")->capture_default_str();
  cli.add_option("--open", options.open, "a scene file; its errors are shown in a panel");
  cli.add_option("--link", options.link, "the experiment of a link: the part after #");
  cli.add_option("--set", options.settings, "a setting, for example --set alpha=0.2");
  for (const SettingField& field : setting_fields()) {
    std::string flag(field.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    const std::string key(field.name);
    cli.add_option_function<std::string>(
        "--" + flag,
        [key, &options](const std::string& v) {
          std::string pair = key;
          pair.append("=").append(v);
          options.settings.push_back(std::move(pair));
        },
        std::string(field.help));
  }
  cli.add_flag("--light", options.light, "start in the light theme");
  cli.add_flag("--bare", options.bare, "start with the panels hidden");
  cli.add_option("--screenshot", options.screenshot, "write a PNG after --frames frames and exit");
  cli.add_option("--frames", options.frames, "frames before the screenshot")
      ->check(cli::whole(1, 100000));
  std::string size = "1280x800";
  cli.add_option("--size", size, "of the window, WxH in logical pixels");
  cli.add_option("--scale", options.scale, "pixels per logical pixel")
      ->check(cli::within(0.5, 4.0));
  CLI11_PARSE(cli, argc, argv);
  if (std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
      options.width < 200 || options.height < 200 || options.width > 8192 ||
      options.height > 8192) {
    std::fprintf(stderr, "substep: --size: must be WxH, each from 200 to 8192, not %s\n",
                 visible_text(size).c_str());
    return 2;
  }
  return run(options);
}

}  // namespace
}  // namespace substep

int main(int argc, char** argv) {
  try {
    return substep::start(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "substep: %s\n", error.what());
    return 3;
  }
}
