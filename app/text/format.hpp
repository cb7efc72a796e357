#pragma once
// Formatting of numbers for display, with true minus signs and superscript powers of ten.

#include <optional>
#include <string>

namespace substep {

/// Three significant digits: "0.852", "12.3", "5,520", "5.52×10⁵".
std::string short_number(double value);
/// Two significant digits, for narrow places: "0.0042", "4.4×10⁻⁶".
std::string coarse_number(double value);
/// Three significant digits without trailing zeros: "0.1", "0.025".
std::string plain_number(double value);
/// "1,000"
std::string grouped(double value);
/// An SI prefix, as in J, kJ, MJ: the one that brings `scale` between 1 and 1,000.
struct Unit {
  std::string prefix;   // "k"; beyond f and T a power of ten: "10¹⁸ "
  double factor = 1.0;  // value of one unit
};
Unit unit_for(double scale);
/// A change of energy with its sign: "−12.3 mJ", "+1.20 kJ", "0 J"
std::string energy_change(double joules);
/// The same with its share of the scale, if there is one: "−12.3 mJ (−0.02 %)".
/// @param scale core/lab/energy_scale.hpp [J]
std::string energy_change(double joules, std::optional<double> scale);
/// Fixed number of decimals, with a true minus sign and no negative zero.
std::string fixed(double value, int digits);
/// "+0.01 %", "−20.3 %"
std::string percent(double share);
/// "0.85 ms", "12.3 µs"
std::string duration(double seconds);
/// "10⁻⁶"
std::string power_of_ten(int exponent);

}  // namespace substep
