#include "core/import/xml.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/model/problem.hpp"

namespace substep {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Names are any characters that have no other meaning: their spelling is the reader's concern.
bool is_in_name(char c) {
  return !is_blank(c) && std::string_view("<>/=\"'&?!").find(c) == std::string_view::npos;
}

void append_utf8(std::uint32_t code, std::string& text) {
  const auto byte = [&](std::uint32_t bits) { text += static_cast<char>(bits); };
  if (code < 0x80U) return byte(code);
  if (code < 0x800U) {
    byte(0xc0U | (code >> 6U));
  } else {
    if (code < 0x10000U) {
      byte(0xe0U | (code >> 12U));
    } else {
      byte(0xf0U | (code >> 18U));
      byte(0x80U | ((code >> 12U) & 0x3fU));
    }
    byte(0x80U | ((code >> 6U) & 0x3fU));
  }
  byte(0x80U | (code & 0x3fU));
}

/// The character of a reference such as "#65" or "#x41", or nothing.
std::optional<std::uint32_t> numbered_character(std::string_view reference) {
  const bool hexadecimal = reference.starts_with("#x");
  const std::string_view digits = reference.substr(hexadecimal ? 2 : 1);
  if (digits.empty() || digits.size() > 7) return std::nullopt;
  std::uint32_t code = 0;
  for (const char c : digits) {
    const std::size_t digit =
        std::string_view("0123456789abcdef")
            .find(c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c);
    if (digit >= (hexadecimal ? 16U : 10U)) return std::nullopt;
    code = code * (hexadecimal ? 16U : 10U) + static_cast<std::uint32_t>(digit);
  }
  const bool is_surrogate = code >= 0xd800U && code <= 0xdfffU;
  if (code == 0 || is_surrogate || code > 0x10ffffU) return std::nullopt;
  return code;
}

class XmlParser {
 public:
  XmlParser(std::string_view text, XmlFault& fault) : text_(text), fault_(fault) {}

  std::optional<XmlElement> document() {
    if (text_.size() > kMaxXmlSize) {
      fault_ = {1, too_many(text_.size(), kMaxXmlSize, "bytes (16 MiB)")};
      return std::nullopt;
    }
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    while (!failed_ && at_ < text_.size()) part();
    if (failed_) return std::nullopt;
    if (!open_.empty()) {
      fail("the file ends inside <" + open_.back().name + "> of line " +
           std::to_string(open_.back().line));
    } else if (!root_) {
      fail("there is no element");
    }
    return failed_ ? std::nullopt : std::move(root_);
  }

 private:
  /// The next tag, comment or text.
  void part() {
    if (text_[at_] != '<') return characters();
    if (skip("<?", "?>", "a declaration")) return;
    if (skip("<!--", "-->", "a comment")) return;
    if (text_.substr(at_).starts_with("<![CDATA[")) {
      if (open_.empty()) return fail("text outside the root element");
      skip("<![CDATA[", "]]>", "a CDATA section");
      return;
    }
    if (text_.substr(at_).starts_with("<!")) {
      return fail("document types and entities are not read");
    }
    if (text_.substr(at_).starts_with("</")) return end_tag();
    start_tag();
  }

  void characters() {
    for (; at_ < text_.size() && text_[at_] != '<'; ++at_) {
      if (text_[at_] == '\0') return fail("a zero byte: this is not a text file");
      if (open_.empty() && !is_blank(text_[at_])) return fail("text outside the root element");
      count_line();
    }
  }

  /// @return whether `begin` is here; then what follows its end, or the text has failed
  bool skip(std::string_view begin, std::string_view end, const char* what) {
    if (!text_.substr(at_).starts_with(begin)) return false;
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string_view::npos) {
      fail("the file ends inside " + std::string(what));
      return true;
    }
    while (at_ < found + end.size()) {
      count_line();
      ++at_;
    }
    return true;
  }

  void start_tag() {
    XmlElement element;
    element.line = line_;
    ++at_;
    element.name = name();
    if (element.name.empty()) return fail("'<' without the name of an element");
    if (root_) return fail("a second root element, <" + element.name + ">");
    if (open_.size() == kMaxXmlDepth) {
      return fail("nested deeper than " + std::to_string(kMaxXmlDepth) + " elements");
    }
    if (++elements_ > kMaxXmlElements) {
      return fail("more than " + std::to_string(kMaxXmlElements) + " elements");
    }
    const bool is_empty = read_attributes(element);
    if (failed_) return;
    if (is_empty) return close(std::move(element));
    open_.push_back(std::move(element));
  }

