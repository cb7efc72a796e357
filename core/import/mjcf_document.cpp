#include "core/import/mjcf_document.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace substep {
namespace {

constexpr std::size_t kMostFiles = 100;

/// @return the number of elements
std::size_t set_file(XmlElement& element, int file) {
  element.file = file;
  std::size_t count = 1;
  for (XmlElement& child : element.children) count += set_file(child, file);
  return count;
}

class Includer {
 public:
  Includer(MjcfDocument& document, const ModelFiles& read, ImportNotes& errors)
      : document_(document), read_(read), errors_(errors) {}

  /// @param depth of the element
  void expand(XmlElement& element, std::size_t depth) {
    if (depth > kMaxXmlDepth) {
      return errors_.add(document_.place(element),
                         "nested deeper than " + std::to_string(kMaxXmlDepth) + " elements");
    }
    std::vector<XmlElement> children = std::exchange(element.children, {});
    for (XmlElement& child : children) {
      if (child.name == "include") {
        include(child, depth, element.children);
      } else {
        expand(child, depth + 1);
        element.children.push_back(std::move(child));
      }
    }
  }

 private:
  void include(const XmlElement& element, std::size_t depth, std::vector<XmlElement>& into) {
    const std::string place = document_.place(element);
    const std::string* file = element.attribute("file");
    if (file == nullptr) return errors_.add(place, "<include> has no file");
    std::vector<std::string>& files = document_.files;
    if (std::find(files.begin(), files.end(), *file) != files.end()) {
      return errors_.add(place, "'" + *file + "' is included twice, or includes itself");
    }
    if (files.size() == kMostFiles) return errors_.add(place, "too many included files");
    const auto text = read_ ? read_(*file) : std::optional<std::string>();
    if (!text) return errors_.add(place, "there is no file '" + *file + "'");
    files.push_back(*file);
    XmlFault fault;
    std::optional<XmlElement> root = parse_xml(*text, fault);
    if (!root) return errors_.add(*file + ":" + std::to_string(fault.line), fault.message);
    elements_ += set_file(*root, static_cast<int>(files.size()) - 1);
    if (elements_ > kMaxXmlElements) return errors_.add(place, "too many elements");
    expand(*root, depth);
    std::move(root->children.begin(), root->children.end(), std::back_inserter(into));
  }

  MjcfDocument& document_;
  const ModelFiles& read_;
  ImportNotes& errors_;
  std::size_t elements_ = 0;  // of included files
};

}  // namespace

std::string MjcfDocument::place(const XmlElement& element) const {
  return files[static_cast<std::size_t>(element.file)] + ":" + std::to_string(element.line);
}

std::optional<MjcfDocument> include_files(XmlElement root, const std::string& name,
                                          const ModelFiles& read, ImportNotes& errors) {
  MjcfDocument document{std::move(root), {name}};
  Includer(document, read, errors).expand(document.root, 0);
  if (!errors.empty()) return std::nullopt;
  return document;
}

}  // namespace substep
