#include "clients/cli/port/traffic_text.hpp"

#include <gtest/gtest.h>
#include <cstdlib>

namespace dripline::cli {
namespace {

class Traffic : public testing::Test {
 protected:
  Traffic() { ::setenv("TZ", "UTC", 1); }

  static client::Traffic item(const std::string& what, const std::string& hex,
                              const std::string& time = "06.100000") {
    return {"line-1", "2026-11-21T07:40:" + time + "Z", what, hex, ""};
  }
  TrafficText text{{}};
};

TEST_F(Traffic, NamesControlCharacters) {
  EXPECT_EQ(named_characters(std::string("N1\r\n\x13\x00\x1B\x7F\xB1", 9)),
            "N1<CR><LF><DC3><NUL><ESC><DEL><B1>");
}

TEST_F(Traffic, ShowsABlockALineHoweverItCame) {
  std::string out;
  for (const char* hex : {"4d", "33", "30", "0d", "0a", "25"}) out += text.add(item("sent", hex));
  EXPECT_EQ(out, "07:40:06.100  →  M30<CR><LF>\n");
  EXPECT_EQ(text.flush(), "07:40:06.100  →  %\n");
  EXPECT_EQ(text.flush(), "");
}

TEST_F(Traffic, ShowsAHandshakeAtOnceAndGoesOnWithTheBlock) {
  std::string out = text.add(item("sent", "4731"));
  out += text.add(item("received", "13", "06.250000"));
  EXPECT_EQ(out, "07:40:06.250  ←  <DC3>\n");
  out = text.add(item("sent", "580d0a", "06.300000"));
  out += text.flush();
  EXPECT_EQ(out, "07:40:06.100  →  G1X<CR><LF>\n");
}

TEST_F(Traffic, KeepsBothDirectionsApart) {
  std::string out;
  for (const char c : {'1', '2', '3'}) {
    out += text.add(item("sent", std::string("4") + c));
    out += text.add(item("received", std::string("5") + c));
  }
  EXPECT_EQ(out, "");
  EXPECT_EQ(text.flush(), "07:40:06.100  →  ABC\n07:40:06.100  ←  QRS\n");
}

TEST_F(Traffic, BeginsANewLineAfterAPause) {
  std::string out = text.add(item("sent", "41", "06.100000"));
  out += text.add(item("sent", "42", "06.500000"));
  out += text.add(item("sent", "43", "07.200000"));
  out += text.flush();
  EXPECT_EQ(out, "07:40:06.100  →  AB\n07:40:07.200  →  C\n");
}

TEST_F(Traffic, CutsTextWithoutEnds) {
  std::string hex;
  for (int i = 0; i < 200; ++i) hex += "55";
  const std::string out = text.add(item("received", hex));
  EXPECT_EQ(out, "07:40:06.100  ←  " + std::string(96, 'U') + "\n07:40:06.100  ←  " +
                     std::string(96, 'U') + "\n");
}

TEST_F(Traffic, ShowsFaultsAndWordsAtOnceAndInOrder) {
  std::string out = text.add(item("received", "41"));
  auto fault = item("fault", "");
  fault.text = "parity error\x1b[31m";
  out += text.add(fault);
  EXPECT_EQ(out, "07:40:06.100  ←  A\n07:40:06.100  !  parity error [31m\n");
}

TEST_F(Traffic, ShowsSixteenBytesALineInHexadecimal) {
  TrafficText hex{{.is_hex = true}};
  std::string out = hex.add(item("sent", "4e31302047303120583131320d0a4e32302047"));
  out += hex.flush();
  EXPECT_EQ(out,
            "07:40:06.100  →  4e 31 30 20 47 30 31 20 58 31 31 32 0d 0a 4e 32  N10 G01 X112..N2\n"
            "07:40:06.100  →  30 20 47                                         0 G\n");
}

TEST_F(Traffic, ShowsDigitsThatAreNone) {
  EXPECT_EQ(text.add(item("sent", "4x")), "07:40:06.100  →  4x\n");
  EXPECT_EQ(text.add(item("sent", "4")), "07:40:06.100  →  4\n");
}

}  // namespace
}  // namespace dripline::cli
