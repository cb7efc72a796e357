// Text commands of the application: the keys of links, scripts and command lines.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "app/app.hpp"
#include "app/text/event_text.hpp"
#include "app/text/format.hpp"
#include "app/text/link.hpp"
#include "app/ui/model_actions.hpp"
#include "core/io/experiment.hpp"
#include "core/lab/presets.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

constexpr double kLongestLink = 16384.0;  // [characters]; without an embedded scene
// Settings shown in Explore, and display-only settings.
constexpr std::array<std::string_view, 6> kExplored{"solver", "mode",  "alpha",
                                                    "n",      "n_cap", "watch_stiffness"};

// Whether a run differs from its scene in settings that only the Lab level shows.
bool needs_lab(const Lab& lab) {
  if (lab.seed != 0) return true;
  const Settings& now = lab.session.settings();
  const Settings& own = lab.session.loaded().settings;
  const auto fields = setting_fields();
  return std::any_of(fields.begin(), fields.end(), [&](const SettingField& field) {
    const bool explored =
        std::find(kExplored.begin(), kExplored.end(), field.name) != kExplored.end();
    return !explored && setting_text(field, now) != setting_text(field, own);
  });
}

// One of two words. @return error message, or ""
std::string choose(std::string_view value, std::array<std::string_view, 2> words, bool& on) {
  if (value != words[0] && value != words[1]) {
    return must_be(std::string(words[0]) + " or " + std::string(words[1]), value);
  }
  on = value == words[1];
  return "";
}

std::string choose_panel(std::string_view value, Desk& desk) {
  static constexpr std::array<std::string_view, 7> kNames{"controls", "plots",  "why",  "compare",
                                                          "accuracy", "editor", "model"};
  const auto* const found = std::find(kNames.begin(), kNames.end(), value);
  if (found == kNames.end()) {
    return must_be("controls, plots, why, compare, accuracy, editor or model", value);
  }
  if (desk.tab < Tab::kText) desk.tab_before_text = desk.tab;
  desk.tab = static_cast<Tab>(found - kNames.begin());
  const bool lab_only = desk.tab == Tab::kCompare || desk.tab == Tab::kAccuracy;
  if (lab_only) desk.level = DeskLevel::kLab;
  return "";
}

// A body by its name, or "none".
std::string select_body(App& app, std::string_view name) {
  const auto& bodies = app.session.scene().bodies;
  const auto found =
      std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == name; });
  if (name != "none" && found == bodies.end()) {
    return "no body is called '" + std::string(name) + "'";
  }
  app.desk.selected = name == "none" ? -1 : static_cast<int>(found - bodies.begin());
  return "";
}

// Joints by their names, separated by commas, or "none". A name may have a comma itself.
std::string ring_joints(App& app, std::string_view value) {
  const auto& joints = app.session.scene().joints;
  const auto is_joint = [&](std::string_view name) {
    return std::any_of(joints.begin(), joints.end(),
                       [&](const Joint& joint) { return base(joint).name == name; });
  };
  std::vector<std::string> names;
  if (is_joint(value)) {
    names.emplace_back(value);
  } else if (value != "none") {
    for (std::string_view rest = value;;) {
      const std::string_view name = rest.substr(0, rest.find(','));
      if (!is_joint(name)) return "no joint is called '" + std::string(name) + "'";
      names.emplace_back(name);
      if (name.size() == rest.size()) break;
      rest.remove_prefix(name.size() + 1);
    }
  }
  app.desk.ringed = std::move(names);
  return "";
}

// The names of the plots to show, separated by commas.
std::string choose_plots(std::string_view value, Desk& desk) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(Plot::kCount)> kNames{
      "substeps", "energy", "drift", "error", "time"};
  std::array<bool, kNames.size()> shown{};
  for (std::string_view rest = value; !rest.empty();) {
    const std::string_view name = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(name.size() + 1, rest.size()));
    const auto* const found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
      return must_be("substeps, energy, drift, error or time", name);
    }
    shown.at(static_cast<std::size_t>(found - kNames.begin())) = true;
  }
  for (std::size_t i = 0; i < shown.size(); ++i) desk.plots.at(i).shown = shown.at(i);
  return "";
}

