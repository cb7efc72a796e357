#include "app/text/caption.hpp"

#include "app/text/format.hpp"
#include "core/model/number_text.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {

std::string with_values(std::string_view text, const Settings& settings) {
  std::string filled;
  while (true) {
    const std::size_t open = text.find('{');
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = text.find('}', open);
    const SettingField& field = *find_setting(text.substr(open + 1, close - open - 1));
    const std::string value = setting_text(field, settings);
    const bool is_count = std::holds_alternative<CountSetting>(field.member);
    const auto number = parse_number(value);
    filled += !number ? value : is_count ? grouped(*number) : plain_number(*number);
    text.remove_prefix(close + 1);
  }
}

}  // namespace substep
