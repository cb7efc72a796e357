#include "core/model/validate.hpp"

#include <algorithm>
#include <type_traits>

#include "core/model/body_checks.hpp"
#include "core/model/names.hpp"
#include "core/model/number_checks.hpp"
#include "core/model/scene_checks.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/setting_fields.hpp"
#include "core/model/state_checks.hpp"

namespace substep {
namespace {

bool is_allowed(const SettingField& field, const Settings& settings) {
  return std::visit(
      [&]<class Field>(const Field& f) {
        const auto& value = settings.*f.member;
        if constexpr (std::is_same_v<Field, CountSetting>) {
          return f.least <= value && value <= f.most;
        } else if constexpr (std::is_same_v<Field, NumberSetting>) {
          return f.range.contains(value);
        } else if constexpr (std::is_same_v<Field, FlagSetting>) {
          return true;
        } else {
          return value_of<std::remove_cvref_t<decltype(value)>>(name_of(value)).has_value();
        }
      },
      field.member);
}

void check_settings(const Settings& settings, const std::string& pointer, Problems& problems) {
  for (const SettingField& field : setting_fields()) {
    if (is_allowed(field, settings)) continue;
    problems.push_back(
        {pointer_to(pointer, field.name), refusal(field, setting_text(field, settings))});
  }
}

void check_count(std::size_t count, std::size_t most, const char* pointer, Problems& problems) {
  if (count <= most) return;
  problems.push_back({pointer, too_many(count, most, "items")});
}

void check_contact(const ContactModel& contact, Problems& problems) {
  check_number(contact.compliance, kComplianceRange, "/contact/compliance", problems);
  check_number(contact.friction_compliance, kComplianceRange, "/contact/friction_compliance",
               problems);
  check_number(contact.margin, kMarginRange, "/contact/margin", problems);
  check_number(contact.restitution_speed, kRestitutionSpeedRange, "/contact/restitution_speed",
               problems);
}

void check_criteria(const Scene& scene, Problems& problems) {
  const Criteria& criteria = scene.criteria;
  check_number(criteria.duration, kDurationRange, "/criteria/duration", problems);
  check_number(criteria.joint_gap, kDistanceRange, "/criteria/joint_gap", problems);
  if (criteria.energy_gain) {
    check_number(*criteria.energy_gain, kEnergyRange, "/criteria/energy_gain", problems);
  }
  if (criteria.energy_scale) {
    check_number(*criteria.energy_scale, kEnergyRange, "/criteria/energy_scale", problems);
  }
  if (criteria.window) {
    check_number(*criteria.window, kDurationRange, "/criteria/window", problems);
  }
  const auto check_index = [&](int body, const char* pointer) {
    if (auto fault = body_fault(body, scene)) problems.push_back({pointer, std::move(*fault)});
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

/// @param sound takes which bodies and joints are right by themselves
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
  if (scene.camera.width) {
    check_number(*scene.camera.width, kDistanceRange, "/camera/width", problems);
  }
  for (std::size_t i = 0; i < scene.joints.size() && problems.size() < kMaxProblems; ++i) {
    const std::size_t before = problems.size();
    check_joint(scene.joints[i], scene.bodies, joints.at(i), problems);
    sound.joints.push_back(problems.size() == before);
  }
  if (scene.carried) check_carried(*scene.carried, scene, "/carried", problems);
  return problems;
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
  const auto moves = [](const Body& body) { return !body.is_static; };
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), moves)) {
    problems.push_back({"/bodies", "no body moves"});
  }
  check_effects(scene, problems);
  check_joint_starts(scene, sound, problems);
  check_redundant_rows(scene, sound, problems);
  return first_of(std::move(problems));
}

Problems check_values(const Scene& scene) {
  SoundParts sound;
  return first_of(check_all_values(scene, sound));
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
  check_state(state, scene, problems);
  return first_of(std::move(problems));
}

Problems validate(const Grab& grab, const Scene& scene) {
  Problems problems;
  check_grab(grab, scene, problems);
  return problems;
}

}  // namespace substep
