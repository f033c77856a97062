#include "clients/cli/text/table.hpp"

#include <gtest/gtest.h>

#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {
namespace {

TEST(Table, AlignsColumnsAndLeavesNoBlanksAtTheEnd) {
  Table table({"NAME", right("SIZE"), "COMMENT"});
  table.add({"O1", "5 B", "first"});
  table.add({"O0200", "12.0 MB", ""});
  EXPECT_EQ(table.render(false),
            "NAME      SIZE  COMMENT\n"
            "O1         5 B  first\n"
            "O0200  12.0 MB  -\n");
}

TEST(Table, ColorsOnlyWhenAsked) {
  Table table({"STATE"});
  table.add({Cell("alarmed", Style::Bad)});
  EXPECT_EQ(table.render(true), "\x1b[1mSTATE\x1b[0m\n\x1b[31malarmed\x1b[0m\n");
  EXPECT_EQ(table.render(false), "STATE\nalarmed\n");
}

TEST(Table, CountsCharactersNotBytes) {
  Table table({"NAME", "X"});
  table.add({"M\u00fcller", "1"});
  table.add({"Muller", "2"});
  EXPECT_EQ(table.render(false), "NAME    X\nM\u00fcller  1\nMuller  2\n");
}

TEST(Table, LetsNoTextSteerTheTerminal) {
  Table table({"COMMENT"});
  table.add({"a\x1b[2Jb\nc"});
  EXPECT_EQ(table.render(false), "COMMENT\na [2Jb c\n");
}

TEST(Details, AlignsValues) {
  Details details;
  details.add("run", "r1");
  details.add("last line", "");
  EXPECT_EQ(details.render(false), "run        r1\nlast line  -\n");
}

TEST(Terminal, CutsAtCharacters) {
  EXPECT_EQ(cut("M\u00fcller", 6), "M\u00fcller");
  EXPECT_EQ(cut("M\u00fcllers", 4), "M\u00fcl\u2026");
  EXPECT_EQ(cut("abc", 0), "");
  EXPECT_EQ(cut("abc", 1), "\u2026");
}

}  // namespace
}  // namespace dripline::cli
