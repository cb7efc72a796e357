#include "core/model/setting_fields.hpp"

#include <algorithm>
#include <array>

#include "core/model/idle_settings.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/model/problem.hpp"

namespace substep {
namespace {

using S = Settings;

constexpr std::array kFields{
    SettingField{"solver", "solver of the constraints of a sub-step (Eq. 3)",
                 ChoiceSetting<SolverKind>{&S::solver}},
    SettingField{"iterations", "sweeps of pgs and xpbd per sub-step, maximum of Newton steps",
                 CountSetting{&S::iterations, 1, 100000}},
    SettingField{"share_iterations",
                 "sweeps of pgs and xpbd are per frame and distributed over its sub-steps, at "
                 "least one in each",
                 FlagSetting{&S::share_iterations}},
    SettingField{"warm_start", "pgs starts from the forces of the previous sub-step",
                 FlagSetting{&S::warm_start}},
    SettingField{"forces",
                 "poses at which newton evaluates the directions of forces; numerov is of fourth "
                 "order, of second with soft joints in space",
                 ChoiceSetting<Forces>{&S::forces}},
    SettingField{"refinements",
                 "additional solves of bpp that remove the effect of the scene's regularisation",
                 CountSetting{&S::refinements, 0, 1000}},
    SettingField{"pivots", "block pivots of bpp before its method changes",
                 CountSetting{&S::pivots, 1, 1000}},
    SettingField{"mode", "stabilisation of a step", ChoiceSetting<Mode>{&S::mode}},
    SettingField{"alpha", "stability threshold (Eq. 5); N is proportional to alpha^-1/2 (Eq. 10)",
                 NumberSetting{&S::alpha, positive(1.0, "-")}},
    SettingField{"n", "sub-steps per frame in mode const", CountSetting{&S::n, 1, 10000}},
    SettingField{"n_max", "maximum of sub-steps per frame in mode adaptive",
                 CountSetting{&S::n_max, 1, 10000}},
    SettingField{"n_cap", "maximum of sub-steps per frame in modes capped, inertia and blend",
                 CountSetting{&S::n_cap, 1, 10000}},
    SettingField{"alpha_m", "stability threshold of geometric inertia in modes inertia and blend",
                 NumberSetting{&S::alpha_m, {0.0, 1.0, true, true, "-"}}},
    SettingField{"beta", "share of the velocity that mode blend does not damp",
                 NumberSetting{&S::beta, {0.0, 1.0, false, false, "-"}}},
    SettingField{"policy", "sub-steps are decided once per frame or after every sub-step (Eq. 11)",
                 ChoiceSetting<Policy>{&S::policy}},
    SettingField{"memory",
                 "share of r that is kept from one sub-step to the next in policy substep",
                 NumberSetting{&S::memory, {0.0, 1.0, false, true, "-"}}},
    SettingField{"hold", "frames that must need fewer sub-steps before their number falls",
                 CountSetting{&S::hold, 1, 10000}},
    SettingField{"redo", "a frame that turns out to need more sub-steps is taken again with them",
                 FlagSetting{&S::redo}},
    SettingField{
        "islands",
        "groups of bodies that nothing connects within a frame have their own number of sub-steps",
        FlagSetting{&S::islands}},
    SettingField{"sleep", "bodies at rest sleep, at no cost, until something reaches them",
                 FlagSetting{&S::sleep}},
    SettingField{"probe", "one solve before the first frame computes the forces that Eq. 9 needs",
                 FlagSetting{&S::probe}},
    SettingField{"integrator",
                 "time integration: the paper's (first order), second order, or fourth order for "
                 "joints; newton and xpbd use leapfrog instead of stormer",
                 ChoiceSetting<Integrator>{&S::integrator}},
    SettingField{"gyroscopic", "how the gyroscopic torque is integrated",
                 ChoiceSetting<Gyroscopic>{&S::gyroscopic}},
    SettingField{
        "drift",
        "law of the drift correction; auto is soft with pgs and full with the others; exact "
        "closes joints at the end of every sub-step with bpp, else as auto",
        ChoiceSetting<Drift>{&S::drift}},
    SettingField{"tau", "time constant of the soft drift law",
                 NumberSetting{&S::drift_tau, {1e-6, 10.0, false, false, "s"}}},
    SettingField{
        "drift_order",
        "2: joints are also corrected for the error that their rotation will cause in the sub-step",
        CountSetting{&S::drift_order, 1, 2}},
    SettingField{"detection",
                 "contacts are detected before every sub-step, once per frame within the distance "
                 "that bodies can travel in it, or along the motion of every sub-step",
                 ChoiceSetting<Detection>{&S::detection}},
    SettingField{"contact_stiffness", "contact block in K (Eq. 1): the paper's or the derivative",
                 ChoiceSetting<ContactStiffness>{&S::contact_stiffness}},
    SettingField{"rotation_criterion",
                 "N also depends on the rotation and the gyroscopic rate of bodies; off: the "
                 "paper's rule only",
                 FlagSetting{&S::rotation_criterion}},
    SettingField{"friction_cone",
                 "friction up to mu times the normal force: along each of two fixed tangents (box, "
                 "the paper's), or in every direction of sliding (cone)",
                 ChoiceSetting<FrictionCone>{&S::friction_cone}},
    SettingField{"watch_stiffness", "evaluate K even if the mode does not need it",
                 FlagSetting{&S::watch_stiffness}},
};

std::string allowed_by(const FlagSetting&) { return "true or false"; }
std::string allowed_by(const CountSetting& f) {
  return "a whole number from " + std::to_string(f.least) + " to " + std::to_string(f.most);
}
std::string allowed_by(const NumberSetting& f) { return f.range.text(); }
template <class Enum>
std::string allowed_by(const ChoiceSetting<Enum>&) {
  return one_of(kNames<Enum>);
}

std::string written(bool value) { return value ? "true" : "false"; }
std::string written(int value) { return std::to_string(value); }
std::string written(double value) { return number_text(value); }
template <class Enum>
std::string written(Enum value) {
  return std::string(name_of(value));
}

// The value that a text states, or nothing if it is not allowed.
std::optional<bool> parsed(const FlagSetting&, std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return std::nullopt;
}
std::optional<int> parsed(const CountSetting& f, std::string_view text) {
  const auto value = parse_integer(text);
  if (!value || *value < f.least || *value > f.most) return std::nullopt;
  return static_cast<int>(*value);
}
std::optional<double> parsed(const NumberSetting& f, std::string_view text) {
  const auto value = parse_number(text);
  return value && f.range.contains(*value) ? value : std::nullopt;
}
template <class Enum>
std::optional<Enum> parsed(const ChoiceSetting<Enum>&, std::string_view text) {
  return value_of<Enum>(text);
}

}  // namespace

std::span<const SettingField> setting_fields() { return kFields; }

const SettingField* find_setting(std::string_view name) {
  const auto found = std::find_if(kFields.begin(), kFields.end(),
                                  [&](const SettingField& field) { return field.name == name; });
  return found == kFields.end() ? nullptr : &*found;
}

std::string allowed_values(const SettingField& field) {
  return std::visit([](const auto& f) { return allowed_by(f); }, field.member);
}

std::string refusal(const SettingField& field, const std::string& value) {
  return must_be(allowed_values(field), value);
}

bool is_choice(const SettingField& field) {
  return !std::holds_alternative<FlagSetting>(field.member) &&
         !std::holds_alternative<CountSetting>(field.member) &&
         !std::holds_alternative<NumberSetting>(field.member);
}

std::string setting_text(const SettingField& field, const Settings& settings) {
  return std::visit([&](const auto& f) { return written(settings.*f.member); }, field.member);
}

std::optional<std::string> set_setting(const SettingField& field, std::string_view text,
                                       Settings& settings) {
  const bool ok = std::visit(
      [&](const auto& f) {
        const auto value = parsed(f, text);
        if (value) settings.*f.member = *value;
        return value.has_value();
      },
      field.member);
  if (ok) return std::nullopt;
  return refusal(field, std::string(text));
}

std::string setting_flags(const Settings& settings, const Settings& base) {
  std::string flags;
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness" || idle_reason(settings, field.name)) continue;
    const std::string value = setting_text(field, settings);
    if (value == setting_text(field, base)) continue;
    std::string flag(field.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    if (std::holds_alternative<FlagSetting>(field.member)) {
      flags += (value == "true" ? " --" : " --no-") + flag;
    } else {
      flags += " --" + flag + " " + value;
    }
  }
  return flags;
}

}  // namespace substep
