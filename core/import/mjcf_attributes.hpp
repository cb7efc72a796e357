#pragma once
// Attributes of MJCF elements: their own, or those of their default class.

#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/mass_properties.hpp"
#include "core/import/mjcf_document.hpp"
#include "core/model/range.hpp"

namespace substep {

/// A <default>: its elements by tag, and the class that it refines.
struct DefaultClass {
  const DefaultClass* base = nullptr;
  std::map<std::string, std::vector<const XmlElement*>, std::less<>> elements;  // the last one wins
};

/// All default classes of a model. "main", of the outermost <default>, is always there and is the
/// base of the others.
class DefaultClasses {
 public:
  DefaultClasses(const MjcfDocument& document, ImportNotes& errors);

  /// Null if there is none of that name.
  [[nodiscard]] const DefaultClass* find(const std::string& name) const;
  [[nodiscard]] const DefaultClass* main() const { return owned_.front().get(); }

 private:
  DefaultClass* add(const std::string& name);

  std::vector<std::unique_ptr<DefaultClass>> owned_;
  std::map<std::string, const DefaultClass*> classes_;
};

/// What <compiler> says.
struct MjcfCompiler {
  bool degrees = true;
  bool autolimits = true;
  std::string euler_sequence = "xyz";
  enum class FromGeom { kNo, kAuto, kYes };
  FromGeom inertia_from_geom = FromGeom::kAuto;
  double group_least = 0.0;  // geoms of other groups have no mass
  double group_most = 5.0;
  double least_mass = 0.0;     // [kg]
  double least_inertia = 0.0;  // [kg m^2]
  bool balance_inertia = false;
  double total_mass = -1.0;  // if positive, masses are scaled to it [kg]
  std::string mesh_folder;
};

/// What every part of the reader needs.
struct MjcfContext {
  const MjcfDocument& document;
  const DefaultClasses& defaults;
  const MjcfCompiler& compiler;
  ImportReport& report;
};

/// The attributes of one element. The destructor reports those that were not read.
class MjcfAttributes {
 public:
  /// @param childclass of the body that the element is in, or null
  MjcfAttributes(const MjcfContext& context, const XmlElement& element,
                 const DefaultClass* childclass = nullptr);
  ~MjcfAttributes();
  MjcfAttributes(const MjcfAttributes&) = delete;
  MjcfAttributes& operator=(const MjcfAttributes&) = delete;

  [[nodiscard]] const XmlElement& element() const { return element_; }
  [[nodiscard]] std::string place() const { return context_.document.place(element_); }
  /// "joint 'hip'" for messages.
  [[nodiscard]] std::string what() const;

  /// Null if neither the element nor its class has it.
  const std::string* text(std::string_view key);
  std::string text_or(std::string_view key, const std::string& otherwise);
  double number(std::string_view key, double otherwise, const Range& range);
  /// Between `least` and `most` numbers of a range; empty if there are none.
  std::vector<double> numbers(std::string_view key, std::size_t least, std::size_t most,
                              const Range& range);
  Vec3 vector(std::string_view key, const Vec3& otherwise, const Range& range);
  bool flag(std::string_view key, bool otherwise);
  /// true, false, or nothing for "auto" and if it is not given.
  std::optional<bool> choice(std::string_view key);
  /// From quat, axisangle, euler, xyaxes or zaxis.
  Quat orientation();
  /// pos and orientation.
  Pose pose();

  /// Attributes without effect here, or that are not read for a reason that is reported otherwise.
  void ignore(std::initializer_list<std::string_view> keys);
  void error(const std::string& text) { context_.report.errors.add(place(), what() + ": " + text); }

 private:
  struct Found {
    const XmlElement* element;
    const std::string* value;
  };
  [[nodiscard]] std::optional<Found> find(std::string_view key) const;

  const MjcfContext& context_;
  const XmlElement& element_;
  std::vector<const XmlElement*> sources_;  // the element, then those of its classes
  std::vector<const XmlElement*> shared_;   // of other actuators, whose defaults are shared in part
  std::set<std::string, std::less<>> read_;
};

/// The shortest rotation that takes z to a direction, not 0.
Quat from_z_to(const Vec3& direction);

/// Of a rotation by three angles about the axes of a sequence such as "xyz", where capital letters
/// are fixed axes [rad]. @param sequence three letters of xyzXYZ
Quat euler_orientation(const Vec3& angles, std::string_view sequence);

/// The default class of an element's own `attribute`, or the inherited one. Errors are reported.
const DefaultClass* class_named_by(const MjcfContext& context, const XmlElement& element,
                                   const char* attribute, const DefaultClass* inherited);

}  // namespace substep
