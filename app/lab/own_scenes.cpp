#include "app/lab/own_scenes.hpp"

#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"

namespace substep {

void OwnScenes::add(const std::shared_ptr<const Scene>& scene) {
  std::erase_if(scenes_, [&](const auto& old) { return old->name == scene->name; });
  scenes_.insert(scenes_.begin(), scene);
  if (scenes_.size() > kMost) scenes_.pop_back();
}

void OwnScenes::remove(const std::string& name) {
  std::erase_if(scenes_, [&](const auto& scene) { return scene->name == name; });
}

bool OwnScenes::may_keep(const Scene& scene) {
  constexpr std::size_t kShortest = 70;  // minimum text of a body or a joint [bytes]
  return kShortest * (scene.bodies.size() + scene.joints.size()) <= kMaxText;
}

std::string OwnScenes::text() const {
  Json list = Json::array();
  for (const auto& scene : scenes_) {
    if (!may_keep(*scene)) continue;
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
  for (auto item = list->rbegin(); item != list->rend(); ++item) {
    const auto* scene_text = item->get_ptr<const std::string*>();
    if (scene_text == nullptr) continue;
    if (const auto scene = read_scene(*scene_text).scene) own.add(scene);
  }
  return own;
}

}  // namespace substep
