#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/scene_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The shipped scenes: every *.json of one folder that reads without problems, in the order that
/// the picker shows them.
class Library {
 public:
  Library() = default;
  explicit Library(const std::string& folder);

  [[nodiscard]] const std::vector<std::shared_ptr<const Scene>>& scenes() const { return scenes_; }
  [[nodiscard]] std::shared_ptr<const Scene> find(std::string_view name) const;
  /// The shipped scene that a shipped scene is a variant of, by its name: heavy_stack of
  /// heavy_stack_tall. Null where it stands for itself.
  [[nodiscard]] const Scene* base_of(const Scene& scene) const;
  [[nodiscard]] std::vector<std::shared_ptr<const Scene>> variants_of(const Scene& base) const;
  /// Adds a scene that the program ships as code.
  void add_shipped(Scene scene);
  /// Adds a person's own scene, or puts it in the place of an older one of the same name. It comes
  /// into a group of its own, and where a shipped scene has its name, under another name.
  /// @return the scene as it is in the library
  std::shared_ptr<const Scene> add(const Scene& scene);

 private:
  void sort();
  std::vector<std::shared_ptr<const Scene>> scenes_;
};

/// Whether a scene of the library was added by the person.
bool is_own(const Scene& scene);
inline constexpr std::string_view kOwnGroup = "own";  // of their scenes

/// What the picker calls a group of scenes: "From the paper" for "paper".
std::string group_title(std::string_view group);

}  // namespace substep
