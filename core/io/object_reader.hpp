#pragma once
// Reads the members of one JSON object and collects all problems.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/json_text.hpp"
#include "core/math/types.hpp"
#include "core/model/names.hpp"
#include "core/model/place.hpp"
#include "core/model/problem.hpp"
#include "core/model/range.hpp"

namespace substep {

enum class Presence { kRequired, kOptional };
using enum Presence;

/// Members that are read are known; finish() reports all others. A missing or invalid member leaves
/// its target unchanged. Each function returns true if it set its target.
class ObjectReader {
 public:
  /// Adds a problem if json is not an object; the reader then has no members.
  ObjectReader(const Json& json, std::string pointer, Problems& problems);

  bool number(std::string_view key, const Range& range, double& target, Presence presence);
  bool integer(std::string_view key, int least, int most, int& target, Presence presence);
  bool flag(std::string_view key, bool& target, Presence presence);
  /// @param longest allowed [bytes]; characters that text_fault() refuses are not allowed
  bool text(std::string_view key, std::size_t longest, std::string& target, Presence presence);
  /// The index of one of the names, or nothing.
  std::optional<std::size_t> choice(std::string_view key, std::span<const std::string_view> names,
                                    Presence presence);
  /// The value of an enumeration by its name, or nothing.
  template <class Enum>
  std::optional<Enum> choice(std::string_view key, Presence presence) {
    const auto index = choice(key, kNames<Enum>, presence);
    return index ? std::optional(static_cast<Enum>(*index)) : std::nullopt;
  }
  /// Three numbers, each in the range.
  bool vector(std::string_view key, const Range& range, Vec3& target, Presence presence);
  /// `size` numbers, each in the range.
  bool numbers(std::string_view key, const Range& range, double* target, std::size_t size,
               Presence presence);
  /// `rows` lists of `columns` numbers each, one after the other.
  bool table(std::string_view key, const Range& range, double* target, std::size_t rows,
             std::size_t columns, Presence presence);
  /// The member, or null if it is missing, not a list or longer than `most`.
  const Json* list(std::string_view key, std::size_t most, Presence presence);
  /// The raw member, or null.
  const Json* member(std::string_view key, Presence presence);

  /// A reader of a member that is an object.
  [[nodiscard]] ObjectReader inner(std::string_view key, const Json& member) const {
    return {member, pointer(key), problems_};
  }

  /// A problem of one member, or of the object itself where key is "".
  void problem(std::string_view key, std::string message);
  /// A problem of one item of a list.
  void item_problem(std::string_view key, std::size_t item, std::string message);
  /// Adds a problem for every unread member, with a suggestion.
  void finish();
  /// " (did you mean ...?)", or "". Suggestions are slow, so only the first problems get one.
  [[nodiscard]] std::string guess(std::string_view word,
                                  const std::vector<std::string_view>& candidates) const;

  [[nodiscard]] bool is_object() const { return json_ != nullptr; }
  [[nodiscard]] std::string pointer(std::string_view key) const;

 private:
  /// The fault of a number; sets the target if there is none.
  static std::optional<std::string> number_fault(const Json& value, const Range& range,
                                                 double& target);
  bool row(const Json& value, const DataPlace& place, const Range& range, double* target,
           std::size_t size);

  const Json* json_ = nullptr;
  std::string pointer_;
  Problems& problems_;
  std::vector<std::string_view> known_;
};

/// The candidate within a small edit distance: `did you mean "mass"?` in brackets, or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace substep
