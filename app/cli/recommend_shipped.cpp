#include "app/cli/recommend_shipped.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/all_methods.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "core/io/json_print.hpp"
#include "core/io/recommended_json.hpp"
#include "core/lab/recommendation.hpp"
#include "scenes/generator/recommended.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {

int recommend_shipped(const std::string& out, int jobs) {
  int exit_code = kOk;
  Json all = Json::object();
  for (const Scene& scene : scenes::shipped()) {
    const scenes::Wanted* wanted = scenes::wanted_of(scene.name);
    if (wanted == nullptr) continue;
    const auto results =
        run_all_methods(std::make_shared<const Scene>(scene), wanted->seconds, jobs);
    if (!results) return kCancelled;
    const auto recommended = recommended_of(*results, wanted->of, wanted->within);
    if (!recommended) {
      complain("%s: no method meets %g %s", wanted->scene, wanted->within, unit_of(wanted->of));
      exit_code = kUnexpectedVerdict;
      continue;
    }
    const SeriesParameter parameter = series_parameter(recommended->settings);
    complain("%s: %s, %s = %g", wanted->scene, series_name(recommended->settings).c_str(),
             parameter.name, parameter.value);
    all[wanted->scene] = recommended_json(*recommended);
  }
  return write_file(out, json_file(all)) ? exit_code : kBadInput;
}

}  // namespace substep::cli
