#include "core/lab/engines.hpp"

#include <algorithm>

#include "core/model/format_text.hpp"

namespace substep {

const Engine* engine_of(std::string_view name) {
  const auto found = std::find_if(kEngines.begin(), kEngines.end(),
                                  [&](const Engine& engine) { return engine.name == name; });
  return found == kEngines.end() ? nullptr : &*found;
}

std::string setting_of(const Engine& engine, double step, int count) {
  std::string text = engine.step;
  const auto put = [&](std::string_view mark, const std::string& value) {
    if (const std::size_t at = text.find(mark); at != std::string::npos) {
      text.replace(at, mark.size(), value);
    }
  };
  put("%1", format_text("%.3g", step));
  put("%2", std::to_string(count));
  return text;
}

}  // namespace substep