// Window options: accepted in links and scripts, but never written to links.
// @return error message, or ""; empty for another key
std::optional<std::string> set_window(App& app, std::string_view key, std::string_view value) {
  Desk& desk = app.desk;
  if (key == "speed" || key == "scale") {
    const auto number = parse_number(value);
    const Range range = key == "speed" ? Range{0.01, 16.0} : Range{0.8, 1.5};
    if (!number || !range.contains(*number)) {
      return must_be(range.text(), value);
    }
    if (key == "speed") app.session.set_speed(*number);
    if (key == "scale") desk.scale = *number;
    return "";
  }
  if (key == "camera") {
    app.view.follow(app.session);  // else the camera of a new scene replaces it in the next frame
    const bool read = app.view.camera.set(value);
    return read ? "" : must_be("yaw,pitch,distance,x,y,z", value);
  }
  if (key == "theme") return choose(value, {"light", "dark"}, desk.dark);
  if (key == "panels") return choose(value, {"off", "on"}, desk.panels);
  if (key == "cards") return choose(value, {"off", "on"}, desk.cards);
  for (const ViewSwitch& option : kViewSwitches) {
    // `forces` is also a setting, with other values.
    const bool is_setting = find_setting(key) != nullptr && value != "off" && value != "on";
    if (key == option.key && !is_setting)
      return choose(value, {"off", "on"}, desk.view.*option.member);
  }
  if (key == "help") return choose(value, {"off", "on"}, desk.help);
  if (key == "level") {
    bool lab = desk.level == DeskLevel::kLab;
    std::string problem = choose(value, {"explore", "lab"}, lab);
    desk.level = lab ? DeskLevel::kLab : DeskLevel::kExplore;
    return problem;
  }
  if (key == "more") {
    if (value == "on") desk.level = DeskLevel::kLab;
    return choose(value, {"off", "on"}, desk.more);
  }
  if (key == "menu") return choose(value, {"none", "share"}, desk.open_share_menu);
  if (key == "select") return select_body(app, value);
  if (key == "edit") return ui::edit_model(app, desk, value);
  if (key == "ring") return ring_joints(app, value);
  if (key == "views") return choose(value, {"ghosts", "split"}, desk.split);
  if (key == "panel") return choose_panel(value, desk);
  if (key == "plots") return choose_plots(value, desk);
  if (key == "tour") return app.tour.go(app, value);
  if (key == "introduction") {
    bool on = false;
    std::string problem = choose(value, {"off", "on"}, on);
    if (problem.empty() && on) app.tour.leave(app);
    if (problem.empty()) on ? app.introduction.start(app) : app.introduction.leave(app);
    return problem;
  }
  return std::nullopt;
}

// Load, seed, or duration of the run.
std::string set_experiment(Lab& lab, std::string_view key, std::string_view value) {
  const auto number = parse_number(value);
  const Range range = key == "load"   ? kLoadRange
                      : key == "seed" ? Range{0.0, static_cast<double>(kMostSeed)}
                                      : kDurationRange;
  if (!number || !range.contains(*number)) return must_be(range.text(), value);
  if (key == "seed" && *number != std::round(*number)) return must_be("a whole number", value);
  if (key == "load") lab.vary(*number, lab.seed);
  if (key == "seed") lab.vary(lab.load, static_cast<int>(*number));
  if (key == "seconds") lab.pause_at = *number;
  return "";
}

std::string set_accuracy(Lab& lab, std::string_view value) {
  Accuracy& accuracy = lab.accuracy;
  if (value == "run") {
    accuracy.start(lab.plain_scene);
  } else if (value == "cancel") {
    accuracy.cancel();
    accuracy.cancel_search();
    accuracy.cancel_trial();
    accuracy.effects.cancel();
    lab.find_n.cancel();
  } else if (value == "find") {
    lab.start_find_n();
  } else if (value == "alpha") {
    if (!accuracy.can_search()) {
      return "'alpha' needs a sweep that has found its reference: set accuracy=run first";
    }
    accuracy.search_alpha();
  } else if (value == "map") {
    accuracy.picture = AccuracyPicture::kStabilityMap;
  } else if (value == "trade") {
    accuracy.picture = AccuracyPicture::kFairTrade;
  } else if (value == "error") {
    accuracy.picture = AccuracyPicture::kErrorAgainstCost;
  } else if (value == "stages") {
    accuracy.picture = AccuracyPicture::kEffectCosts;
  } else if (value == "measure") {
    lab.measure_costs();
  } else {
    return must_be("run, find, cancel, alpha, measure, error, trade, map or stages", value);
  }
  return "";
}

}  // namespace

