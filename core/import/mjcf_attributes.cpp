#include "core/import/mjcf_attributes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/import/xml_numbers.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

// What people and tools see, and names. Reported together.
constexpr std::string_view kForTheEye[] = {"rgba", "material", "user"};

// Actuators of all kinds share these defaults.
constexpr std::string_view kActuators[] = {"general", "motor", "position", "velocity"};
constexpr std::string_view kShared[] = {"ctrlrange", "ctrllimited", "forcerange", "forcelimited",
                                        "gear"};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Quat from_matrix_columns(const Vec3& x, const Vec3& y) {
  Mat3 R;
  R.col(0) = x.normalized();
  R.col(1) = (y - R.col(0).dot(y) * R.col(0)).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return Quat(R).normalized();
}

}  // namespace

Quat from_z_to(const Vec3& direction) {
  const Vec3 z = direction.normalized();
  const Vec3 axis = Vec3::UnitZ().cross(z);
  if (axis.norm() < 1e-14) {
    return z.z() > 0.0 ? Quat(1.0, 0.0, 0.0, 0.0) : Quat(0.0, 1.0, 0.0, 0.0);
  }
  const double angle = std::atan2(axis.norm(), z.z());
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

Quat euler_orientation(const Vec3& angles, std::string_view sequence) {
  Quat q = Quat::Identity();
  for (int i = 0; i < 3; ++i) {
    const char letter = sequence[static_cast<std::size_t>(i)];
    const bool is_fixed = letter >= 'X' && letter <= 'Z';
    const int axis = letter - (is_fixed ? 'X' : 'x');
    const Quat turn(Eigen::AngleAxisd(angles[i], Vec3(Vec3::Unit(axis))));
    q = is_fixed ? turn * q : q * turn;
  }
  return q.normalized();
}

DefaultClasses::DefaultClasses(const MjcfDocument& document, ImportNotes& errors) {
  struct Section {
    const XmlElement* element;
    DefaultClass* of;
  };
  std::vector<Section> sections;
  DefaultClass* main = add("main");
  for (const XmlElement& child : document.root.children) {
    if (child.name != "default") continue;
    if (const std::string* name = child.attribute("class")) classes_[*name] = main;
    sections.push_back({&child, main});
  }
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const auto [element, of] = sections[i];
    for (const XmlElement& child : element->children) {
      if (child.name != "default") {
        constexpr std::size_t kMostOfOne = 100;
        auto& same = of->elements[child.name];
        if (same.size() < kMostOfOne) {
          same.push_back(&child);
        } else {
          errors.add(document.place(child), "too many <" + child.name + "> in one default class");
        }
        continue;
      }
      const std::string* name = child.attribute("class");
      if (name == nullptr || name->empty()) {
        errors.add(document.place(child), "a nested <default> needs a class");
      } else if (classes_.contains(*name)) {
        errors.add(document.place(child), "the default class '" + *name + "' is given twice");
      } else {
        DefaultClass* nested = add(*name);
        nested->base = of;
        sections.push_back({&child, nested});
      }
    }
  }
}

DefaultClass* DefaultClasses::add(const std::string& name) {
  owned_.push_back(std::make_unique<DefaultClass>());
  classes_[name] = owned_.back().get();
  return owned_.back().get();
}

const DefaultClass* DefaultClasses::find(const std::string& name) const {
  const auto found = classes_.find(name);
  return found == classes_.end() ? nullptr : found->second;
}

const DefaultClass* class_named_by(const MjcfContext& context, const XmlElement& element,
                                   const char* attribute, const DefaultClass* inherited) {
  const std::string* name = element.attribute(attribute);
  if (name == nullptr) return inherited;
  const DefaultClass* found = context.defaults.find(*name);
  if (found == nullptr) {
    context.report.errors.add(context.document.place(element),
                              "no default class is called '" + *name + "'");
    return inherited;
  }
  return found;
}

MjcfAttributes::MjcfAttributes(const MjcfContext& context, const XmlElement& element,
                               const DefaultClass* childclass)
    : context_(context), element_(element), sources_{&element} {
  const DefaultClass* own =
      class_named_by(context, element, "class", childclass ? childclass : context.defaults.main());
  // Constraints of all kinds share the defaults of <equality>.
  const bool is_equality = element.name == "connect" || element.name == "weld";
  const std::string_view tag = is_equality ? std::string_view("equality") : element.name;
  for (; own != nullptr; own = own->base) {
    const auto append = [&](std::string_view of, std::vector<const XmlElement*>& to) {
      const auto found = own->elements.find(of);
      if (found == own->elements.end()) return;
      to.insert(to.end(), found->second.rbegin(), found->second.rend());
    };
    append(tag, sources_);
    if (!is_one_of(kActuators, tag)) continue;
    for (const std::string_view other : kActuators) {
      if (other != tag) append(other, shared_);
    }
  }
  ignore({"class", "name"});
}

MjcfAttributes::~MjcfAttributes() {
  for (const XmlElement* source : sources_) {
    for (const XmlAttribute& attribute : source->attributes) {
      if (read_.contains(attribute.name)) continue;
      const std::string place = context_.document.place(*source);
      const bool is_for_the_eye = is_one_of(kForTheEye, attribute.name);
      context_.report.left_out.add(place, is_for_the_eye
                                              ? "colours, materials and user data"
                                              : "<" + element_.name + "> '" + attribute.name + "'");
    }
  }
}

