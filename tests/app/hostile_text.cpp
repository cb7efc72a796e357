// Mutations of valid scene files and lists of experiments.

#include <algorithm>
#include <string>
#include <string_view>

#include "tests/app/hostile_dice.hpp"

namespace substep {
namespace {

constexpr std::string_view kNumbers[] = {"0",          "-0",    "-1",          "1e-300", "1e300",
                                         "1.8e308",    "1e999", "-1e999",      "NaN",    "1e-5",
                                         "1e12",       "00001", "1.5",         "0.1",    "65",
                                         "4294967296", "1e4",   "-2147483649", "7",      "1000000"};

constexpr std::string_view kWords[] = {"null",
                                       "true",
                                       "[]",
                                       "{}",
                                       "\"\"",
                                       "\"world\"",
                                       "\"rod\"",
                                       "\"\\u001b[31mred\"",
                                       "\"\x1b]0;title\x07\"",
                                       "\"\x9b"
                                       "31m\"",
                                       "\"\\ud800\"",
                                       "\"../../name\"",
                                       "\"%s%n%d\"",
                                       "[1,2]",
                                       "[[[[[[]]]]]]",
                                       "\"pgs\"",
                                       "\"stiffness\"",
                                       "\"implicit\""};

constexpr std::string_view kPieces[] = {"\x1b[2J",
                                        "\"\\u001b[31m\": 1,",
                                        "\"\x1b[31m\": 1,",
                                        "\"unknown\\n\": {},",
                                        ",",
                                        "}",
                                        "]",
                                        "{\"a\": ",
                                        "//",
                                        "\xff\xfe",
                                        "\xef\xbb\xbf",
                                        "\r",
                                        "\n",
                                        "\"effects\": [\"contact\"],",
                                        "\"settings\": {\"mode\": \"adaptive\"},",
                                        "\"gravity\": [0, -9.81, 0],"};

/// Start of a random number in the text, or npos; `end` is its end.
std::size_t some_number(const std::string& text, Dice& dice, std::size_t& end) {
  constexpr std::string_view kOf = "0123456789+-.eE";
  const std::size_t from = text.find_first_of("0123456789", dice.below(text.size()));
  if (from == std::string::npos) return from;
  end = std::min(text.find_first_not_of(kOf, from), text.size());
  return from;
}

/// Start of a random value after a key of the text, or npos; `end` is its end.
std::size_t some_value(const std::string& text, Dice& dice, std::size_t& end) {
  const std::size_t colon = text.find(": ", dice.below(text.size()));
  if (colon == std::string::npos) return colon;
  end = std::min(text.find_first_of(",\n}", colon), text.size());
  return std::min(colon + 2, end);
}

void change_numbers(std::string& text, Dice& dice) {
  std::size_t end = 0;
  const std::size_t from = some_number(text, dice, end);
  if (from != std::string::npos) text.replace(from, end - from, dice.pick(kNumbers));
}

void change_value(std::string& text, Dice& dice) {
  std::size_t end = 0;
  const std::size_t from = some_value(text, dice, end);
  if (from != std::string::npos) text.replace(from, end - from, dice.pick(kWords));
}

void insert_piece(std::string& text, Dice& dice) {
  text.insert(dice.below(text.size()), dice.pick(kPieces));
}

/// Inserts a random piece after a brace or a comma, where a key may occur.
void insert_key(std::string& text, Dice& dice) {
  const std::size_t at = text.find_first_of("{,", dice.below(text.size()));
  if (at != std::string::npos) text.insert(at + 1, dice.pick(kPieces));
}

void change_byte(std::string& text, Dice& dice) {
  text[dice.below(text.size())] = static_cast<char>(dice.below(256));
}

void cut(std::string& text, Dice& dice) { text.resize(1 + dice.below(text.size())); }

void remove_some(std::string& text, Dice& dice) {
  text.erase(dice.below(text.size()), 1 + dice.below(40));
}

void repeat_some(std::string& text, Dice& dice) {
  const std::size_t from = dice.below(text.size());
  const std::string piece = text.substr(from, 1 + dice.below(400));
  const std::size_t times = dice.one_in(10) ? 1000 : 1 + dice.below(3);
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += piece;
  text.insert(from, all);
}

void nest_deep(std::string& text, Dice& dice) {
  std::size_t end = 0;
  const std::size_t from = some_value(text, dice, end);
  if (from != std::string::npos) text.replace(from, end - from, std::string(100000, '['));
}

}  // namespace

std::string mutated(std::string text, Dice& dice) {
  using Change = void (*)(std::string&, Dice&);
  // Changed numbers and values usually remain valid JSON and reach the furthest into the reader.
  static constexpr Change kChanges[] = {
      change_numbers, change_numbers, change_numbers, change_numbers, change_value, change_value,
      insert_piece,   insert_key,     insert_key,     change_byte,    cut,          remove_some,
      repeat_some,    nest_deep};
  for (std::size_t left = 1 + dice.below(4); left > 0 && !text.empty(); --left) {
    dice.pick(kChanges)(text, dice);
  }
  return text;
}

std::string crowd(std::size_t n, bool at_one_point) {
  std::string text =
      R"({"format": "substep-scene", "version": 1, "name": "crowd", "title": "A crowd",
 "effects": ["gravity", "contact"], "gravity": [0, -9.81, 0], "bodies": [
)";
  for (std::size_t i = 0; i < n; ++i) {
    const double x = at_one_point ? 0.0 : 0.9 * static_cast<double>(i);
    text += i == 0 ? "" : ",\n";
    text += R"({"name": "s)" + std::to_string(i) +
            R"(", "shape": {"type": "sphere", "radius": 0.5}, "mass": 1, "position": [)" +
            std::to_string(x) + ", 1, 0]}";
  }
  return text + "]}\n";
}

}  // namespace substep
