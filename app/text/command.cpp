#include "app/text/command.hpp"

#include "core/model/setting_fields.hpp"

namespace substep {

std::string make_command(const Scene& scene, const Settings& settings, std::int64_t frames,
                         bool own) {
  std::string command = "./dev cli run " + scene.name + (own ? ".json" : "") +
                        setting_flags(settings, scene.settings);
  if (frames > 0) command += " --frames " + std::to_string(frames);
  return command;
}

}  // namespace substep
