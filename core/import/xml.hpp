#pragma once
// A bounded reader of XML: elements, attributes and their lines. It neither recurses nor throws,
// and a malformed text is a message with its line, so that it serves the page too, where exceptions
// end the program.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace substep {

// Limits that protect against memory exhaustion by hostile or broken files.
inline constexpr std::size_t kMaxXmlSize = 16U << 20U;       // [bytes]
inline constexpr std::size_t kMaxXmlDepth = 256;             // nested elements
inline constexpr std::size_t kMaxXmlElements = 200'000;      // of one file
inline constexpr std::size_t kMaxXmlAttributes = 1'000'000;  // of one file

struct XmlAttribute {
  std::string name;
  std::string value;
};

struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;  // names are unique
  std::vector<XmlElement> children;      // text between elements is not kept
  int line = 0;                          // of its start, from 1
  int file = 0;                          // for callers that read several files

  /// Null if there is none.
  [[nodiscard]] const std::string* attribute(std::string_view key) const;
  /// The first child of a name, or null.
  [[nodiscard]] const XmlElement* child(std::string_view key) const;
};

/// The first fault of a text.
struct XmlFault {
  int line = 0;
  std::string message;
};

/// The root of a document. Declarations, comments and processing instructions are skipped. Refused,
/// with the line: what is not well-formed, document types and entities of their own, zero bytes,
/// and what exceeds the limits.
std::optional<XmlElement> parse_xml(std::string_view text, XmlFault& fault);

}  // namespace substep
