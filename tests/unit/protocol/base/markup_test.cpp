#include "protocol/base/markup.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(Markup, HasNoCharacterThatXmlAndHtmlTakeForTheirOwn) {
  EXPECT_EQ(escape_markup(R"(<a href="x">&amp;)"), "&lt;a href=&quot;x&quot;&gt;&amp;amp;");
  EXPECT_EQ(escape_markup("Werkstück 'A'\n"), "Werkstück 'A'\n");
  EXPECT_EQ(escape_markup(""), "");
}

}  // namespace
}  // namespace dripline
