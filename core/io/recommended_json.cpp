#include "core/io/recommended_json.hpp"

#include "core/io/settings_json.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {

Json recommended_json(const Recommended& recommended) {
  Json json;
  json["of"] = name_of(recommended.of);
  json["within"] = recommended.within;
  json["reached"] = recommended.reached;
  json["operations"] = recommended.operations;
  json["seconds"] = recommended.seconds;
  if (!recommended.why.empty()) json["why"] = recommended.why;
  json["settings"] = scene_settings_json(recommended.settings);
  return json;
}

Recommended read_recommended(const Json& json, const std::string& pointer, int version,
                             Problems& problems) {
  ObjectReader in(json, pointer, problems);
  Recommended recommended;
  if (!in.is_object()) return recommended;
  recommended.of = in.choice<ErrorAxis>("of", kRequired).value_or(recommended.of);
  const bool within = in.number("within", kErrorRange, recommended.within, kRequired);
  const bool reached = in.number("reached", kErrorRange, recommended.reached, kRequired);
  if (within && reached && recommended.reached > recommended.within) {
    in.problem("reached", number_text(recommended.reached) + " is more than within, " +
                              number_text(recommended.within));
  }
  in.number("operations", kOperationsRange, recommended.operations, kRequired);
  in.number("seconds", kDurationRange, recommended.seconds, kRequired);
  in.text("why", kMaxProse, recommended.why, kOptional);
  if (in.member("settings", kRequired)) {
    read_scene_settings(in, version, recommended.settings, problems);
  }
  in.finish();
  return recommended;
}

}  // namespace substep
