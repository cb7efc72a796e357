#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/model/problem.hpp"

namespace substep {

/// Services that a shell provides to the application. Each may be empty.
struct Host {
  std::function<void(const std::string& fragment)> link_changed;  // updates the address
  /// Copies the experiment's address to the clipboard. @param more further parts of the fragment,
  /// each after an '&'
  std::function<void(const std::string& more)> copy_link;
  std::function<void()> copy_embed;     // copies HTML that shows the page within another one
  std::function<void()> open_article;   // opens the article with two laboratories
  std::function<void()> open_link;      // opens the link on the clipboard
  std::function<void()> open_file;      // opens a file dialogue and loads the chosen scene
  std::function<void(bool on)> record;  // starts or stops a video of the window
  /// Saves a file: into the working folder natively, as a download in the page.
  std::function<void(const std::string& name, const std::string& bytes)> save_file;
  /// Stores a value for later visits; recall() returns "" if nothing was stored.
  std::function<void(const std::string& key, const std::string& value)> remember;
  std::function<std::string(const std::string& key)> recall;
  /// Asks for a value where the window gets no keyboard: on a touch screen. Returns `value` if the
  /// user cancels.
  std::function<std::string(const std::string& name, const std::string& value)> ask;
};

inline constexpr const char* kSceneKept = "The scene that runs was kept.";

/// A problem with external data; shown in a panel until it is closed.
struct Trouble {
  std::string title;  // "my_scene.json was not loaded"
  std::vector<Problem> problems;
  std::string aftermath = kSceneKept;  // the consequence; may be empty
};

/// A message that is shown briefly.
struct Notice {
  std::string text;
  double left = 0.0;  // remaining time [s]
};

}  // namespace substep