  /// Up to the end of the tag. @return whether the element is empty: "/>"
  bool read_attributes(XmlElement& element) {
    for (;;) {
      blanks();
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with(">")) return ++at_, false;
      if (rest.starts_with("/>")) return at_ += 2, true;
      XmlAttribute attribute;
      attribute.name = name();
      if (attribute.name.empty()) {
        fail(rest.empty() ? "the file ends inside <" + element.name + ">"
                          : "<" + element.name + "> has a character that begins no attribute");
        return false;
      }
      if (element.attribute(attribute.name) != nullptr) {
        fail("'" + attribute.name + "' is given twice in <" + element.name + ">");
        return false;
      }
      // Looking for a name that is given twice takes the square of their number.
      constexpr std::size_t kMostOfOne = 200;
      if (++attributes_ > kMaxXmlAttributes || element.attributes.size() == kMostOfOne) {
        fail("too many attributes");
        return false;
      }
      blanks();
      if (at_ == text_.size() || text_[at_] != '=') {
        fail("'" + attribute.name + "' has no value");
        return false;
      }
      ++at_;
      blanks();
      if (!read_value(attribute)) return false;
      element.attributes.push_back(std::move(attribute));
    }
  }

  bool read_value(XmlAttribute& attribute) {
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '"' && quote != '\'') {
      fail("the value of '" + attribute.name + "' has no quotes");
      return false;
    }
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      const char c = text_[at_];
      if (c == '<' || c == '\0') break;
      if (c == '&') {
        if (!reference(attribute.value)) return false;
        continue;
      }
      count_line();
      attribute.value += is_blank(c) ? ' ' : c;
    }
    if (at_ == text_.size() || text_[at_] != quote) {
      fail("the value of '" + attribute.name + "' has no end");
      return false;
    }
    ++at_;
    return true;
  }

  /// "&amp;" and its kind; stays at the semicolon.
  bool reference(std::string& value) {
    constexpr std::size_t kLongest = 10;
    const std::size_t end = text_.substr(at_, kLongest + 2).find(';');
    const std::string_view word =
        end == std::string_view::npos ? std::string_view() : text_.substr(at_ + 1, end - 1);
    constexpr std::pair<std::string_view, char> kKnown[] = {
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
    const auto known = std::find_if(std::begin(kKnown), std::end(kKnown),
                                    [&](const auto& entity) { return entity.first == word; });
    if (known != std::end(kKnown)) {
      value += known->second;
    } else if (const auto code = word.starts_with('#') ? numbered_character(word) : std::nullopt) {
      append_utf8(*code, value);
    } else {
      fail("'&' begins no character that is known without a document type");
      return false;
    }
    at_ += end;
    return true;
  }

  void end_tag() {
    at_ += 2;
    const std::string closed = name();
    blanks();
    if (at_ == text_.size() || text_[at_] != '>') return fail("</" + closed + " has no end");
    ++at_;
    if (open_.empty()) return fail("</" + closed + "> closes nothing");
    if (open_.back().name != closed) {
      return fail("</" + closed + "> stands where <" + open_.back().name + "> of line " +
                  std::to_string(open_.back().line) + " is open");
    }
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    close(std::move(element));
  }

  void close(XmlElement element) {
    if (open_.empty()) {
      root_ = std::move(element);
    } else {
      open_.back().children.push_back(std::move(element));
    }
  }

  std::string name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_in_name(text_[at_]) && text_[at_] != '\0') ++at_;
    return std::string(text_.substr(start, at_ - start));
  }
  void blanks() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) count_line();
  }
  void count_line() { line_ += text_[at_] == '\n' ? 1 : 0; }
  void fail(std::string message) {
    if (!std::exchange(failed_, true)) fault_ = {line_, std::move(message)};
  }

  std::string_view text_;
  XmlFault& fault_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool failed_ = false;
  std::size_t elements_ = 0;
  std::size_t attributes_ = 0;
  std::vector<XmlElement> open_;  // from the root inwards
  std::optional<XmlElement> root_;
};

}  // namespace

const std::string* XmlElement::attribute(std::string_view key) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const XmlAttribute& a) { return a.name == key; });
  return found == attributes.end() ? nullptr : &found->value;
}

const XmlElement* XmlElement::child(std::string_view key) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& e) { return e.name == key; });
  return found == children.end() ? nullptr : &*found;
}

std::optional<XmlElement> parse_xml(std::string_view text, XmlFault& fault) {
  return XmlParser(text, fault).document();
}

}  // namespace substep
