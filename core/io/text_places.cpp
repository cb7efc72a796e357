#include "core/io/text_places.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "core/io/json_text.hpp"

namespace substep {
namespace {

/// The pointers of problems as a tree: one node per object, list, member or item on the way.
struct PlaceNode {
  std::map<std::string, PlaceNode, std::less<>> inner;
  TextPlace place;
  // Of two members with the same key the last one counts, and only what is within that one.
  std::size_t visit = 0;         // number of the last visit, 0 if the text has no such value
  std::size_t visit_around = 0;  // that of the node around it, at that time
};

/// The parts of a pointer, unescaped (RFC 6901).
std::vector<std::string> pointer_parts(std::string_view pointer) {
  std::vector<std::string> parts;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);  // the slash
    const std::string_view part = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(part.size());
    std::string& plain = parts.emplace_back();
    for (std::size_t i = 0; i < part.size(); ++i) {
      const bool escape = part[i] == '~' && i + 1 < part.size();
      plain += !escape ? part[i] : part[++i] == '1' ? '/' : '~';
    }
  }
  return parts;
}

/// The string that begins at a quotation mark, with its escapes resolved.
std::string unescaped(std::string_view quoted) {
  if (quoted.find('\\') == std::string_view::npos) {
    return std::string(quoted.substr(1, quoted.size() - std::min<std::size_t>(2, quoted.size())));
  }
  const Json value = Json::parse(quoted, nullptr, false);
  const auto* text = value.get_ptr<const std::string*>();
  return text != nullptr ? *text : "";
}

/// Goes through the text once and notes the places of the nodes.
class PlaceScan {
 public:
  PlaceScan(std::string_view text, PlaceNode& root)
      : text_(text), line_end_(text.find('\n')), next_(&root) {}

  void run() {
    while (at_ < text_.size() && step()) {
    }
  }

 private:
  struct Level {
    PlaceNode* node;  // null if no problem is within it
    bool is_object;
    std::size_t item = 0;  // of a list
  };

  // One token. @return false if the rest is no JSON, or nested too deeply
  bool step() {
    const char c = text_[at_];
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ':') {
      ++at_;
      return true;
    }
    if (c == '}' || c == ']' || c == ',') {
      ++at_;
      if (levels_.empty()) return false;
      if (c == ',') {
        ++levels_.back().item;
      } else {
        levels_.pop_back();
      }
      key_follows_ = c == ',' && levels_.back().is_object;
      next_ = nullptr;
      return true;
    }
    if (key_follows_) return key();
    begin_value();
    if (c == '{' || c == '[') {
      ++at_;
      if (levels_.size() > kMaxJsonDepth) return false;
      levels_.push_back({next_, c == '{'});
      key_follows_ = c == '{';
      next_ = nullptr;
      return true;
    }
    at_ = c == '"' ? end_of_string() : text_.find_first_of(" \t\r\n,]}", at_);
    at_ = std::min(at_, text_.size());
    return true;
  }

  bool key() {
    if (text_[at_] != '"') return false;
    const std::size_t end = end_of_string();
    next_ = nullptr;
    if (PlaceNode* node = levels_.back().node; node != nullptr) {
      const auto found = node->inner.find(unescaped(text_.substr(at_, end - at_)));
      if (found != node->inner.end()) next_ = &found->second;
    }
    visit(next_);
    at_ = end;
    key_follows_ = false;
    is_member_ = true;
    return true;
  }

  // The value of a member was visited at its key.
  void begin_value() {
    const bool in_list = !levels_.empty() && !levels_.back().is_object;
    if (in_list) {
      PlaceNode* node = levels_.back().node;
      next_ = nullptr;
      if (node != nullptr) {
        const auto found = node->inner.find(std::to_string(levels_.back().item));
        if (found != node->inner.end()) next_ = &found->second;
      }
    }
    if (!is_member_) visit(next_);
    is_member_ = false;
  }

  void visit(PlaceNode* node) {
    if (node == nullptr) return;
    // Places are visited in the order of the text, so that newlines are counted once.
    while (line_end_ < at_) {
      ++line_;
      line_begin_ = line_end_ + 1;
      line_end_ = text_.find('\n', line_begin_);
    }
    node->place = {line_, at_ - line_begin_ + 1};
    node->visit = ++visits_;
    node->visit_around =
        levels_.empty() || levels_.back().node == nullptr ? 0 : levels_.back().node->visit;
  }

  [[nodiscard]] std::size_t end_of_string() const {
    for (std::size_t i = at_ + 1; i < text_.size(); ++i) {
      if (text_[i] == '\\') {
        ++i;
      } else if (text_[i] == '"') {
        return i + 1;
      }
    }
    return text_.size();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;
  std::size_t line_end_;  // its newline, or npos
  std::size_t visits_ = 0;
  std::vector<Level> levels_;
  PlaceNode* next_;  // of the value that follows, or null
  bool key_follows_ = false;
  bool is_member_ = false;  // a key precedes the value that follows
};

TextPlace innermost_place(const PlaceNode& root, std::string_view pointer) {
  const PlaceNode* node = &root;
  for (const std::string& part : pointer_parts(pointer)) {
    const auto found = node->inner.find(part);
    if (found == node->inner.end() || found->second.visit == 0 ||
        found->second.visit_around != node->visit) {
      break;
    }
    node = &found->second;
  }
  return node->place;
}

}  // namespace

TextPlace place_at(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto newlines = std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  return {static_cast<std::size_t>(newlines) + 1,
          newline == std::string_view::npos ? before.size() + 1 : before.size() - newline};
}

std::size_t offset_of(std::string_view text, const TextPlace& place) {
  std::size_t begin = 0;
  for (std::size_t line = 1; line < place.line; ++line) {
    const std::size_t newline = text.find('\n', begin);
    if (newline == std::string_view::npos) return text.size();
    begin = newline + 1;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  return std::min(begin + std::max<std::size_t>(place.column, 1) - 1, end);
}

std::string place_text(const TextPlace& place) {
  return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column) + ": ";
}

std::optional<TextPlace> take_place(std::string& message) {
  std::string_view rest = message;
  const auto number_after = [&rest](std::string_view word) -> std::optional<std::size_t> {
    constexpr std::size_t kDigits = 18;
    if (!rest.starts_with(word)) return std::nullopt;
    rest.remove_prefix(word.size());
    std::size_t number = 0;
    std::size_t digits = 0;
    for (; !rest.empty() && std::isdigit(static_cast<unsigned char>(rest[0])) != 0; ++digits) {
      number = 10 * number + static_cast<std::size_t>(rest[0] - '0');
      rest.remove_prefix(1);
    }
    return digits > 0 && digits <= kDigits ? std::optional(number) : std::nullopt;
  };
  const auto line = number_after("line ");
  const auto column = line ? number_after(", column ") : std::nullopt;
  if (!column || !rest.starts_with(": ")) return std::nullopt;
  message.erase(0, message.size() - rest.size() + 2);
  return TextPlace{*line, *column};
}

std::vector<TextPlace> places_of(const Problems& problems, std::string_view text) {
  PlaceNode root;
  for (const Problem& problem : problems) {
    PlaceNode* node = &root;
    for (std::string& part : pointer_parts(problem.pointer)) node = &node->inner[std::move(part)];
  }
  PlaceScan(text, root).run();
  std::vector<TextPlace> places;
  for (const Problem& problem : problems) {
    std::string message = problem.pointer.empty() ? problem.message : "";
    const std::optional<TextPlace> own = take_place(message);
    places.push_back(own ? *own : innermost_place(root, problem.pointer));
  }
  return places;
}

}  // namespace substep
