#pragma once
// A person's own scenes, from one visit to the next.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// The scenes that were opened last, newest first. Few and small ones: they live in a browser's
/// storage or in a file of settings.
class OwnScenes {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr std::size_t kMaxText = 300'000;  // of one scene [bytes]

  /// Puts a scene to the front, in place of an older one of its name.
  void add(const std::shared_ptr<const Scene>& scene);

  /// Whether a scene can be kept, as far as its numbers of bodies and joints tell: to write a large
  /// one takes long.
  static bool may_keep(const Scene& scene);

  /// As one text, and back. What cannot be read is left out: it was kept by an older version.
  [[nodiscard]] std::string text() const;
  static OwnScenes read(std::string_view text);

  [[nodiscard]] const std::vector<std::shared_ptr<const Scene>>& scenes() const { return scenes_; }

 private:
  std::vector<std::shared_ptr<const Scene>> scenes_;
  std::vector<std::string> texts_;  // of scenes_; empty where it is too long to keep
};

}  // namespace substep
