#include "core/model/validate.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "core/model/body_checks.hpp"
#include "core/model/names.hpp"
#include "core/model/number_checks.hpp"
#include "core/model/scene_checks.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"
#include "core/model/text_checks.hpp"

namespace substep {
namespace {

/// Whether the value of a field is allowed. Compares numbers, not texts: those depend on the locale
/// of the program.
struct IsAllowed {
  const Settings& settings;

  bool operator()(const FlagSetting&) const { return true; }
  bool operator()(const CountSetting& f) const {
    return settings.*f.member >= f.least && settings.*f.member <= f.most;
  }
  bool operator()(const NumberSetting& f) const { return f.range.contains(settings.*f.member); }
  template <class Enum>
  bool operator()(const ChoiceSetting<Enum>& f) const {
    return value_of<Enum>(name_of(settings.*f.member)).has_value();
  }
};

void check_settings(const Settings& settings, const std::string& pointer, Problems& problems) {
  for (const SettingField& field : setting_fields()) {
    if (std::visit(IsAllowed{settings}, field.member)) continue;
    problems.push_back(
        {pointer_to(pointer, field.name), refusal(field, setting_text(field, settings))});
  }
}

/// @return true if the count is allowed
bool check_count(std::size_t count, std::size_t most, const std::string& pointer,
                 Problems& problems) {
  if (count <= most) return true;
  problems.push_back({pointer, too_many(count, most, "items")});
  return false;
}

void check_contact(const ContactModel& contact, Problems& problems) {
  check_number(contact.compliance, kComplianceRange, "/contact/compliance", problems);
  check_number(contact.friction_compliance, kComplianceRange, "/contact/friction_compliance",
               problems);
  check_number(contact.soft_compliance, kComplianceRange, "/contact/soft_compliance", problems);
  check_number(contact.margin, kMarginRange, "/contact/margin", problems);
  check_number(contact.restitution_speed, kRestitutionSpeedRange, "/contact/restitution_speed",
               problems);
}

void check_criteria(const Scene& scene, Problems& problems) {
  const Criteria& criteria = scene.criteria;
  check_number(criteria.duration, kDurationRange, "/criteria/duration", problems);
  check_number(criteria.joint_gap, kDistanceRange, "/criteria/joint_gap", problems);
  if (criteria.energy_gain != kAnyEnergy) {
    check_number(criteria.energy_gain, kEnergyRange, "/criteria/energy_gain", problems);
  }
  check_number(criteria.energy_scale, kEnergyRange, "/criteria/energy_scale", problems);
  check_number(criteria.window, kDurationRange, "/criteria/window", problems);
  const auto check_index = [&](int body, const char* pointer) {
    if (auto fault = body_fault(scene.bodies, body)) {
      problems.push_back({pointer, std::move(*fault)});
    }
  };
  if (criteria.displacement) {
    check_index(criteria.displacement->body, "/criteria/displacement/body");
    check_number(criteria.displacement->distance, kDistanceRange, "/criteria/displacement/distance",
                 problems);
  }
  if (criteria.track) check_index(*criteria.track, "/criteria/track");
}

void check_recommended(const Recommended& recommended, Problems& problems) {
  check_number(recommended.within, kErrorRange, "/recommended/within", problems);
  check_number(recommended.reached, kErrorRange, "/recommended/reached", problems);
  check_number(recommended.operations, kOperationsRange, "/recommended/operations", problems);
  check_number(recommended.seconds, kDurationRange, "/recommended/seconds", problems);
  check_settings(recommended.settings, "/recommended/settings", problems);
}

constexpr int kLeastSide = -1;  // of StoredForce::active_set
constexpr int kMostSide = 2;    // not known yet

bool is_not_negative(double x) { return std::isfinite(x) && x >= 0.0; }

/// Checks lists that have an item for every body.
class Lists {
 public:
  Lists(std::string pointer, std::size_t bodies, Problems& problems)
      : pointer_(std::move(pointer)), bodies_(bodies), problems_(problems) {}

