#include "core/io/settings_json.hpp"

#include <optional>
#include <string>

#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

/// A value as text for set_setting, or nothing if its type is wrong.
std::optional<std::string> setting_value(const SettingField& field, const Json& value) {
  if (std::holds_alternative<FlagSetting>(field.member)) {
    if (!value.is_boolean()) return std::nullopt;
    return value.get<bool>() ? "true" : "false";
  }
  if (std::holds_alternative<CountSetting>(field.member) ||
      std::holds_alternative<NumberSetting>(field.member)) {
    if (!value.is_number()) return std::nullopt;
    return value.is_number_integer() ? value.dump() : number_text(value.get<double>());
  }
  if (const auto* name = value.get_ptr<const std::string*>()) return *name;
  return std::nullopt;
}

}  // namespace

Json settings_json(const Settings& settings) {
  Json json;
  for (const SettingField& field : setting_fields()) {
    Json& value = json[std::string(field.name)];
    if (const auto* flag = std::get_if<FlagSetting>(&field.member)) {
      value = settings.*flag->member;
    } else if (const auto* count = std::get_if<CountSetting>(&field.member)) {
      value = settings.*count->member;
    } else if (const auto* number = std::get_if<NumberSetting>(&field.member)) {
      value = settings.*number->member;
    } else {
      value = setting_text(field, settings);
    }
  }
  return json;
}

Json scene_settings_json(const Settings& settings) {
  const Json all = settings_json(settings);
  const Json paper = settings_json(kPaperSettings);
  Json json{{"preset", name_of(Defaults::kPaper)}};
  for (const auto& [name, value] : all.items()) {
    if (value != paper[name]) json[name] = value;
  }
  return json;
}

void read_settings(ObjectReader& parent, Settings& settings, Problems& problems) {
  const Json* json = parent.member("settings", kOptional);
  if (!json) return;
  ObjectReader in(*json, parent.pointer("settings"), problems);
  if (const auto preset = in.choice<Defaults>("preset", kOptional)) {
    settings = *preset == Defaults::kPaper ? kPaperSettings : Settings{};
  }
  for (const SettingField& field : setting_fields()) {
    const Json* value = in.member(field.name, kOptional);
    if (!value) continue;
    const auto text = setting_value(field, *value);
    if (!text || set_setting(field, *text, settings)) {
      in.problem(field.name, refusal(field, value_text(*value)));
    }
  }
  in.finish();
}

void read_scene_settings(ObjectReader& parent, int version, Settings& settings,
                         Problems& problems) {
  const Json* json = parent.member("settings", kOptional);
  // An empty block chooses nothing.
  if (json && !json->empty()) settings = version == 1 ? kPaperSettings : Settings{};
  read_settings(parent, settings, problems);
}

}  // namespace substep
