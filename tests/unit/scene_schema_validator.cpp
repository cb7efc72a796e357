#include <algorithm>
#include <regex>

#include "tests/unit/scene_schema_validator.hpp"

namespace substep::test {
namespace {

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  return type == "integer" && value.is_number_integer();
}

/// Whether a value satisfies one keyword of its schema, except for keywords that descend into it.
bool keeps(const std::string& keyword, const Json& rule, const Json& value) {
  if (keyword == "type") {
    const Json types = rule.is_array() ? rule : Json::array({rule});
    return std::any_of(types.begin(), types.end(),
                       [&](const Json& type) { return has_type(value, type.get<std::string>()); });
  }
  if (keyword == "const") return value == rule;
  if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
  if (keyword == "minimum") return !value.is_number() || value >= rule;
  if (keyword == "maximum") return !value.is_number() || value <= rule;
  if (keyword == "exclusiveMinimum") return !value.is_number() || value > rule;
  if (keyword == "exclusiveMaximum") return !value.is_number() || value < rule;
  if (keyword == "minItems") return !value.is_array() || value.size() >= rule;
  if (keyword == "maxItems") return !value.is_array() || value.size() <= rule;
  if (keyword == "minLength") return !value.is_string() || value.get<std::string>().size() >= rule;
  if (keyword == "maxLength") return !value.is_string() || value.get<std::string>().size() <= rule;
  if (keyword == "pattern") {
    return !value.is_string() ||
           std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
  }
  if (keyword == "uniqueItems") {
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (std::find(value.begin(), value.begin() + static_cast<std::ptrdiff_t>(i), value[i]) !=
          value.begin() + static_cast<std::ptrdiff_t>(i)) {
        return false;
      }
    }
    return true;
  }
  const auto words = {"$schema", "title", "description", "default", "$defs"};
  return std::find(words.begin(), words.end(), keyword) != words.end();
}

}  // namespace

std::vector<std::string> schema_errors(const Json& root, const Json& schema, const Json& value,
                                       const std::string& pointer) {
  std::vector<std::string> errors;
  const auto descend = [&](const Json& part, const Json& inner, const std::string& place) {
    const auto found = schema_errors(root, part, inner, place);
    errors.insert(errors.end(), found.begin(), found.end());
  };
  for (const auto& item : schema.items()) {
    const std::string& keyword = item.key();
    const Json& rule = item.value();
    if (keyword == "$ref") {
      descend(root.at(Json::json_pointer(rule.get<std::string>().substr(1))), value, pointer);
    } else if (keyword == "oneOf") {
      const auto fits = std::count_if(rule.begin(), rule.end(), [&](const Json& part) {
        return schema_errors(root, part, value, pointer).empty();
      });
      if (fits != 1) errors.push_back(pointer + ": oneOf");
    } else if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
        descend(rule, value[i], pointer + "/" + std::to_string(i));
      }
    } else if (keyword == "required") {
      for (const Json& key : rule) {
        if (!value.contains(key.get<std::string>())) errors.push_back(pointer + ": required");
      }
    } else if (keyword == "properties") {
      for (const auto& property : rule.items()) {
        if (value.contains(property.key())) {
          descend(property.value(), value[property.key()], pointer + "/" + property.key());
        }
      }
    } else if (keyword == "additionalProperties") {
      for (const auto& entry : value.items()) {
        if (!schema["properties"].contains(entry.key())) {
          errors.push_back(pointer + "/" + entry.key() + ": additionalProperties");
        }
      }
    } else if (!keeps(keyword, rule, value)) {
      errors.push_back(pointer + ": " + keyword);
    }
  }
  return errors;
}

}  // namespace substep::test
