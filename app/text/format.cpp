#include "app/text/format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/lab/energy_scale.hpp"

namespace substep {
namespace {

std::string print(double value, int digits) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string real_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string superscript(int value) {
  static constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                       "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = value < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(value))) {
    text += kDigits[static_cast<std::size_t>(c - '0')];
  }
  return text;
}

}  // namespace

std::string fixed(double value, int digits) {
  std::string text = print(value, digits);
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) {
    text.erase(0, 1);
  }
  return real_minus(text);
}

std::string power_of_ten(int exponent) {
  return exponent == 0 ? "1" : exponent == 1 ? "10" : "10" + superscript(exponent);
}

std::string grouped(double value) {
  std::string text = print(std::abs(value), 0);
  for (auto i = static_cast<int>(text.size()) - 3; i > 0; i -= 3) {
    text.insert(static_cast<std::size_t>(i), ",");
  }
  return (value <= -0.5 ? "−" : "") + text;
}

namespace {

std::string with_digits(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : value < 0 ? "−∞" : "∞";
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (exponent >= 5 || exponent < -3) {
    const double mantissa = value / std::pow(10.0, exponent);
    return fixed(mantissa, digits - 1) + "×10" + superscript(exponent);
  }
  return exponent >= 3 ? grouped(value) : fixed(value, std::max(0, digits - 1 - exponent));
}

// A smaller one is 0 in per cent with three digits.
constexpr double kLeastShare = 5e-6;

}  // namespace

std::string short_number(double value) { return with_digits(value, 3); }
std::string coarse_number(double value) { return with_digits(value, 2); }

std::string plain_number(double value) {
  const std::string text = short_number(value);
  const std::size_t end = std::min(text.find("×"), text.size());  // of the digits
  std::string digits = text.substr(0, end);
  if (digits.find('.') == std::string::npos) return text;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.ends_with('.')) digits.pop_back();
  return digits + text.substr(end);
}

Unit unit_for(double scale) {
  static constexpr std::array<const char*, 10> kPrefixes{"f", "p", "n", "µ", "m",
                                                         "",  "k", "M", "G", "T"};
  constexpr int kFirst = -5;  // the first's thousands
  const int last = kFirst + static_cast<int>(kPrefixes.size()) - 1;
  const int thousands =
      std::isfinite(scale) && scale > 0.0 ? static_cast<int>(std::floor(std::log10(scale) / 3)) : 0;
  const double factor = std::pow(10.0, 3 * thousands);
  if (thousands < kFirst || thousands > last) return {power_of_ten(3 * thousands) + " ", factor};
  return {kPrefixes.at(static_cast<std::size_t>(thousands - kFirst)), factor};
}

std::string energy_change(double joules) {
  if (joules == 0.0) return "0 J";
  const Unit unit = unit_for(std::abs(joules));
  return (joules > 0.0 ? "+" : "") + short_number(joules / unit.factor) + " " + unit.prefix + "J";
}

std::string energy_change(double joules, std::optional<double> scale) {
  const auto share = energy_share(joules, scale);
  if (!share) return energy_change(joules);
  const bool small = *share != 0.0 && std::abs(*share) < kLeastShare;
  return energy_change(joules) + " (" + (small ? "< 0.001 %" : percent(*share)) + ")";
}

std::string percent(double share) {
  const double value = 100.0 * share;
  if (std::abs(share) < kLeastShare) return "0 %";
  const int digits = std::abs(value) < 0.095 ? 3 : std::abs(value) < 9.95 ? 2 : 1;
  const std::string text = fixed(value, digits);
  return (value > 0.0 ? "+" : "") + text + " %";
}

std::string duration(double seconds) {
  if (seconds < 0.9995e-3) return fixed(1e6 * seconds, seconds < 1e-4 ? 1 : 0) + " µs";
  return fixed(1e3 * seconds, seconds < 1e-2 ? 2 : 1) + " ms";
}

}  // namespace substep
