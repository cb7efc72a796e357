#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/model/problem.hpp"

namespace substep {

/// What a shell can do for the application. Each may be empty.
struct Host {
  std::function<void(const std::string& fragment)> link_changed;  // keeps the address up to date
  std::function<void()> copy_link;  // puts the address that holds the experiment on the clipboard
  std::function<void()> open_link;  // follows the link on the clipboard
  std::function<void()> open_file;  // opens a dialogue for a scene file, and loads it
  std::function<void(bool on)> record;  // begins and ends a video of the window
  /// Hands a file to the person: into the working folder natively, a download in the page.
  std::function<void(const std::string& name, const std::string& bytes)> save_file;
  /// Keeps how the window is arranged from one visit to the next; "" where nothing was kept.
  std::function<void(const std::string& key, const std::string& value)> remember;
  std::function<std::string(const std::string& key)> recall;
};

inline constexpr const char* kSceneKept = "The scene that runs was kept.";

/// What went wrong with outside data: shown in a panel until it is closed.
struct Trouble {
  std::string title;  // "my_scene.json was not loaded"
  std::vector<Problem> problems;
  std::string aftermath = kSceneKept;  // what was done all the same; may be empty
};

/// A sentence that is shown for a moment.
struct Notice {
  std::string text;
  double left = 0.0;  // [s]
};

}  // namespace substep
