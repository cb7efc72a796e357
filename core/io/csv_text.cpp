#include "core/io/csv_text.hpp"

#include <cmath>

#include "core/model/number_text.hpp"

namespace substep {

std::string csv_number(double x) {
  if (std::isfinite(x)) return number_text(x);
  return std::isnan(x) ? "nan" : x > 0.0 ? "inf" : "-inf";
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    field += c;
    if (c == '"') field += c;
  }
  return field + '"';
}

}  // namespace substep
