#include "app/lab/library.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>
#include <utility>

namespace substep {
namespace {

struct Group {
  std::string_view name;
  std::string_view title;
};
constexpr std::array<Group, 8> kGroups{{{kOwnGroup, "Your own"},
                                        {"paper", "From the paper"},
                                        {"authors", "The authors' constants"},
                                        {"stress", "Stress"},
                                        {"energy", "Energy of adaptive steps"},
                                        {"exact", "Exact solutions"},
                                        {"exam", "Benchmarks with known solutions"},
                                        {"playground", "Playground"}}};
// First in their groups; the others are sorted by title.
constexpr std::array<std::string_view, 3> kFirst{"swinging_box", "bridge", "heavy_stack"};

std::size_t group_rank(std::string_view group) {
  const auto found =
      std::find_if(kGroups.begin(), kGroups.end(), [&](const Group& g) { return g.name == group; });
  return static_cast<std::size_t>(found - kGroups.begin());
}

auto rank(const Scene& scene) {
  const auto first = std::find(kFirst.begin(), kFirst.end(), scene.name) - kFirst.begin();
  return std::tuple(group_rank(scene.group), scene.group, first, scene.title, scene.name);
}

}  // namespace

Library::Library(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path& path = entry.path();
    // scene.schema.json is in the same folder.
    if (path.extension() != ".json" || path.stem().extension() == ".schema") continue;
    SceneResult result = read_scene_file(path.string());
    if (result.scene) scenes_.push_back(std::move(result.scene));
  }
  sort();
}

void Library::sort() {
  std::sort(scenes_.begin(), scenes_.end(),
            [](const auto& a, const auto& b) { return rank(*a) < rank(*b); });
}

std::shared_ptr<const Scene> Library::find(std::string_view name) const {
  const auto found = std::find_if(scenes_.begin(), scenes_.end(),
                                  [&](const auto& scene) { return scene->name == name; });
  return found == scenes_.end() ? nullptr : *found;
}

// The shortest name: a variant of a variant is listed with the others.
const Scene* Library::base_of(const Scene& scene) const {
  const Scene* base = nullptr;
  for (const auto& other : scenes_) {
    const std::size_t end = other->name.size();
    const bool prefix = scene.name.size() > end && scene.name[end] == '_' &&
                        std::string_view(scene.name).starts_with(other->name);
    if (!prefix || is_own(scene) || is_own(*other)) continue;
    if (base == nullptr || other->name.size() < base->name.size()) base = other.get();
  }
  return base;
}

std::vector<std::shared_ptr<const Scene>> Library::variants_of(const Scene& base) const {
  std::vector<std::shared_ptr<const Scene>> variants;
  for (const auto& scene : scenes_) {
    if (base_of(*scene) == &base) variants.push_back(scene);
  }
  return variants;
}

void Library::add_shipped(Scene scene) {
  scenes_.push_back(std::make_shared<const Scene>(std::move(scene)));
  sort();
}

std::shared_ptr<const Scene> Library::add(const Scene& scene) {
  auto own = std::make_shared<Scene>(scene);
  own->group = kOwnGroup;
  const auto shipped = find(own->name);
  if (shipped && !is_own(*shipped)) own->name += "_own";
  std::erase_if(scenes_, [&](const auto& old) { return old->name == own->name; });
  scenes_.push_back(own);
  sort();
  return own;
}

void Library::remove_own(const std::string& name) {
  std::erase_if(scenes_, [&](const auto& scene) { return is_own(*scene) && scene->name == name; });
}

bool is_own(const Scene& scene) { return scene.group == kOwnGroup; }

std::string group_title(std::string_view group) {
  const std::size_t i = group_rank(group);
  if (i < kGroups.size()) return std::string(kGroups[i].title);
  return group.empty() ? "Others" : std::string(group);
}

}  // namespace substep
