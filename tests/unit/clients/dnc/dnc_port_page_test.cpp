#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using test_support::Dnc;

TEST(DncPortPage, GoesFromALineToThePageAndBack) {  // CEN-197, CEN-198
  Dnc dnc{DNC_PATH};
  const auto page = dnc({"port", "page", "--for", "1200o81", "--set", "eob=cr"});
  ASSERT_EQ(page.status, 0) << page.err;
  EXPECT_NE(page.out.find("com1_format = \"O/8/1\""), std::string::npos) << page.out;
  dnc.write("page.toml", page.out);
  const auto line = dnc({"port", "page", "page.toml"});
  EXPECT_EQ(line.out, "--template centurion baud=1200 data_bits=8 parity=odd stop_bits=1 eob=cr\n")
      << line.err;
}

TEST(DncPortPage, NamesWhatThePageDoesNotHave) {
  Dnc dnc{DNC_PATH};
  EXPECT_EQ(dnc({"port", "page", "--for", "57600n81"}).err,
            "dnc: baud 57600: the page has 110, 150, 300, 600 ... 19200\n");
  dnc.write("page.toml", "com1_baud = 9600\ncom1_format = \"X/7/2\"\n");
  EXPECT_EQ(dnc({"port", "page", "page.toml"}).err,
            "dnc: page.toml line 2: com1_format = X/7/2: expected N, E or O / 7 or 8 / 1 or 2, "
            "such as E/7/2\n");
  EXPECT_EQ(dnc({"port", "page"}).status, 2);
}

}  // namespace
}  // namespace dripline
