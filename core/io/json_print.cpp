#include "core/io/json.hpp"

#include "core/model/number_text.hpp"

namespace substep {
namespace {

/// Lists of plain values, and objects of one or two entries that hold no object, read best on a
/// line.
bool on_one_line(const Json& json) {
  if (json.is_object() && json.size() > 2) return false;
  for (const Json& item : json) {
    if (item.is_object() || (json.is_array() && item.is_array())) return false;
  }
  return true;
}

void print(const Json& json, const std::string& indent, std::string& out) {
  if (const auto* number = json.get_ptr<const double*>()) {
    out += number_text(*number);
    return;
  }
  if (!json.is_structured()) {
    out += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const bool one_line = on_one_line(json);
  const std::string inner = indent + "  ";
  const char* separator = "";
  out += json.is_object() ? '{' : '[';
  for (const auto& item : json.items()) {
    out += separator;
    separator = one_line ? ", " : ",";
    if (!one_line) out += "\n" + inner;
    if (json.is_object())
      out += Json(item.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    print(item.value(), inner, out);
  }
  if (!one_line) out += "\n" + indent;
  out += json.is_object() ? '}' : ']';
}

}  // namespace

std::string json_file(const Json& json) {
  std::string out;
  print(json, "", out);
  out += '\n';
  return out;
}

}  // namespace substep
