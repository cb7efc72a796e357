#include "app/lab/overrides.hpp"

#include <algorithm>

#include "core/model/names.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

constexpr std::string_view kSame = "same";  // in a link, a run without overrides

// Splits a text at separators; empty for an empty text.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(separator));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

template <class Enum>
std::string_view title_of(std::string_view name) {
  const auto value = value_of<Enum>(name);
  return value ? entry_of(*value).title : name;
}

// Whether a setting belongs to another solver or mode than those of these settings.
bool belongs_to_another(const Settings& s, std::string_view setting) {
  const auto reads_it = [setting](const auto& entry) {
    return std::find(entry.reads.begin(), entry.reads.end(), setting) != entry.reads.end();
  };
  const bool by_some = std::any_of(kSolvers.begin(), kSolvers.end(), reads_it) ||
                       std::any_of(kModes.begin(), kModes.end(), reads_it);
  return by_some && !reads(s, setting);
}

}  // namespace

Overrides differences(const Settings& of, const Settings& from) {
  Overrides list;
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;  // display only
    std::string value = setting_text(field, of);
    if (value != setting_text(field, from)) list.push_back({std::string(field.name), value});
  }
  return list;
}

Settings with_overrides(Settings s, const Overrides& overrides) {
  for (const Override& o : overrides) {
    if (const SettingField* field = find_setting(o.key)) set_setting(*field, o.value, s);
  }
  return s;
}

std::string overrides_text(const std::vector<Overrides>& runs) {
  std::string text;
  for (const Overrides& overrides : runs) {
    if (&overrides != &runs.front()) text += ';';
    if (overrides.empty()) text += kSame;
    for (const Override& o : overrides) {
      if (&o != &overrides.front()) text += ',';
      text.append(o.key).append(":").append(o.value);
    }
  }
  return text;
}

std::vector<Overrides> parse_overrides(std::string_view text, std::string& problem) {
  std::vector<Overrides> runs;
  for (const std::string_view part : split(text, ';')) {
    if (part == kSame) {
      runs.emplace_back();
      continue;
    }
    Overrides overrides;
    for (const std::string_view pair : split(part, ',')) {
      const std::size_t colon = std::min(pair.find(':'), pair.size());
      const std::string key(pair.substr(0, colon));
      const std::string value(pair.substr(std::min(colon + 1, pair.size())));
      const SettingField* field = find_setting(key);
      Settings scratch;
      if (field == nullptr) {
        problem = "no setting is called '" + key + "'";
      } else if (const auto wrong = set_setting(*field, value, scratch)) {
        problem = key + " " + *wrong;
      } else {
        overrides.push_back({key, value});
      }
    }
    if (!overrides.empty()) runs.push_back(std::move(overrides));  // else it is invalid
  }
  if (runs.size() > kMostCompared) {
    problem = "must have at most " + std::to_string(kMostCompared) + " methods";
    runs.resize(kMostCompared);
  }
  return runs;
}

std::string overrides_title(const Overrides& overrides, const Settings& session) {
  if (overrides.empty()) return "the same";
  const Settings effective = with_overrides(session, overrides);
  const bool has_n = std::any_of(overrides.begin(), overrides.end(),
                                 [](const Override& o) { return o.key == "n"; });
  std::string title;
  for (const Override& o : overrides) {
    if (belongs_to_another(effective, o.key)) continue;
    if (o.key == "mode" && o.value == "const" && has_n) continue;  // "constant 6" implies it
    if (!title.empty()) title += ", ";
    if (o.key == "solver") {
      title += title_of<SolverKind>(o.value);
    } else if (o.key == "n") {
      title += "constant " + o.value;
    } else if (o.key == "integrator") {
      title += title_of<Integrator>(o.value);
    } else {
      title += o.key == "mode" ? o.value : (o.key == "alpha" ? "α" : o.key) + " " + o.value;
    }
  }
  return title;
}

}  // namespace substep
