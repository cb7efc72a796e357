#include "app/lab/text_history.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace substep {
namespace {

/// Whether a byte continues a character of UTF-8.
bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U; }

bool is_one_character(std::string_view text) {
  return !text.empty() && std::all_of(text.begin() + 1, text.end(), continues);
}

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Whether a letter that follows another begins the next word or line.
bool begins_word(char before, char next) {
  return next == '\n' || (is_space(before) && !is_space(next));
}

}  // namespace

TextChange difference(std::string_view before, std::string_view after) {
  const std::size_t most = std::min(before.size(), after.size());
  std::size_t front = 0;
  while (front < most && before[front] == after[front]) ++front;
  std::size_t back = 0;
  while (back < most - front &&
         before[before.size() - 1 - back] == after[after.size() - 1 - back]) {
    ++back;
  }
  const auto splits = [&](std::size_t at, std::string_view text) {
    return at < text.size() && continues(text[at]);
  };
  while (front > 0 && (splits(front, before) || splits(front, after))) --front;
  while (back > 0 && (splits(before.size() - back, before) || splits(after.size() - back, after))) {
    --back;
  }
  return {front, std::string(before.substr(front, before.size() - back - front)),
          std::string(after.substr(front, after.size() - back - front))};
}

void TextHistory::add(TextChange change) {
  if (change.bytes() == 0) return;
  while (can_redo()) {
    bytes_ -= changes_.back().bytes();
    changes_.pop_back();
  }
  bytes_ += change.bytes();
  if (!join(change)) {
    changes_.push_back(std::move(change));
    done_ = changes_.size();
    joins_ = true;
  }
  while (bytes_ > most_) {
    bytes_ -= changes_.front().bytes();
    changes_.pop_front();
    --done_;
  }
}

// Extends the last change by a letter.
bool TextHistory::join(const TextChange& change) {
  if (!joins_ || changes_.empty()) return false;
  TextChange& last = changes_.back();
  if (last.removed.empty() && change.removed.empty()) {
    if (change.at != last.at + last.inserted.size() || !is_one_character(change.inserted) ||
        begins_word(last.inserted.back(), change.inserted.front())) {
      return false;
    }
    last.inserted += change.inserted;
    return true;
  }
  if (!last.inserted.empty() || !change.inserted.empty() || !is_one_character(change.removed)) {
    return false;
  }
  if (change.at == last.at) {  // with Delete
    last.removed += change.removed;
    return true;
  }
  if (change.at + change.removed.size() != last.at) return false;
  last.removed.insert(0, change.removed);  // with Backspace
  last.at = change.at;
  return true;
}

const TextChange* TextHistory::undo() {
  joins_ = false;
  if (!can_undo()) return nullptr;
  last_ = changes_[--done_].inverse();
  return &last_;
}

const TextChange* TextHistory::redo() {
  joins_ = false;
  if (!can_redo()) return nullptr;
  last_ = changes_[done_++];
  return &last_;
}

void TextHistory::clear() {
  changes_.clear();
  done_ = bytes_ = 0;
  joins_ = false;
}

}  // namespace substep
