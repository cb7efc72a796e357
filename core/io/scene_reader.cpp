#include "core/io/scene_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/io/body_names.hpp"
#include "core/io/carried_json.hpp"
#include "core/io/item_reader.hpp"
#include "core/io/object_reader.hpp"
#include "core/io/recommended_json.hpp"
#include "core/io/scene_sections.hpp"
#include "core/io/settings_json.hpp"
#include "core/io/verdicts_json.hpp"
#include "core/lab/start_text.hpp"
#include "core/model/effects.hpp"
#include "core/model/scene_checks.hpp"
#include "core/model/scene_limits.hpp"
#include "core/sim/joint_starts.hpp"

namespace substep {
namespace {

constexpr std::size_t kItemsOfAPart = 1000;  // bodies or joints
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Adds a problem for every joint that is inconsistent with the poses and velocities, beyond the
/// tolerances of sim/joint_starts.hpp. A scene that continues a saved run is not checked.
void check_refused(const Scene& scene, Problems& problems) {
  if (scene.carried) return;
  const std::vector<JointStart> starts = joint_starts(scene, initial_state(scene));
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!starts[i].beyond.any()) continue;
    problems.push_back({pointer_to("/joints", i),
                        "\"start\" is \"refuse\", and this joint is " + fault_text(starts[i])});
  }
}

}  // namespace

struct SceneReading::Impl {
  explicit Impl(std::string whole) : text(std::move(whole)) {}

  /// Does a part, and sets the next one.
  using Part = void (Impl::*)();

  std::string text;
  Part next = &Impl::parse;  // null when done
  std::size_t item = 0;      // of the list that is being read
  Json json;
  Problems problems;  // of the text itself
  Problems found;     // of its content
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
  SoundParts sound;
  bool lists_effects = false;
  const Json* bodies = nullptr;
  const Json* joints = nullptr;
  std::optional<ObjectReader> in;
  std::optional<BodyNames> names;
  std::map<std::string, std::size_t> joint_names;

  void parse();
  void read_head();
  void read_bodies();
  void read_names();
  void read_joints();
  void check();
  /// Whether another item of a list is to be read in this part.
  bool part_continues(const Json* list, std::size_t end) const {
    return list != nullptr && item < std::min(end, list->size()) && found.size() <= kMaxProblems;
  }
};

void SceneReading::Impl::parse() {
  std::optional<Json> document = parse_json(text, problems);
  text = {};
  next = document ? &Impl::read_head : nullptr;
  if (document) json = *std::move(document);
}

void SceneReading::Impl::read_head() {
  in.emplace(json, "", found);
  next = nullptr;
  const std::optional<int> version = in->is_object() ? read_version(*in, found) : std::nullopt;
  if (!version) return;
  next = &Impl::read_bodies;
  read_about(*in, *scene);
  read_camera(*in, *scene, found);
  in->number("frame", kFrameRange, scene->frame, kOptional);
  lists_effects = read_effects(*in, *scene);
  in->vector("gravity", kGravityRange, scene->gravity, kOptional);
  read_contact(*in, *scene, found);
  in->number("regularisation", kRegularisationRange, scene->regularisation, kOptional);
  read_start(*in, *scene);
  const Json* settings = in->member("settings", kOptional);
  const bool has_settings = settings != nullptr && !settings->empty();
  read_scene_settings(*in, *version, scene->settings, found);
  if (const Json* recommended = in->member("recommended", kOptional)) {
    scene->recommended =
        read_recommended(*recommended, in->pointer("recommended"), *version, found);
    if (!has_settings) scene->settings = scene->recommended->settings;
  }
  bodies = in->list("bodies", kMaxBodies, kRequired);
}

void SceneReading::Impl::read_bodies() {
  for (const std::size_t end = item + kItemsOfAPart; part_continues(bodies, end); ++item) {
    const std::size_t before = found.size();
    scene->bodies.push_back(read_body((*bodies)[item], pointer_to("/bodies", item), found));
    sound.bodies.push_back(found.size() == before);
  }
  if (!part_continues(bodies, kAll)) next = &Impl::read_names;
}

void SceneReading::Impl::read_names() {
  if (bodies && bodies->empty()) in->problem("bodies", "must have at least one body");
  names.emplace(scene->bodies, found);
  read_criteria(*in, *names, *scene, found);
  scene->verdicts = read_verdicts(*in, found);
  joints = in->list("joints", kMaxJoints, kOptional);
  item = 0;
  next = &Impl::read_joints;
}

void SceneReading::Impl::read_joints() {
  for (const std::size_t end = item + kItemsOfAPart; part_continues(joints, end); ++item) {
    const std::string pointer = pointer_to("/joints", item);
    const std::size_t before = found.size();
    scene->joints.push_back(read_joint((*joints)[item], pointer, *names, found));
    sound.joints.push_back(found.size() == before);
    const std::string& name = base(scene->joints.back()).name;
    const auto [other, is_new] = joint_names.emplace(name, item);
    if (!is_new && !name.empty()) {
      found.push_back(
          {pointer_to(pointer, "name"),
           value_text(name) + " is already the name of /joints/" + std::to_string(other->second)});
    }
  }
  if (!part_continues(joints, kAll)) next = &Impl::check;
}

void SceneReading::Impl::check() {
  scene->carried = read_carried(*in, scene->bodies, found);
  in->finish();
  if (lists_effects) {
    check_listed_effects(*in, *scene, found);
  } else {
    scene->effects = effects_of(*scene);
  }
  check_joint_starts(*scene, sound, found);
  check_redundant_rows(*scene, sound, found);
  if (found.empty() && scene->start == StartPolicy::kRefuse) check_refused(*scene, found);
  next = nullptr;
}

SceneReading::SceneReading(std::string text) : impl_(std::make_unique<Impl>(std::move(text))) {}
SceneReading::~SceneReading() = default;

bool SceneReading::advance() {
  if (impl_->next) (*impl_.*impl_->next)();
  return impl_->next != nullptr;
}

SceneResult SceneReading::result() {
  while (advance()) {
  }
  SceneResult result;
  Problems& problems = result.problems;
  problems = std::move(impl_->problems);
  std::set<std::string> reported;
  for (const Problem& problem : problems) reported.insert(problem.pointer);
  for (Problem& problem : impl_->found) {
    // Skips content problems at locations that already have a text problem.
    if (!reported.contains(problem.pointer)) problems.push_back(std::move(problem));
  }
  if (problems.size() > kMaxProblems) {
    problems.resize(kMaxProblems);
    problems.push_back({"", "and more: the rest of the file was not checked"});
  }
  if (problems.empty()) result.scene = std::move(impl_->scene);
  return result;
}

SceneResult read_scene(std::string_view text) { return SceneReading(std::string(text)).result(); }

SceneResult read_scene_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  constexpr std::size_t kPiece = 1U << 16U;  // [bytes]
  // To one byte more than allowed, so that read_scene sees that there is too much.
  while (file && text.size() <= kMaxTextSize) {
    const std::size_t before = text.size();
    text.resize(std::min(before + kPiece, kMaxTextSize + 1));
    file.read(&text[before], static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) {
    if (text.size() > kMaxTextSize) return read_scene(text);
    return {nullptr, {{"", "cannot read " + path + ": " + std::strerror(errno)}}};
  }
  return read_scene(text);
}

}  // namespace substep