std::string App::set(std::string_view key, std::string_view value) {
  if (key == "scene") {
    return open(value) ? "" : "no scene is called '" + std::string(value) + "'";
  }
  if (auto problem = set_window(*this, key, value)) return *std::move(problem);
  introduction.leave(*this);  // the following commands are for the run in the laboratory
  if (key == "load" || key == "seed" || key == "seconds") {
    std::string problem = set_experiment(*this, key, value);
    if (needs_lab(*this)) desk.level = DeskLevel::kLab;
    return problem;
  }
  if (key == "at") {
    const auto number = parse_number(value);
    if (!number || !kDurationRange.contains(*number)) return must_be(kDurationRange.text(), value);
    seek(*number);
    return "";
  }
  if (key == "accuracy") {
    desk.level = DeskLevel::kLab;
    return set_accuracy(*this, value);
  }
  if (key == "events") {
    std::string problem;
    auto events = read_events(value, session.loaded(), session.settings(), problem);
    if (!problem.empty()) return problem;
    session.follow(std::move(events));
    reset();
    return "";
  }
  if (key == "compare") {
    std::string problem;
    const std::vector<Overrides> runs =
        value == "off" ? std::vector<Overrides>{} : parse_overrides(value, problem);
    const bool begun = session.timeline().size() > 1;
    reset();
    compare.start(session, runs);
    if (begun && compare.open()) tell("All runs of the comparison begin at the start");
    return problem;
  }
  if (key == "preset") {
    const Preset* preset = find_preset(value);
    if (preset == nullptr) return must_be(preset_names(), value);
    change(settings_for(*preset, session.scene()));
    if (needs_lab(*this)) desk.level = DeskLevel::kLab;
    return "";
  }
  const SettingField* field = find_setting(key);
  if (field == nullptr) return "no such setting";
  Settings s = session.settings();
  if (const auto problem = set_setting(*field, value, s)) return *problem;
  change(s);
  if (needs_lab(*this)) desk.level = DeskLevel::kLab;  // the control of this setting is in the Lab
  return "";
}

std::string App::link() const {
  return Lab::link() + (desk.level == DeskLevel::kExplore ? "&level=explore" : "");
}

void App::open_link(std::string_view fragment, std::optional<SceneResult> scene) {
  open_link_paused(fragment, std::move(scene));
  start_opened();
}

void App::open_link_paused(std::string_view fragment, std::optional<SceneResult> scene) {
  if (static_cast<double>(fragment.size()) > kLongestLink) {
    trouble = {"The link was not opened",
               {{"", "it has " + grouped(static_cast<double>(fragment.size())) +
                         " characters; at most " + grouped(kLongestLink) + " are allowed"}},
               kSceneKept};
    return;
  }
  introduction.leave(*this);
  const auto scene_before = plain_scene;
  RunStart before = run_start();
  if (scene && !scene->scene) {
    trouble = {"The link's scene was not loaded", std::move(scene->problems)};
    return;
  }
  if (scene) run(add_own(*scene->scene));
  std::vector<Problem> problems;
  bool scene_refused = false;
  // The scene first: it resets the settings that the other keys change.
  auto parts = parse_link(fragment);
  std::stable_partition(parts.begin(), parts.end(), [](const auto& p) { return p.key == "scene"; });
  // Events last: they apply to the run that the other keys define.
  std::stable_partition(parts.begin(), parts.end(),
                        [](const auto& p) { return p.key != "events"; });
  // Then what the run, once it is complete, shows.
  std::stable_partition(parts.begin(), parts.end(),
                        [](const auto& p) { return p.key != "at" && p.key != "camera"; });
  // The level last: other keys may switch to the Lab, but an explicit level overrides that.
  std::stable_partition(parts.begin(), parts.end(), [](const auto& p) { return p.key != "level"; });
  const auto gives = [&](std::string_view key) {
    return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.key == key; });
  };
  // The tour controls the comparison itself, and restores it.
  if (!gives("compare") && !gives("tour")) compare.close();
  if (!gives("tour") && !gives("introduction")) tour.close(*this);
  std::set<std::string_view> followed;
  for (const LinkPart& part : parts) {
    const bool again = followed.contains(part.key);
    const std::string problem =
        again ? "is given more than once; the first value is used" : set(part.key, part.value);
    if (problem.empty()) {
      followed.insert(part.key);
      continue;
    }
    problems.push_back({part.key.empty() ? "=" + part.value : part.key, problem});
    scene_refused = scene_refused || part.key == "scene";
  }
  opened = {run_count, session.playing(), std::move(before)};
  session.pause();
  if (problems.empty()) return;
  const bool kept = scene_refused && plain_scene == scene_before;
  std::string aftermath = kept ? kSceneKept : "";
  if (problems.size() < parts.size()) {
    aftermath += std::string(kept ? " " : "") + "The rest of the link was applied.";
  }
  trouble = {"Some settings of the link were ignored", std::move(problems), std::move(aftermath)};
}

}  // namespace substep