  /// Reports only the first item that is not finite.
  template <class Item>
  void required(const char* key, const std::vector<Item>& items) {
    if (!sized(key, items)) return;
    const auto bad =
        std::find_if(items.begin(), items.end(), [](const Item& item) { return !finite(item); });
    if (bad == items.end()) return;
    problems_.push_back(
        {pointer_to(pointer_to(pointer_, key), static_cast<std::size_t>(bad - items.begin())),
         "must be finite"});
  }
  template <class Item>
  void optional(const char* key, const std::vector<Item>& items) {
    if (!items.empty()) required(key, items);
  }
  template <class Item>
  bool sized(const char* key, const std::vector<Item>& items) {
    if (items.size() == bodies_) return true;
    problems_.push_back(
        {pointer_to(pointer_, key), "must have " + std::to_string(bodies_) +
                                        " items, one for each body of the scene, not " +
                                        std::to_string(items.size())});
    return false;
  }

 private:
  static bool finite(double item) { return std::isfinite(item); }
  static bool finite(const OwnSubstep& item) {
    return is_not_negative(item.dt_previous) && is_not_negative(item.r);
  }
  static bool finite(const RatePeak& item) {
    return is_not_negative(item.before) && is_not_negative(item.now);
  }
  static bool finite(const auto& item) { return item.allFinite(); }

