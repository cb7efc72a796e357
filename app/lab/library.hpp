#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/scene_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The shipped scenes: every *.json of one folder that reads without problems, in menu order.
class Library {
 public:
  Library() = default;
  explicit Library(const std::string& folder);

  [[nodiscard]] const std::vector<std::shared_ptr<const Scene>>& scenes() const { return scenes_; }
  [[nodiscard]] std::shared_ptr<const Scene> find(std::string_view name) const;
  /// The base scene of a shipped variant, by name: heavy_stack for heavy_stack_tall. Null if the
  /// scene is not a variant.
  [[nodiscard]] const Scene* base_of(const Scene& scene) const;
  [[nodiscard]] std::vector<std::shared_ptr<const Scene>> variants_of(const Scene& base) const;
  /// Adds a scene defined in code.
  void add_shipped(Scene scene);
  /// Adds a user's scene to its own group, or replaces an earlier one of the same name. It is
  /// renamed if a shipped scene has its name.
  /// @return the scene in the library
  std::shared_ptr<const Scene> add(const Scene& scene);
  /// Removes a user's scene, if there is one of this name.
  void remove_own(const std::string& name);

 private:
  void sort();
  std::vector<std::shared_ptr<const Scene>> scenes_;
};

/// Whether the user added the scene.
bool is_own(const Scene& scene);
inline constexpr std::string_view kOwnGroup = "own";  // of the user's scenes

/// The menu heading of a group: "From the paper" for "paper".
std::string group_title(std::string_view group);

}  // namespace substep
