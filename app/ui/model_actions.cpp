#include "app/ui/model_actions.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/io/scene_reader.hpp"
#include "core/model/format_text.hpp"

namespace substep::ui {
namespace {

/// The index of the item that was at `i` in `from`: the same if nothing was added or removed, else
/// that of its name; -1 if it is gone.
template <class Items, class NameOf>
int moved_index(const Items& from, const Items& to, int i, NameOf name_of) {
  if (i < 0 || index(i) >= from.size()) return -1;
  if (from.size() == to.size()) return i;
  const auto found = std::find_if(to.begin(), to.end(), [&](const auto& item) {
    return name_of(item) == name_of(from[index(i)]);
  });
  return found == to.end() ? -1 : static_cast<int>(found - to.begin());
}

/// Does something to the scene of the run, and keeps what is selected.
template <class Act>
void keeping_selection(Lab& lab, Desk& desk, Act act) {
  const auto before = lab.session.shared_scene();
  const int body = desk.selected;
  const int joint = desk.model.joint;
  act();
  const Scene& now = lab.session.scene();
  desk.selected = moved_index(before->bodies, now.bodies, body,
                              [](const Body& of) { return std::string_view(of.name); });
  desk.model.joint = moved_index(before->joints, now.joints, joint,
                                 [](const Joint& of) { return std::string_view(base(of).name); });
}

void select_last(const Lab& lab, Desk& desk) {
  desk.selected = static_cast<int>(lab.session.scene().bodies.size()) - 1;
  desk.model.joint = -1;
}

bool has_selected(const Lab& lab, const Desk& desk) {
  return desk.selected >= 0 && index(desk.selected) < lab.session.scene().bodies.size();
}

/// Adds a body with a change, and selects it.
void add_with(Lab& lab, Desk& desk, const ModelChange& change) {
  const std::size_t before = lab.session.scene().bodies.size();
  change_or_tell(lab, desk, change);
  if (lab.session.scene().bodies.size() > before) select_last(lab, desk);
}

}  // namespace

void open_model(Desk& desk) {
  if (desk.tab < Tab::kText) desk.tab_before_text = desk.tab;
  desk.tab = Tab::kModel;
  desk.panels = true;
  desk.right.open = true;
}

void new_scene(Lab& lab, Desk& desk) {
  std::string end;
  std::shared_ptr<const Scene> scene;
  for (int i = 2;; ++i) {
    scene = lab.library.find("my_scene" + end);
    if (scene == nullptr || (is_own(*scene) && scene->bodies.size() == 1)) break;
    end = '_' + std::to_string(i);
  }
  if (scene == nullptr) {
    std::string title = "My scene" + end;
    std::replace(title.begin(), title.end(), '_', ' ');
    scene = lab.add_own(*read_scene(new_scene_text("my_scene" + end, title)).scene);
  }
  lab.run(scene);
  lab.session.pause();
  open_model(desk);
}

Problems change_model(Lab& lab, Desk& desk, const ModelChange& change) {
  const auto scene = lab.editor.by_hand(lab);
  if (scene == nullptr) {
    return {{"", lab.editor.too_long.empty() ? "The text of the scene has problems: mend it first"
                                             : lab.editor.too_long}};
  }
  Problems problems;
  keeping_selection(lab, desk, [&] {
    problems = lab.editor.change(lab, change(lab.editor.text().text(), *scene));
  });
  return problems;
}

void change_or_tell(Lab& lab, Desk& desk, const ModelChange& change) {
  const Problems problems = change_model(lab, desk, change);
  if (!problems.empty()) lab.tell(problems.front().message);
}

bool joins(const Lab& lab, const Desk& desk, BodyPart part) {
  if (part == BodyPart::kLink) return true;
  const auto& joints = lab.session.scene().joints;
  return has_selected(lab, desk) && std::any_of(joints.begin(), joints.end(), [&](const Joint& j) {
           return base(j).a == desk.selected || base(j).b == desk.selected;
         });
}

void add_to_model(Lab& lab, Desk& desk, BodyPart part) {
  const int near = has_selected(lab, desk) ? desk.selected : kWorld;
  std::optional<Hold> hold;
  if (joins(lab, desk, part)) hold = Hold{near, desk.model.joint_type};
  add_with(lab, desk, [&](const std::string& text, const Scene& scene) {
    return with_body(text, scene, part, near, hold);
  });
}

void copy_selected(Lab& lab, Desk& desk) {
  if (!has_selected(lab, desk)) return;
  add_with(lab, desk, [&](const std::string& text, const Scene& scene) {
    return with_copy(text, scene, desk.selected);
  });
}

void delete_selected(Lab& lab, Desk& desk) {
  if (!has_selected(lab, desk)) return;
  change_or_tell(lab, desk, [&](const std::string& text, const Scene& scene) {
    return without_body(text, scene, desk.selected);
  });
}

void connect_selected(Lab& lab, Desk& desk, int other) {
  desk.model.connecting = false;
  if (!has_selected(lab, desk) || other == desk.selected) return;
  const std::size_t before = lab.session.scene().joints.size();
  change_or_tell(lab, desk, [&](const std::string& text, const Scene& scene) {
    return with_joint(text, scene, desk.selected, other, desk.model.joint_type);
  });
  const std::size_t now = lab.session.scene().joints.size();
  if (now > before) desk.model.joint = static_cast<int>(now) - 1;
}

void step_model(Lab& lab, Desk& desk, bool forward) {
  keeping_selection(lab, desk,
                    [&] { forward ? lab.editor.step_forward(lab) : lab.editor.step_back(lab); });
}

namespace {

/// See edit_model().
std::string take_action(Lab& lab, Desk& desk, std::string_view action) {
  constexpr std::array<std::string_view, 3> kParts{"link", "ball", "box"};
  const auto* const part = std::find(kParts.begin(), kParts.end(), action);
  if (part != kParts.end()) {
    add_to_model(lab, desk, static_cast<BodyPart>(part - kParts.begin()));
    return "";
  }
  if (action == "new" || action == "undo" || action == "redo") {
    action == "new" ? new_scene(lab, desk) : step_model(lab, desk, action == "redo");
    return "";
  }
  if (!has_selected(lab, desk)) return "select a body first";
  if (action == "copy") copy_selected(lab, desk);
  if (action == "delete") delete_selected(lab, desk);
  if (action == "copy" || action == "delete") return "";
  ModelChange change;
  if (action == "moves" || action == "static") {
    change = [&](const std::string& text, const Scene& scene) {
      return with_motion(text, scene, desk.selected, action == "moves");
    };
  }
  const std::string_view word = action.substr(0, action.find(':'));
  std::string_view rest = action.substr(std::min(word.size() + 1, action.size()));
  if (word == "connect") {
    const auto& bodies = lab.session.scene().bodies;
    const auto other = std::find_if(bodies.begin(), bodies.end(),
                                    [&](const Body& body) { return body.name == rest; });
    if (other == bodies.end() && rest != "world") {
      return "no body is called '" + std::string(rest) + "'";
    }
    connect_selected(lab, desk,
                     other == bodies.end() ? kWorld : static_cast<int>(other - bodies.begin()));
    return "";
  }
  const auto is_field = [&](const ModelField& field) { return field.name == word; };
  const auto known = fields_of_body(lab.session.scene(), desk.selected);
  if (std::any_of(known.begin(), known.end(), is_field)) {
    change = [&](std::string text, const Scene& scene) {
      const auto fields = fields_of_body(scene, desk.selected);
      ModelField field = *std::find_if(fields.begin(), fields.end(), is_field);
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        const std::string value(rest.substr(0, rest.find(',')));
        rest.remove_prefix(std::min(value.size() + 1, rest.size()));
        text = with_typed(text, scene, field, i, value);
        field.values[i] = value;
      }
      return text;
    };
  }
  if (!change) {
    return must_be(
        "new, link, ball, box, copy, delete, moves, static, undo, redo, connect:NAME or "
        "FIELD:VALUE of the selected body",
        action);
  }
  const Problems problems = change_model(lab, desk, change);
  return problems.empty() ? "" : problems.front().message;
}

}  // namespace

std::string edit_model(Lab& lab, Desk& desk, std::string_view actions) {
  // A link must not stop the page: every action reads the whole text.
  constexpr int kMostActions = 100;
  constexpr std::size_t kMostRead = 2'000'000;  // [bytes]
  std::string problem;
  std::size_t read = 0;
  for (int taken = 0; !actions.empty() && problem.empty(); ++taken) {
    read += lab.editor.text().text().size();
    if (taken == kMostActions || read > kMostRead) {
      return format_text(
          "only the first %d actions were taken: a link has at most %d, fewer in a "
          "scene with a long text",
          taken, kMostActions);
    }
    const std::string_view action = actions.substr(0, actions.find(';'));
    actions.remove_prefix(std::min(action.size() + 1, actions.size()));
    problem = take_action(lab, desk, action);
  }
  return problem;
}

}  // namespace substep::ui
