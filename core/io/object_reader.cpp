#include "core/io/object_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/model/scene_limits.hpp"
#include "core/model/text_checks.hpp"

namespace substep {
namespace {

/// Letters to insert, delete or replace (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  constexpr std::size_t kLongest = 64;  // longer words get no suggestion
  if (word.size() > kLongest) return "";
  std::string_view best;
  std::size_t best_distance = std::min<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string_view candidate : candidates) {
    if (word.size() > 2 && candidate.starts_with(word)) best = candidate;
    if (candidate.size() > word.size() + 2 || word.size() > candidate.size() + 2) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best.empty() ? "" : " (did you mean \"" + std::string(best) + "\"?)";
}

ObjectReader::ObjectReader(const Json& json, std::string pointer, Problems& problems)
    : pointer_(std::move(pointer)), problems_(problems) {
  if (json.is_object()) {
    json_ = &json;
  } else {
    problem("", must_be("an object", value_text(json)));
  }
}

std::string ObjectReader::pointer(std::string_view key) const {
  return key.empty() ? pointer_ : pointer_to(pointer_, key);
}

void ObjectReader::problem(std::string_view key, std::string message) {
  problems_.push_back({pointer(key), std::move(message)});
}

void ObjectReader::item_problem(std::string_view key, std::size_t item, std::string message) {
  problems_.push_back({pointer_to(pointer(key), item), std::move(message)});
}

const Json* ObjectReader::member(std::string_view key, Presence presence) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (!json_) return nullptr;
  const auto found = json_->find(std::string(key));
  if (found != json_->end()) return &*found;
  if (presence == kRequired) problem(key, "missing");
  return nullptr;
}

std::optional<std::string> ObjectReader::number_fault(const Json& value, const Range& range,
                                                      double& target) {
  if (!value.is_number()) return must_be("a number" + range.unit_text(), value_text(value));
  const auto x = value.get<double>();
  if (!range.contains(x)) return must_be(range.violated_by(x), value_text(value));
  target = x;
  return std::nullopt;
}

bool ObjectReader::number(std::string_view key, const Range& range, double& target,
                          Presence presence) {
  const Json* value = member(key, presence);
  if (!value) return false;
  const auto fault = number_fault(*value, range, target);
  if (fault) problem(key, *fault);
  return !fault;
}

bool ObjectReader::integer(std::string_view key, int least, int most, int& target,
                           Presence presence) {
  const Json* value = member(key, presence);
  if (!value) return false;
  const double x = value->is_number() ? value->get<double>() : std::nan("");
  if (!(x >= least && x <= most) || x != std::floor(x)) {
    problem(key,
            must_be("a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                    value_text(*value)));
    return false;
  }
  target = static_cast<int>(x);
  return true;
}

bool ObjectReader::flag(std::string_view key, bool& target, Presence presence) {
  const Json* value = member(key, presence);
  if (!value) return false;
  if (!value->is_boolean()) {
    problem(key, must_be("true or false", value_text(*value)));
    return false;
  }
  target = value->get<bool>();
  return true;
}

bool ObjectReader::text(std::string_view key, std::size_t longest, std::string& target,
                        Presence presence) {
  const Json* value = member(key, presence);
  if (!value) return false;
  const auto* words = value->get_ptr<const std::string*>();
  if (!words) {
    problem(key, must_be("a string", value_text(*value)));
    return false;
  }
  if (words->size() > longest) {
    problem(key, too_many(words->size(), longest, "bytes"));
  } else if (presence == kRequired && words->empty()) {
    problem(key, "must not be empty");
  } else if (const auto fault = text_fault(*words)) {
    problem(key, value_text(*value) + *fault);
  } else {
    target = *words;
    return true;
  }
  return false;
}

std::optional<std::size_t> ObjectReader::choice(std::string_view key,
                                                std::span<const std::string_view> names,
                                                Presence presence) {
  std::string name;
  if (!text(key, kMaxNameSize, name, presence)) return std::nullopt;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  problem(key, must_be(one_of(names), value_text(name)));
  return std::nullopt;
}

bool ObjectReader::row(const Json& value, const DataPlace& place, const Range& range,
                       double* target, std::size_t size) {
  if (!value.is_array() || value.size() != size) {
    const std::string list = "a list of " + std::to_string(size) + " numbers";
    problems_.push_back({place.pointer(), must_be(list + range.unit_text(), value_text(value))});
    return false;
  }
  std::vector<double> read(size);
  bool ok = true;
  for (std::size_t i = 0; i < size; ++i) {
    const auto fault = number_fault(value[i], range, read[i]);
    if (fault) problems_.push_back({place.at(i).pointer(), *fault});
    ok = ok && !fault;
  }
  if (ok) std::copy(read.begin(), read.end(), target);
  return ok;
}

bool ObjectReader::numbers(std::string_view key, const Range& range, double* target,
                           std::size_t size, Presence presence) {
  const Json* value = member(key, presence);
  const DataPlace here(pointer_);
  return value && row(*value, here.at(key), range, target, size);
}

bool ObjectReader::table(std::string_view key, const Range& range, double* target, std::size_t rows,
                         std::size_t columns, Presence presence) {
  const Json* value = member(key, presence);
  if (!value) return false;
  if (!value->is_array() || value->size() != rows) {
    problem(key, must_be("a list of " + std::to_string(rows) + " lists", value_text(*value)));
    return false;
  }
  bool ok = true;
  const DataPlace here(pointer_);
  const DataPlace list = here.at(key);
  for (std::size_t i = 0; i < rows && problems_.size() <= kMaxProblems; ++i) {
    ok = row((*value)[i], list.at(i), range, target + i * columns, columns) && ok;
  }
  return ok;
}

bool ObjectReader::vector(std::string_view key, const Range& range, Vec3& target,
                          Presence presence) {
  return numbers(key, range, target.data(), 3, presence);
}

const Json* ObjectReader::list(std::string_view key, std::size_t most, Presence presence) {
  const Json* list = member(key, presence);
  if (!list) return nullptr;
  if (!list->is_array()) {
    problem(key, must_be("a list", value_text(*list)));
    return nullptr;
  }
  if (list->size() > most) {
    problem(key, too_many(list->size(), most, "items"));
    return nullptr;
  }
  return list;
}

void ObjectReader::finish() {
  if (!json_) return;
  for (const auto& item : json_->items()) {
    if (problems_.size() > kMaxProblems) return;
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    std::string meant = guess(item.key(), known_);
    if (meant.empty()) meant = " (known here: " + one_of(known_) + ")";
    problem(item.key(), "unknown key" + meant);
  }
}

std::string ObjectReader::guess(std::string_view word,
                                const std::vector<std::string_view>& candidates) const {
  constexpr std::size_t kMostGuesses = 20;
  return problems_.size() < kMostGuesses ? did_you_mean(word, candidates) : "";
}

}  // namespace substep
