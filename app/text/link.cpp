#include "app/text/link.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/model/number_text.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

constexpr std::array<std::string_view, 5> kAlways{"solver", "mode", "alpha", "n", "integrator"};

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.' || c == '~';
}

std::string encode(std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    if (is_plain(c)) {
      out += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      out += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  return out;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// The character of "%41" at the head of a text, if any. Control characters stay encoded: no name
/// contains them, and error messages could not show them.
std::optional<char> escaped(std::string_view text) {
  if (text.size() < 3 || text[0] != '%' || digit(text[1]) < 0 || digit(text[2]) < 0) return {};
  const int code = 16 * digit(text[1]) + digit(text[2]);
  if (code < 0x20 || code == 0x7f) return {};
  return static_cast<char>(code);
}

std::string decode(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::optional<char> character = escaped(text);
    out += character.value_or(text[0]);
    text.remove_prefix(character ? 3 : 1);
  }
  return out;
}

}  // namespace

std::string make_link(const Scene& scene, const Experiment& experiment) {
  std::string link = "scene=" + encode(scene.name);
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;  // display only
    const std::string value = setting_text(field, experiment.settings);
    const bool always = std::find(kAlways.begin(), kAlways.end(), field.name) != kAlways.end();
    if (!always && value == setting_text(field, scene.settings)) continue;
    link += '&';
    link += field.name;
    link += '=' + encode(value);
  }
  if (experiment.duration != scene.criteria.duration) {
    link += "&seconds=" + number_text(experiment.duration);
  }
  if (experiment.load != 1.0) link += "&load=" + number_text(experiment.load);
  if (experiment.seed != 0) link += "&seed=" + std::to_string(experiment.seed);
  return link;
}

std::vector<LinkPart> parse_link(std::string_view fragment) {
  std::vector<LinkPart> parts;
  if (fragment.starts_with('#')) fragment.remove_prefix(1);
  while (!fragment.empty()) {
    const std::string_view part = fragment.substr(0, fragment.find('&'));
    fragment.remove_prefix(std::min(part.size() + 1, fragment.size()));
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    LinkPart parsed{decode(part.substr(0, equals)), ""};
    if (equals != std::string_view::npos) parsed.value = decode(part.substr(equals + 1));
    parts.push_back(std::move(parsed));
  }
  return parts;
}

}  // namespace substep
