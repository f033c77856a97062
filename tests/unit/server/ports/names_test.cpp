#include <gtest/gtest.h>

#include "server/machines/start_point.hpp"
#include "server/ports/programs/uploaded_program.hpp"

namespace dripline::ports {
namespace {

TEST(Names, NameBlocksToBeginAt) {
  EXPECT_EQ(machines::parse_start_point("120")->sequence, 120u);
  EXPECT_EQ(machines::parse_start_point("N120")->sequence, 120u);
  EXPECT_EQ(machines::parse_start_point("l7")->line, 7u);
  EXPECT_EQ(machines::parse_start_point("B4096")->byte, 4096u);
  EXPECT_EQ(machines::parse_start_point("t3")->tool, 3u);
  EXPECT_EQ(machines::parse_start_point("+25")->skipped, 25u);
  for (const char* text : {"N120", "L7", "B4096", "T3", "+25"}) {
    EXPECT_EQ(machines::start_text(*machines::parse_start_point(text)), text);
  }
  for (const char* bad : {"", "N", "X5", "12a", "N-1"})
    EXPECT_FALSE(machines::parse_start_point(bad)) << bad;
}

TEST(Names, MakeNamesFitForTheLibrary) {
  EXPECT_EQ(fit_program_name("O15"), "O15");
  EXPECT_EQ(fit_program_name("../etc/passwd"), "-etc-passwd");
  EXPECT_EQ(fit_program_name(" .a/b "), "a-b");
  EXPECT_EQ(fit_program_name(" ."), "");
  EXPECT_EQ(fit_program_name(std::string(300, 'a')).size(), 128u);
}

}  // namespace
}  // namespace dripline::ports