std::string MjcfAttributes::what() const {
  const std::string* name = element_.attribute("name");
  return name == nullptr ? "<" + element_.name + ">" : element_.name + " '" + *name + "'";
}

std::optional<MjcfAttributes::Found> MjcfAttributes::find(std::string_view key) const {
  for (const XmlElement* source : sources_) {
    if (const std::string* value = source->attribute(key)) return Found{source, value};
  }
  if (!is_one_of(kShared, key)) return std::nullopt;
  for (const XmlElement* source : shared_) {
    if (const std::string* value = source->attribute(key)) return Found{source, value};
  }
  return std::nullopt;
}

const std::string* MjcfAttributes::text(std::string_view key) {
  read_.emplace(key);
  const auto found = find(key);
  return found ? found->value : nullptr;
}

std::string MjcfAttributes::text_or(std::string_view key, const std::string& otherwise) {
  const std::string* found = text(key);
  return found == nullptr ? otherwise : *found;
}

std::vector<double> MjcfAttributes::numbers(std::string_view key, std::size_t least,
                                            std::size_t most, const Range& range) {
  read_.emplace(key);
  const auto found = find(key);
  if (!found) return {};
  const auto refuse = [&](const std::string& allowed, const std::string& value) {
    context_.report.errors.add(context_.document.place(*found->element),
                               what() + ": " + std::string(key) + " " + must_be(allowed, value));
  };
  const auto numbers = numbers_of(*found->value, most);
  if (!numbers || numbers->size() < least) {
    const std::string count = least == most ? std::to_string(most)
                                            : std::to_string(least) + " to " + std::to_string(most);
    refuse(count + (most == 1 ? " number" : " numbers"), "'" + found->value->substr(0, 60) + "'");
    return {};
  }
  for (const double number : *numbers) {
    if (range.contains(number)) continue;
    refuse(range.violated_by(number), number_text(number));
    return {};
  }
  return *numbers;
}

double MjcfAttributes::number(std::string_view key, double otherwise, const Range& range) {
  const std::vector<double> found = numbers(key, 1, 1, range);
  return found.empty() ? otherwise : found.front();
}

Vec3 MjcfAttributes::vector(std::string_view key, const Vec3& otherwise, const Range& range) {
  const std::vector<double> found = numbers(key, 3, 3, range);
  return found.empty() ? otherwise : Vec3(found.data());
}

bool MjcfAttributes::flag(std::string_view key, bool otherwise) {
  return choice(key).value_or(otherwise);
}

std::optional<bool> MjcfAttributes::choice(std::string_view key) {
  const std::string* value = text(key);
  if (value == nullptr || *value == "auto") return std::nullopt;
  if (*value == "true" || *value == "enable") return true;
  if (*value == "false" || *value == "disable") return false;
  error(std::string(key) + " " + must_be("true, false or auto", "'" + *value + "'"));
  return std::nullopt;
}

Quat MjcfAttributes::orientation() {
  constexpr std::string_view kOthers[] = {"axisangle", "xyaxes", "zaxis", "euler"};
  // The nearest of these counts, before any quat.
  std::string_view form = "quat";
  for (const XmlElement* source : sources_) {
    const auto given = std::find_if(std::begin(kOthers), std::end(kOthers),
                                    [&](auto key) { return source->attribute(key) != nullptr; });
    if (given == std::end(kOthers)) continue;
    form = *given;
    break;
  }
  ignore({"quat", "axisangle", "xyaxes", "zaxis", "euler"});
  const std::size_t count = form == "quat" || form == "axisangle" ? 4 : form == "xyaxes" ? 6 : 3;
  const std::vector<double> n = numbers(form, count, count, symmetric(1e6, "-"));
  if (n.empty()) return Quat::Identity();
  const double unit = context_.compiler.degrees ? std::numbers::pi / 180.0 : 1.0;
  const auto too_short = [&](const Vec3& v) {
    if (v.norm() > 1e-10) return false;
    error(std::string(form) + " has a direction of length 0");
    return true;
  };
  if (form == "euler") {
    return euler_orientation(unit * Vec3(n.data()), context_.compiler.euler_sequence);
  }
  if (form == "zaxis") {
    const Vec3 z(n.data());
    return too_short(z) ? Quat(Quat::Identity()) : from_z_to(z);
  }
  if (form == "axisangle") {
    const Vec3 axis(n.data());
    if (too_short(axis)) return Quat::Identity();
    return Quat(Eigen::AngleAxisd(unit * n[3], axis.normalized()));
  }
  if (form == "xyaxes") {
    const Vec3 x(n.data());
    const Vec3 y(n.data() + 3);
    if (too_short(x) || too_short(x.cross(y))) return Quat::Identity();
    return from_matrix_columns(x, y);
  }
  const Quat q(n[0], n[1], n[2], n[3]);
  if (q.norm() > 1e-10) return q.normalized();
  error("quat has length 0");
  return Quat::Identity();
}

Pose MjcfAttributes::pose() { return {vector("pos", Vec3::Zero(), kPositionRange), orientation()}; }

void MjcfAttributes::ignore(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) read_.emplace(key);
}

}  // namespace substep
