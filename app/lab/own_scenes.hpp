#pragma once
// The user's own scenes, kept between visits.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"

namespace substep {

/// The scenes opened most recently, newest first. Few and small: they are stored in a browser's
/// storage or a settings file.
class OwnScenes {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr std::size_t kMaxText = 300'000;  // of one scene [bytes]

  /// Moves a scene to the front; replaces an older one of its name.
  void add(const std::shared_ptr<const Scene>& scene);
  void remove(const std::string& name);

  /// Whether a scene is small enough to store, by its numbers of bodies and joints; serialising a
  /// large one is slow.
  static bool may_keep(const Scene& scene);

  /// Serialised as one text. Scenes that cannot be read, from an older version, are skipped.
  [[nodiscard]] std::string text() const;
  static OwnScenes read(std::string_view text);

  [[nodiscard]] const std::vector<std::shared_ptr<const Scene>>& scenes() const { return scenes_; }

 private:
  std::vector<std::shared_ptr<const Scene>> scenes_;
};

}  // namespace substep
