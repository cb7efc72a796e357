#include "core/io/recommended_json.hpp"

#include <string_view>
#include <vector>

#include "core/io/settings_json.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

void read_axis(ObjectReader& in, ErrorAxis& axis) {
  std::string name;
  if (!in.text("of", kMaxNameSize, name, kRequired)) return;
  if (const auto value = value_of<ErrorAxis>(name)) {
    axis = *value;
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& entry : NameTable<ErrorAxis>::entries) names.push_back(entry.name);
  in.problem("of", must_be(one_of(names), value_text(Json(name))));
}

}  // namespace

Json recommended_json(const Recommended& recommended) {
  Json json;
  json["of"] = name_of(recommended.of);
  json["within"] = recommended.within;
  json["reached"] = recommended.reached;
  json["operations"] = recommended.operations;
  json["seconds"] = recommended.seconds;
  if (!recommended.why.empty()) json["why"] = recommended.why;
  json["settings"] = settings_json(recommended.settings);
  return json;
}

Recommended read_recommended(const Json& json, const std::string& pointer, Problems& problems) {
  ObjectReader in(json, pointer, problems);
  Recommended recommended;
  if (!in.is_object()) return recommended;
  read_axis(in, recommended.of);
  const bool within = in.number("within", kErrorRange, recommended.within, kRequired);
  const bool reached = in.number("reached", kErrorRange, recommended.reached, kRequired);
  if (within && reached && recommended.reached > recommended.within) {
    in.problem("reached", number_text(recommended.reached) + " is more than within, " +
                              number_text(recommended.within));
  }
  in.number("operations", kOperationsRange, recommended.operations, kRequired);
  in.number("seconds", kDurationRange, recommended.seconds, kRequired);
  in.text("why", kMaxProse, recommended.why, kOptional);
  if (in.member("settings", kRequired)) read_settings(in, recommended.settings, problems);
  in.finish();
  return recommended;
}

}  // namespace substep
