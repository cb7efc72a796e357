#include "core/io/json_text.hpp"

#include <algorithm>
#include <set>

#include "core/model/number_text.hpp"

namespace substep {
namespace {

/// "line 3, column 14: "
std::string place(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t newline = before.rfind('\n');
  const std::size_t column =
      newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": ";
}

/// The library's message without its prefix, in plain ASCII whatever bytes the text has.
std::string plain_message(std::string message) {
  const std::size_t column = message.find("column ");
  const std::size_t colon = message.find(": ", column == std::string::npos ? 0 : column);
  if (colon != std::string::npos) message.erase(0, colon + 2);
  const auto unprintable = [](char c) { return c < ' ' || c > '~'; };
  std::replace_if(message.begin(), message.end(), unprintable, '?');
  return message;
}

/// Walks through the text once before a document is made: syntax, nesting, keys that stand twice.
class Check {
 public:
  Check(std::string_view text, Problems& problems) : text_(text), problems_(problems) {}

  // A number that left the range of doubles, where the walk stopped: offset and length in the text.
  std::size_t overflow_begin = 0;
  std::size_t overflow_size = 0;

  // What nlohmann::json::sax_parse calls; false stops it.
  bool null() { return value(); }
  bool boolean(bool) { return value(); }
  bool number_integer(Json::number_integer_t) { return value(); }
  bool number_unsigned(Json::number_unsigned_t) { return value(); }
  bool number_float(Json::number_float_t, const std::string&) { return value(); }
  bool string(std::string&) { return value(); }
  bool binary(Json::binary_t&) { return value(); }
  bool start_object(std::size_t) { return value() && open(false); }
  bool start_array(std::size_t) { return value() && open(true); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    if (!level.keys.insert(key).second && problems_.size() <= kMaxProblems) {
      problems_.push_back({pointer(), "the key stands twice in this object"});
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) {
    constexpr int kOutOfRange = 406;
    if (error.id == kOutOfRange && token.size() <= position) {
      value();  // so that the pointer is that of the number
      problems_.push_back({pointer(), token + " is beyond the range of numbers (1.8e308)"});
      overflow_begin = position - token.size();
      overflow_size = token.size();
    } else {
      const std::size_t offset = position == 0 ? 0 : position - 1;
      problems_.push_back({"", place(text_, offset) + plain_message(error.what())});
    }
    return false;
  }

 private:
  struct Level {
    bool is_array = false;
    std::size_t items = 0;       // of an array, so far
    std::string key;             // of an object, the last one
    std::set<std::string> keys;  // of an object
  };

  bool value() {
    if (!levels_.empty()) ++levels_.back().items;
    if (++values_ <= kMaxJsonValues) return true;
    problems_.push_back({"", "more than " + std::to_string(kMaxJsonValues) + " values"});
    return false;
  }
  bool open(bool is_array) {
    if (levels_.size() == kMaxJsonDepth) {
      problems_.push_back(
          {pointer(), "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels"});
      return false;
    }
    levels_.push_back({is_array, 0, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }
  [[nodiscard]] std::string pointer() const {
    std::string result;
    for (const Level& level : levels_) {
      if (level.is_array && level.items == 0) break;
      result = level.is_array ? pointer_to(result, level.items - 1) : pointer_to(result, level.key);
    }
    return result;
  }

  std::string_view text_;
  Problems& problems_;
  std::vector<Level> levels_;
  std::size_t values_ = 0;
};

}  // namespace

std::optional<Json> parse_json(std::string_view text, Problems& problems) {
  const auto fail = [&](std::string message) {
    problems.push_back({"", std::move(message)});
    return std::nullopt;
  };
  if (text.size() > kMaxTextSize) {
    return fail(std::to_string(text.size()) + " bytes are more than " +
                std::to_string(kMaxTextSize) + " (32 MiB)");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return fail("the file is empty");
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    return fail(place(text, zero) + "a zero byte: this is not a text file");
  }

  // A number beyond the range stops the library. It is noted and replaced, and the walk starts
  // again.
  constexpr int kMostOverflows = 32;
  std::string copy(text);
  for (int overflows = 0;; ++overflows) {
    Problems found;
    Check check(copy, found);
    const bool ok = Json::sax_parse(copy, &check);
    if (ok || check.overflow_size == 0 || overflows == kMostOverflows) {
      problems.insert(problems.end(), found.begin(), found.end());
      if (!ok) return std::nullopt;
      return Json::parse(copy, nullptr, false);
    }
    // Keys that stand twice are found again by the next walk.
    problems.push_back(found.back());
    const std::string null = "null" + std::string(check.overflow_size - 4, ' ');
    copy.replace(check.overflow_begin, check.overflow_size, null);
  }
}

std::string value_text(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (const auto* number = value.get_ptr<const double*>()) return number_text(*number);
  if (value.is_object()) return "an object";
  if (value.is_array() && value.size() > 8) return "a list of " + std::to_string(value.size());
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

}  // namespace substep
