#include "core/io/json_text.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/io/text_places.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

/// The library's message without its prefix, in plain ASCII whatever bytes the text has.
std::string plain_message(std::string message) {
  const std::size_t column = message.find("column ");
  const std::size_t colon = message.find(": ", column == std::string::npos ? 0 : column);
  if (colon != std::string::npos) message.erase(0, colon + 2);
  const auto unprintable = [](char c) { return c < ' ' || c > '~'; };
  std::replace_if(message.begin(), message.end(), unprintable, '?');
  return message;
}

/// Builds the document while the library parses the text; checks nesting, the number of values, and
/// duplicate keys.
class Builder {
 public:
  Builder(std::string_view text, Problems& problems) : text_(text), problems_(problems) {}

  // A number beyond the range of doubles at the current position: offset and length in the text.
  std::size_t overflow_begin = 0;
  std::size_t overflow_size = 0;
  Json document;

  // What nlohmann::json::sax_parse calls; false stops it.
  bool null() { return value(nullptr); }
  bool boolean(bool x) { return value(x); }
  bool number_integer(Json::number_integer_t x) { return value(x); }
  bool number_unsigned(Json::number_unsigned_t x) { return value(x); }
  bool number_float(Json::number_float_t x, const std::string&) { return value(x); }
  bool string(std::string& x) { return value(std::move(x)); }
  bool binary(Json::binary_t&) { return false; }  // text has none
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    Level& level = levels_.back();
    level.member = level.find(key);
    if (level.member == nullptr) {
      level.member = level.append(std::move(key));
    } else if (problems_.size() <= kMaxProblems) {
      problems_.push_back({pointer(), "the key occurs twice in this object"});
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) {
    constexpr int kOutOfRange = 406;
    if (error.id == kOutOfRange && token.size() <= position) {
      value(nullptr);  // so that the pointer is that of the number
      problems_.push_back({pointer(), token + " is beyond the range of numbers (1.8e308)"});
      overflow_begin = position - token.size();
      overflow_size = token.size();
    } else {
      const std::size_t offset = position == 0 ? 0 : position - 1;
      problems_.push_back({"", place_text(place_at(text_, offset)) + plain_message(error.what())});
    }
    return false;
  }

 private:
  using Member = Json::object_t::value_type;

  /// An object or a list that is open. The library's own look-up takes time proportional to the
  /// number of keys; a large object has an index beside it.
  struct Level {
    static constexpr std::size_t kTypical = 8;
    static constexpr std::size_t kSmall = 16;

    Json* json;
    Member* member = nullptr;                  // of an object, the last one
    std::map<std::string, std::size_t> index;  // of an object with more than kSmall keys

    // Its operator[] takes keys.
    static Member& at(Json::object_t& object, std::size_t i) {
      return *(object.begin() + static_cast<std::ptrdiff_t>(i));
    }
    Member* find(const std::string& key) {
      auto& object = json->get_ref<Json::object_t&>();
      if (object.size() <= kSmall) {
        const auto same = [&](const Member& known) { return known.first == key; };
        const auto found = std::find_if(object.begin(), object.end(), same);
        return found == object.end() ? nullptr : &*found;
      }
      const auto found = index.find(key);
      return found == index.end() ? nullptr : &at(object, found->second);
    }
    Member* append(std::string key) {
      auto& object = json->get_ref<Json::object_t&>();
      if (object.empty()) object.reserve(kTypical);  // growing copies the keys
      object.push_back(Member(std::move(key), nullptr));
      for (std::size_t i = index.size(); object.size() > kSmall && i < object.size(); ++i) {
        index.emplace(at(object, i).first, i);
      }
      return &object.back();
    }
  };

  /// Inserts a value at the current position. @return the stored value, or null if there are too
  /// many
  template <class T>
  Json* put(T&& x) {
    if (++values_ > kMaxJsonValues) {
      problems_.push_back({"", "more than " + std::to_string(kMaxJsonValues) + " values"});
      return nullptr;
    }
    if (levels_.empty()) return &(document = std::forward<T>(x));
    Level& level = levels_.back();
    if (level.json->is_object()) return &(level.member->second = std::forward<T>(x));
    auto& list = level.json->get_ref<Json::array_t&>();
    return &list.emplace_back(std::forward<T>(x));
  }
  template <class T>
  bool value(T&& x) {
    return put(std::forward<T>(x)) != nullptr;
  }
  bool open(Json container) {
    Json* opened = put(std::move(container));
    if (opened == nullptr) return false;
    if (levels_.size() == kMaxJsonDepth) {
      problems_.push_back(
          {pointer(), "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels"});
      return false;
    }
    levels_.push_back({opened, nullptr, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }
  [[nodiscard]] std::string pointer() const {
    std::string result;
    for (const Level& level : levels_) {
      if (level.json->is_array()) {
        if (level.json->empty()) break;
        result = pointer_to(result, level.json->size() - 1);
      } else if (level.member != nullptr) {
        result = pointer_to(result, level.member->first);
      }
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
    return fail(too_many(text.size(), kMaxTextSize, "bytes (32 MiB)"));
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return fail("the file is empty");
  if (text[text.find_first_not_of(" \t\r\n")] == '<') {
    return fail("is XML: scenes are JSON; `substep import` makes one of a model in MJCF or URDF");
  }
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    return fail(place_text(place_at(text, zero)) + "a zero byte: this is not a text file");
  }

  // A number beyond the range stops the library. It is recorded and replaced by null, and parsing
  // starts again.
  constexpr int kMostOverflows = 32;
  std::string copy(text);
  for (int overflows = 0;; ++overflows) {
    Problems found;
    Builder builder(copy, found);
    const bool ok = Json::sax_parse(copy, &builder);
    if (ok || builder.overflow_size == 0 || overflows == kMostOverflows) {
      problems.insert(problems.end(), found.begin(), found.end());
      if (!ok) return std::nullopt;
      return std::move(builder.document);
    }
    // Duplicate keys are found again by the next pass.
    problems.push_back(found.back());
    const std::string null = "null" + std::string(builder.overflow_size - 4, ' ');
    copy.replace(builder.overflow_begin, builder.overflow_size, null);
  }
}

std::string value_text(const Json& value) {
  constexpr std::size_t kLongest = 60;
  if (const auto* number = value.get_ptr<const double*>()) return number_text(*number);
  if (value.is_object()) return "an object";
  if (value.is_array() && value.size() > 8)
    return "a list of " + std::to_string(value.size()) + " items";
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
  return text;
}

}  // namespace substep
