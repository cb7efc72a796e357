#include "core/model/idle_settings.hpp"

#include <algorithm>
#include <vector>

#include "core/model/names.hpp"

namespace substep {
namespace {

/// "a, b and c"
std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text.append(i == 0 ? "" : i + 1 == names.size() ? " and " : ", ").append(names[i]);
  }
  return text;
}

std::string not_read(std::string_view kind, std::string_view chosen,
                     const std::vector<std::string_view>& by) {
  return std::string(kind).append(" ").append(chosen).append(" does not read it, only ") +
         listed(by);
}

/// @param table kSolvers or kModes  @return nothing if the chosen entry reads the setting, or none
std::optional<std::string> idle_in(const auto& table, std::string_view kind, const auto& chosen,
                                   std::string_view setting) {
  const auto reads = [setting](const auto& entry) {
    return std::find(entry.reads.begin(), entry.reads.end(), setting) != entry.reads.end();
  };
  std::vector<std::string_view> readers;
  for (const auto& entry : table) {
    if (reads(entry)) readers.push_back(entry.name);
  }
  if (readers.empty() || reads(chosen)) return std::nullopt;
  return not_read(kind, chosen.name, readers);
}

}  // namespace

std::optional<std::string> idle_reason(const Settings& s, std::string_view setting) {
  if (auto idle = idle_in(kSolvers, "solver", entry_of(s.solver), setting)) return idle;
  if (auto idle = idle_in(kModes, "mode", entry_of(s.mode), setting)) return idle;
  if (setting == "memory" && s.policy != Policy::kSubstep) {
    return not_read("policy", name_of(s.policy), {name_of(Policy::kSubstep)});
  }
  if (setting == "tau" && drift_law(s) != Drift::kSoft) {
    return not_read("drift law", name_of(drift_law(s)), {name_of(Drift::kSoft)});
  }
  return std::nullopt;
}

}  // namespace substep
