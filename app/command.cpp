#include "app/command.hpp"

#include <algorithm>
#include <variant>

#include "core/io/setting_fields.hpp"

namespace substep {

std::string make_command(const Scene& scene, const Settings& settings, std::int64_t frames,
                         bool own) {
  std::string command = "./dev cli run " + scene.name + (own ? ".json" : "");
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;  // what is looked at, not what is done
    const std::string value = setting_text(field, settings);
    if (value == setting_text(field, scene.settings)) continue;
    std::string flag(field.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    if (std::holds_alternative<FlagSetting>(field.member)) {
      command += (value == "true" ? " --" : " --no-") + flag;
    } else {
      command += " --" + flag + " " + value;
    }
  }
  if (frames > 0) command += " --frames " + std::to_string(frames);
  return command;
}

}  // namespace substep
