#include "protocol/audit/chain.hpp"

#include <gtest/gtest.h>

namespace dripline::audit {
namespace {

Entry entry_of(std::uint64_t number) {
  return {number,      UtcTime(std::chrono::microseconds(1'700'000'000'000'000)),
          "anna",      "token",
          "192.0.2.1", "run.hold",
          "r1",        "now"};
}

TEST(AuditEntry, IsOneLineThatIsReadAlike) {
  Entry entry = entry_of(7);
  entry.detail = std::string("tab\t, line\n, \\x09, caf\xc3\xa9, nul") + '\0';
  const std::string line = line_of(entry);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto read = parse_entry(line);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(*read, entry);
}

/// Otherwise two trails would have one chain.
TEST(AuditEntry, HasNoSecondForm) {
  const std::string line = line_of(entry_of(7));
  ASSERT_TRUE(parse_entry(line));
  for (const std::string& other :
       {"0" + line, "+" + line, line + "\t", line + "\\x41", line + "\\x0A", line + "\\n",
        line + "\x01", line.substr(0, line.rfind('\t'))}) {
    EXPECT_FALSE(parse_entry(other)) << other;
  }
}

/// Kept for ever: trails of older servers must verify. Computed with sha256sum.
TEST(AuditChain, IsWhatTheReadmeDescribes) {
  EXPECT_EQ(line_of(entry_of(1)), "1\t1700000000000000\tanna\ttoken\t192.0.2.1\trun.hold\tr1\tnow");
  const Digest begin = chain_begin("d1");
  EXPECT_EQ(begin.hex(), "0253940033308c8d3759ac2b11587ea7c3f625596b89109c6f756bf6fde374a2");
  EXPECT_EQ(chain_next(begin, line_of(entry_of(1))).hex(),
            "f391b51efa38ccd5086aab83daed07c2cefaace9c26cf18519acde85a550f0dc");
}

}  // namespace
}  // namespace dripline::audit
