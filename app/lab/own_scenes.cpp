#include "app/lab/own_scenes.hpp"

#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"

namespace substep {

void OwnScenes::add(const std::shared_ptr<const Scene>& scene) {
  std::erase_if(scenes_, [&](const auto& old) { return old->name == scene->name; });
  scenes_.insert(scenes_.begin(), scene);
  if (scenes_.size() > kMost) scenes_.resize(kMost);
}

std::string OwnScenes::text() const {
  Json list = Json::array();
  for (const auto& scene : scenes_) {
    std::string text = write_scene(*scene);
    if (text.size() <= kMaxText) list.push_back(std::move(text));
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

OwnScenes OwnScenes::read(std::string_view text) {
  OwnScenes own;
  Problems problems;
  const auto list = parse_json(text, problems);
  if (!list || !list->is_array()) return own;
  for (const Json& item : *list) {
    const auto* scene_text = item.get_ptr<const std::string*>();
    if (scene_text == nullptr || own.scenes_.size() == kMost) continue;
    if (auto scene = read_scene(*scene_text).scene) own.scenes_.push_back(std::move(scene));
  }
  return own;
}

}  // namespace substep
