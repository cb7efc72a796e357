// The reader of XML: what it reads, and what it refuses with its line.

#include "core/import/xml.hpp"

#include <gtest/gtest.h>

#include <string>

namespace substep {
namespace {

std::string fault_of(std::string_view text) {
  XmlFault fault;
  if (parse_xml(text, fault)) return "it was read";
  return std::to_string(fault.line) + ": " + fault.message;
}

TEST(Xml, ReadsElementsAttributesAndTheirLines) {
  XmlFault fault;
  const auto root = parse_xml(
      "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- a <b> & c -->\n"
      "<a x = '1' y=\"a > b\n c\">\n  text <![CDATA[<d>]]> &anything\n"
      "  <b/>\n  <b z=\"&lt;&amp;&gt;&quot;&apos;&#65;&#x20ac;\"></b>\n</a>\n<!-- end -->\n",
      fault);
  ASSERT_TRUE(root) << fault.message;
  EXPECT_EQ(root->name, "a");
  EXPECT_EQ(root->line, 3);
  EXPECT_EQ(*root->attribute("x"), "1");
  EXPECT_EQ(*root->attribute("y"), "a > b  c");
  EXPECT_EQ(root->attribute("z"), nullptr);
  ASSERT_EQ(root->children.size(), 2U);
  EXPECT_EQ(root->children[0].line, 6);
  EXPECT_EQ(*root->children[1].attribute("z"), "<&>\"'A\xe2\x82\xac");
  EXPECT_EQ(root->children[1].line, 7);
}

TEST(Xml, RefusesMalformedTextsWithTheLine) {
  EXPECT_EQ(fault_of(""), "1: there is no element");
  EXPECT_EQ(fault_of("text"), "1: text outside the root element");
  EXPECT_EQ(fault_of("<a>\n<b>"), "2: the file ends inside <b> of line 2");
  EXPECT_EQ(fault_of("<a>\n</b>"), "2: </b> stands where <a> of line 1 is open");
  EXPECT_EQ(fault_of("</a>"), "1: </a> closes nothing");
  EXPECT_EQ(fault_of("<a/>\n<b/>"), "2: a second root element, <b>");
  EXPECT_EQ(fault_of("<a x=1/>"), "1: the value of 'x' has no quotes");
  EXPECT_EQ(fault_of("<a x/>"), "1: 'x' has no value");
  EXPECT_EQ(fault_of("<a x='1' x='2'/>"), "1: 'x' is given twice in <a>");
  EXPECT_EQ(fault_of("<a x='1"), "1: the value of 'x' has no end");
  EXPECT_EQ(fault_of("<a x='<'/>"), "1: the value of 'x' has no end");
  EXPECT_EQ(fault_of("<a \n"), "2: the file ends inside <a>");
  EXPECT_EQ(fault_of("<a =/>"), "1: <a> has a character that begins no attribute");
  EXPECT_EQ(fault_of("<>"), "1: '<' without the name of an element");
  EXPECT_EQ(fault_of("<!-- "), "1: the file ends inside a comment");
  EXPECT_EQ(fault_of("<a><![CDATA["), "1: the file ends inside a CDATA section");
  EXPECT_EQ(fault_of(std::string_view("<a>\0</a>", 8)), "1: a zero byte: this is not a text file");
  for (const char* reference : {"&b;", "&#0;", "&#xd800;", "&#x110000;", "&;", "&#;", "&amp"}) {
    EXPECT_EQ(fault_of("<a x='" + std::string(reference) + "'/>"),
              "1: '&' begins no character that is known without a document type");
  }
}

TEST(Xml, RefusesDocumentTypesAndEntities) {
  EXPECT_EQ(fault_of("<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'c'>]>\n<a/>"),
            "2: document types and entities are not read");
  EXPECT_EQ(fault_of("<a><!ENTITY b 'c'></a>"), "1: document types and entities are not read");
}

TEST(Xml, RefusesWhatExceedsItsLimits) {
  std::string deep;
  for (std::size_t i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_EQ(fault_of(deep), "1: nested deeper than 256 elements");
  EXPECT_EQ(fault_of(deep.substr(0, 3 * 257)), "1: nested deeper than 256 elements");
  EXPECT_EQ(fault_of(deep.substr(0, 3 * 256)), "1: the file ends inside <a> of line 1");
  std::string many = "<a>";
  for (std::size_t i = 0; i <= kMaxXmlElements; ++i) many += "<b/>";
  EXPECT_EQ(fault_of(many), "1: more than 200000 elements");
  std::string wide = "<a";
  for (int i = 0; i < 201; ++i) wide += " x" + std::to_string(i) + "=''";
  EXPECT_EQ(fault_of(wide + "/>"), "1: too many attributes");
  EXPECT_EQ(fault_of(std::string(kMaxXmlSize + 1, ' ')),
            "1: must have at most 16777216 bytes (16 MiB), not 16777217");
}

TEST(Xml, EveryTruncationOfATextIsRefused) {
  const std::string text =
      "<?xml version='1.0'?><!-- c --><a b='&amp;'><c d=\"1\"/><![CDATA[ ]]></a>";
  ASSERT_EQ(fault_of(text), "it was read");
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_NE(fault_of(text.substr(0, size)), "it was read") << size;
  }
}

}  // namespace
}  // namespace substep