  std::string pointer_;
  std::size_t bodies_;
  Problems& problems_;
};

bool has_sound_numbers(const StoredForce& force) {
  const auto all_finite = [](const auto& numbers) {
    return std::all_of(std::begin(numbers), std::end(numbers),
                       [](double x) { return std::isfinite(x); });
  };
  const auto side = [](std::int8_t tight) { return kLeastSide <= tight && tight <= kMostSide; };
  return all_finite(force.lambda) && all_finite(force.rate) && is_not_negative(force.rate_age) &&
         all_finite(force.rate_change) && all_finite(force.elastic) &&
         std::all_of(std::begin(force.active_set), std::end(force.active_set), side);
}

/// @param pointer location of the carried state of a saved run, such as "/carried"
void check_carried(const Carried& carried, const Scene& scene, const std::string& pointer,
                   Problems& problems) {
  check_number(carried.dt_previous, not_negative(1.0, "s"), pointer_to(pointer, "dt_previous"),
               problems);
  check_number(carried.r, not_negative(std::numeric_limits<double>::max(), "1/s^2"),
               pointer_to(pointer, "r"), problems);
  check_number(carried.rotation_age, not_negative(10.0, "s"), pointer_to(pointer, "rotation_age"),
               problems);
  if (carried.held_frames < 0) {
    problems.push_back({pointer_to(pointer, "held_frames"),
                        must_be("at least 0", std::to_string(carried.held_frames))});
  }
  Lists lists(pointer, scene.bodies.size(), problems);
  lists.required("u", carried.u);
  lists.optional("k", carried.k);
  lists.optional("k_resisting", carried.K_resisting);
  lists.optional("acceleration", carried.acceleration);
  lists.optional("acceleration_change", carried.acceleration_change);
  lists.optional("torque", carried.torque);
  lists.optional("torque_change", carried.torque_change);
  lists.optional("own", carried.own);
  lists.optional("rotation", carried.rotation);
  lists.optional("held", carried.held);
  lists.optional("rest", carried.rest);
  const auto rest = std::find_if(carried.rest.begin(), carried.rest.end(),
                                 [](double seconds) { return seconds < 0.0; });
  if (rest != carried.rest.end()) {
    const auto body = static_cast<std::size_t>(rest - carried.rest.begin());
    problems.push_back({pointer_to(pointer_to(pointer, "rest"), body),
                        must_be("at least 0 (s)", number_text(*rest))});
  }
  if (carried.k.empty() && !carried.K_resisting.empty()) {
    problems.push_back({pointer_to(pointer, "k_resisting"), "requires k"});
  }
  const std::string forces = pointer_to(pointer, "forces");
  if (!check_count(carried.forces.size(), kMaxForces, forces, problems)) return;
  const auto bad =
      std::find_if_not(carried.forces.begin(), carried.forces.end(), has_sound_numbers);
  if (bad == carried.forces.end()) return;
  problems.push_back({pointer_to(forces, static_cast<std::size_t>(bad - carried.forces.begin())),
                      "must have finite numbers, and tight from -1 to 2"});
}

/// @param sound out: which bodies and joints are valid individually
Problems check_all_values(const Scene& scene, SoundParts& sound) {
  Problems problems;
  check_number(scene.frame, kFrameRange, "/frame", problems);
  check_numbers(scene.gravity, kGravityRange, "/gravity", problems);
  check_contact(scene.contact, problems);
  check_number(scene.regularisation, kRegularisationRange, "/regularisation", problems);
  if (!value_of<StartPolicy>(name_of(scene.start))) {
    problems.push_back({"/start", "must be project, keep or refuse"});
  }
  check_settings(scene.settings, "/settings", problems);
  if (scene.recommended) check_recommended(*scene.recommended, problems);
  check_count(scene.bodies.size(), kMaxBodies, "/bodies", problems);
  check_count(scene.joints.size(), kMaxJoints, "/joints", problems);
  check_count(scene.verdicts.size(), kMaxVerdictRules, "/verdicts", problems);
  const DataPlace bodies("/bodies");
  const DataPlace joints("/joints");
  for (std::size_t i = 0; i < scene.bodies.size() && problems.size() < kMaxProblems; ++i) {
    const std::size_t before = problems.size();
    check_body(scene.bodies[i], bodies.at(i), problems);
    sound.bodies.push_back(problems.size() == before);
  }
  check_criteria(scene, problems);
  check_number(scene.camera.width, kDistanceRange, "/camera/width", problems);
  for (std::size_t i = 0; i < scene.joints.size() && problems.size() < kMaxProblems; ++i) {
    const std::size_t before = problems.size();
    check_joint(scene.joints[i], scene.bodies, joints.at(i), problems);
    sound.joints.push_back(problems.size() == before);
  }
  if (scene.carried) check_carried(*scene.carried, scene, "/carried", problems);
  return problems;
}

void check_text(const std::string& text, const DataPlace& place, Problems& problems) {
  const auto fault = text_fault(text);
  if (fault) problems.push_back({place.pointer(), '"' + visible_text(text) + '"' + *fault});
}

void check_texts(const Scene& scene, Problems& problems) {
  const DataPlace root("");
  check_text(scene.name, root.at("name"), problems);
  check_text(scene.title, root.at("title"), problems);
  check_text(scene.group, root.at("group"), problems);
  check_text(scene.description, root.at("description"), problems);
  check_text(scene.look_for, root.at("look_for"), problems);
  const DataPlace bodies("/bodies");
  for (std::size_t i = 0; i < scene.bodies.size() && problems.size() < kMaxProblems; ++i) {
    const DataPlace body = bodies.at(i);
    check_text(scene.bodies[i].name, body.at("name"), problems);
  }
  const DataPlace joints("/joints");
  for (std::size_t i = 0; i < scene.joints.size() && problems.size() < kMaxProblems; ++i) {
    const DataPlace joint = joints.at(i);
    check_text(base(scene.joints[i]).name, joint.at("name"), problems);
  }
  const DataPlace verdicts("/verdicts");
  for (std::size_t i = 0; i < scene.verdicts.size() && problems.size() < kMaxProblems; ++i) {
    const DataPlace rule = verdicts.at(i);
    check_text(scene.verdicts[i].why, rule.at("why"), problems);
  }
  const DataPlace recommended("/recommended");
  if (scene.recommended) check_text(scene.recommended->why, recommended.at("why"), problems);
}

Problems first_of(Problems problems) {
  if (problems.size() > kMaxProblems) problems.resize(kMaxProblems);
  return problems;
}

}  // namespace

Problems validate(const Scene& scene) {
  SoundParts sound;
  Problems problems = check_all_values(scene, sound);
  if (problems.size() >= kMaxProblems) return first_of(std::move(problems));
  if (scene.bodies.empty()) problems.push_back({"/bodies", "must have at least one body"});
  check_texts(scene, problems);
  check_effects(scene, problems);
  check_joint_starts(scene, sound, problems);
  check_redundant_rows(scene, sound, problems);
  return first_of(std::move(problems));
}

Problems check_values(const Scene& scene) {
  SoundParts sound;
  return first_of(check_all_values(scene, sound));
}

bool is_runnable(const Scene& scene) { return check_values(scene).empty(); }

bool fits(const State& state, const Scene& scene) {
  const std::size_t n = scene.bodies.size();
  return state.x.size() == n && state.q.size() == n && state.u.size() == n &&
         state.u_synchronised.size() == n;
}

std::optional<std::string> refusal_of(const Scene* scene) {
  const std::string refused = "the scene is invalid: ";
  if (scene == nullptr) return refused + "there is no scene";
  const Problems problems = check_values(*scene);
  return problems.empty() ? std::nullopt : std::optional(refused + to_code(problems.front()));
}

std::shared_ptr<const Scene> not_null(std::shared_ptr<const Scene> scene) {
  if (scene) return scene;
  Scene none;
  none.frame = 0.0;  // out of range
  return std::make_shared<const Scene>(std::move(none));
}

Problems validate(const Settings& settings) {
  Problems problems;
  check_settings(settings, "/settings", problems);
  return problems;
}

Problems validate(const Budget& budget) {
  Problems problems;
  check_number(budget.memory, kMemoryBudgetRange, "/budget/memory", problems);
  check_number(budget.work, kWorkBudgetRange, "/budget/work", problems);
  check_number(budget.substep, kWorkBudgetRange, "/budget/substep", problems);
  check_number(budget.contacts, kContactBudgetRange, "/budget/contacts", problems);
  return problems;
}

Problems validate(const State& state, const Scene& scene) {
  Problems problems;
  const std::string pointer = "/state";
  check_carried(state, scene, pointer, problems);
  Lists lists(pointer, scene.bodies.size(), problems);
  lists.required("x", state.x);
  lists.required("u_synchronised", state.u_synchronised);
  if (lists.sized("q", state.q)) {
    for (std::size_t i = 0; i < state.q.size(); ++i) {
      const auto fault = orientation_fault(state.q[i]);
      if (!fault) continue;
      problems.push_back({pointer_to(pointer_to(pointer, "q"), i), *fault});
      break;
    }
  }
  if (state.frame < 0) {
    problems.push_back(
        {pointer_to(pointer, "frame"), must_be("at least 0", std::to_string(state.frame))});
  }
  constexpr Range kTime = not_negative(std::numeric_limits<double>::max(), "s");
  check_number(state.time, kTime, pointer_to(pointer, "time"), problems);
  return first_of(std::move(problems));
}

Problems validate(const Grab& grab, const Scene& scene) {
  Problems problems;
  if (auto fault = body_fault(scene.bodies, grab.body)) {
    problems.push_back({"/grab/body", std::move(*fault)});
  } else if (scene.bodies[index(grab.body)].is_static) {
    problems.push_back({"/grab/body", "must be a moving body, not a static one"});
  }
  if (!grab.anchor.allFinite()) problems.push_back({"/grab/anchor", "must be finite"});
  if (!grab.target.allFinite()) problems.push_back({"/grab/target", "must be finite"});
  if (!(grab.mass > 0.0) || !std::isfinite(grab.mass)) {
    problems.push_back({"/grab/mass", must_be("above 0 and finite (kg)", number_text(grab.mass))});
  }
  return problems;
}

}  // namespace substep
