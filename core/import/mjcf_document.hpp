#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/import/import_report.hpp"
#include "core/import/model_files.hpp"
#include "core/import/xml.hpp"

namespace substep {

/// An MJCF model with what it includes: the elements of an included file stand in place of
/// <include>.
struct MjcfDocument {
  XmlElement root;
  std::vector<std::string> files;  // names, by XmlElement::file

  /// "cassie.xml:34"
  [[nodiscard]] std::string place(const XmlElement& element) const;
};

/// Reads a document whose root was parsed. A file may be included once; missing, malformed and
/// circular includes are errors.
/// @param name of the model's file, for messages
std::optional<MjcfDocument> include_files(XmlElement root, const std::string& name,
                                          const ModelFiles& read, ImportNotes& errors);

}  // namespace substep
