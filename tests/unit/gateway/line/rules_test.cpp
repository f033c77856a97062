#include <gtest/gtest.h>

#include "gateway/line/inbound/inbound_splitter.hpp"
#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/inbound/rule_reader.hpp"

namespace dripline::line {
namespace {

RuleSet rules(std::string_view toml) {
  auto read = read_rules(toml);
  EXPECT_TRUE(read) << read.error().what;
  return read ? *std::move(read) : RuleSet{};
}

std::string error_of(std::string_view toml) {
  const auto read = read_rules(toml);
  return read ? "read" : read.error().what;
}

TEST(Rules, FireInOrderAndTheFirstDecides) {
  const auto set = rules(R"(
[[set]]
name = "calls"
program = "O9999"
[[set.rule]]
name = "send"
trigger = "prg"
action = "send"
argument = "O{}"
[[set.rule]]
action = "directory"
[[set]]
name = "reports"
[[set.rule]]
name = "noise"
matches = "^READY"
action = "ignore"
[[set.rule]]
name = "probe"
matches = "^P([0-9]+) "
kind = "line"
action = "report"
probe = true
)");
  EXPECT_EQ(set.size(), 4u);
  auto hit = set.judge(TextKind::Program, "%\nO09999\n( PRG = 12 )\nM30\n");
  EXPECT_EQ(hit.action, RuleAction::Send);
  EXPECT_EQ(hit.argument, "O12");
  EXPECT_EQ(hit.rule->name, "calls/send");
  hit = set.judge(TextKind::Program, "O9999\nM30\n");
  EXPECT_EQ(hit.action, RuleAction::Directory);
  EXPECT_EQ(hit.rule->name, "calls/rule 2");
  EXPECT_EQ(set.judge(TextKind::Program, "O9998\n(PRG=12)\n").action, RuleAction::Program);
  EXPECT_EQ(set.judge(TextKind::Line, "READY.").action, RuleAction::Ignore);
  hit = set.judge(TextKind::Line, "P17 X1.5");
  EXPECT_TRUE(hit.is_probe);
  EXPECT_EQ(hit.argument, "17");
  hit = set.judge(TextKind::Line, "X1.5");
  EXPECT_EQ(hit.rule, nullptr);
  EXPECT_EQ(hit.action, RuleAction::Report);
}

TEST(Rules, ExplainWhyEachOneFiresOrNot) {
  const auto set = rules(R"(
[[rule]]
name = "call"
program = "O9999"
action = "send"
[[rule]]
name = "point"
matches = "^X"
action = "report"
)");
  const auto verdict = set.explain("X1.5 Y2\n");
  EXPECT_EQ(verdict.rule, "point");
  EXPECT_EQ(verdict.action, "report");
  ASSERT_EQ(verdict.why.size(), 3u);
  EXPECT_EQ(verdict.why[1], "call: it is no program");
  EXPECT_EQ(verdict.why[2], "point: fires");
  const auto other = set.explain("%\nO15\nM30\n%\n");
  EXPECT_EQ(other.rule, "");
  EXPECT_EQ(other.action, "program");
  EXPECT_EQ(other.argument, "O15");
  EXPECT_EQ(other.why[1], "call: the program is O15, not O9999");
  EXPECT_EQ(set.explain("").action, "ignore");
}

TEST(Rules, AreRefusedWithLineAndWord) {
  EXPECT_NE(error_of("[[rule]]\naction = \"fly\"").find("line 2: action 'fly'"), std::string::npos);
  EXPECT_NE(error_of("[[rule]]\ncolor = \"red\"\naction = \"ignore\"").find("'color'"),
            std::string::npos);
  EXPECT_NE(error_of("[[rule]]\nname = \"a\"").find("no action"), std::string::npos);
  EXPECT_NE(error_of("[[rule]]\nmatches = \"(\"\naction = \"ignore\"").find("line 2: matches"),
            std::string::npos);
  EXPECT_NE(error_of("[[rule]]\nname = 3\naction = \"ignore\"").find("name must be a string"),
            std::string::npos);
  EXPECT_NE(error_of("rule = 3").find("[[rule]]"), std::string::npos);
  EXPECT_NE(error_of("reply = ").find("line 1"), std::string::npos);
  std::string many;
  for (int i = 0; i < 65; ++i) many += "[[rule]]\naction = \"ignore\"\n";
  EXPECT_NE(error_of(many).find("more than 64 rules"), std::string::npos);
  EXPECT_EQ(error_of(""), "read");
}

TEST(Rules, FindTriggersInCommentsOnly) {
  EXPECT_EQ(find_trigger("(PRG=12)", "PRG"), "12");
  EXPECT_EQ(find_trigger("G0 (a) ( prg = part 7 )", "PRG"), "part 7");
  EXPECT_EQ(find_trigger("(DIR)", "DIR"), "");
  EXPECT_EQ(find_trigger("; PRG=9\nG0", "PRG"), "9");
  EXPECT_FALSE(find_trigger("PRG=12", "PRG"));
  EXPECT_FALSE(find_trigger("(PRGX=12)", "PRG"));
  EXPECT_FALSE(find_trigger("(", "PRG"));
}

TEST(Rules, TellProgramsFromWhatIsPrinted) {
  EXPECT_TRUE(begins_program("O1234 (PART)", false));
  EXPECT_TRUE(begins_program(":1234", false));
  EXPECT_TRUE(begins_program("%PART-7", false));
  EXPECT_TRUE(begins_program("0 BEGIN PGM 15 MM", false));
  EXPECT_TRUE(begins_program("N10 G0", true));
  EXPECT_FALSE(begins_program("N10 G0", false));
  EXPECT_FALSE(begins_program("X1.5 Y2", true));
  EXPECT_FALSE(begins_program("OK", false));
  EXPECT_EQ(program_name("%\n(HEAD)\nO0015(A)\n"), "O0015");
  EXPECT_EQ(program_name("%\n:15\n"), "O15");
  EXPECT_EQ(program_name("0 BEGIN PGM 77 MM\n"), "77");
  EXPECT_EQ(program_name("G0\nO15\n"), "");
  EXPECT_TRUE(is_same_program("O0015", "15"));
  EXPECT_FALSE(is_same_program("O15", "O150"));
}

std::string text_of_items(const std::vector<InboundSplitter::Item>& items) {
  std::string text;
  for (const auto& item : items) {
    using What = InboundSplitter::Item::What;
    if (item.what == What::Line) text += "L<" + item.text + (item.is_cut ? "|>" : ">");
    if (item.what == What::ProgramBegan) text += "P<" + item.text + ":";
    if (item.what == What::ProgramText) text += item.text;
    if (item.what == What::ProgramEnded) text += ">";
    if (item.what == What::ProgramFailed) text += "!";
  }
  return text;
}

std::string whole(InboundSplitter& splitter, std::string_view text) {
  std::string all = text_of_items(splitter.take(text));
  return all += text_of_items(splitter.end());
}

std::string cut_off(InboundSplitter& splitter, std::string_view text) {
  std::string all = text_of_items(splitter.take(text));
  return all += text_of_items(splitter.fail());
}

TEST(InboundSplitter, CutsTheSameHoweverTheTextArrives) {
  static constexpr char kText[] =
      "X1\r\n%\nO1\nG0\n%\nREADY\n%\nDPRNT 1\nN2\n%\n\0%\n(A)\nM30\n%\nO2\nG1";
  const std::string text(kText, sizeof kText - 1);
  const RuleSet none;
  for (std::size_t step = 1; step <= text.size(); ++step) {
    InboundSplitter splitter(none);
    std::string all;
    for (std::size_t at = 0; at < text.size(); at += step) {
      all += text_of_items(splitter.take(std::string_view(text).substr(at, step)));
    }
    all += text_of_items(splitter.end());
    EXPECT_EQ(all, "L<X1>P<:%\nO1\nG0\n%\n>L<READY>L<DPRNT 1>L<N2>P<:%\n(A)\nM30\n%\n>P<:O2\nG1\n>")
        << step;
  }
}

TEST(InboundSplitter, TakesWhatAProtocolNamesAsAProgram) {
  const RuleSet none;
  InboundSplitter splitter(none);
  splitter.begin("15");
  EXPECT_EQ(whole(splitter, "X1\n%\n%\n"), "P<15:X1\n%\n%\n>");
  EXPECT_EQ(text_of_items(splitter.take("X1\n")), "L<X1>");
}

TEST(InboundSplitter, DropsAProgramThatIsCutOffAndKeepsPrintedLines) {
  const RuleSet none;
  InboundSplitter splitter(none);
  EXPECT_EQ(cut_off(splitter, "O1\nG0\nG1"), "P<:O1\nG0\n!");
  EXPECT_EQ(cut_off(splitter, "X1\nX2"), "L<X1>L<X2|>");
}

TEST(InboundSplitter, SaysThatALineWhichSilenceEndsMayNotBeWhole) {
  const RuleSet none;
  InboundSplitter splitter(none);
  EXPECT_EQ(text_of_items(splitter.take("D 40\nD 40.0")), "L<D 40>");
  EXPECT_EQ(text_of_items(splitter.end_silent()), "L<D 40.0|>");
  EXPECT_EQ(whole(splitter, "9\nEND"), "L<9>L<END>") << "its protocol says that it is whole";
  EXPECT_EQ(text_of_items(splitter.take("O1\nM30")), "P<:O1\n");
  EXPECT_EQ(text_of_items(splitter.end_silent()), "M30\n>");
}

TEST(InboundSplitter, SaysThatTextOfALineIsLost) {
  const RuleSet none;
  InboundSplitter splitter(none);
  (void)splitter.take("D 4");
  splitter.lose();
  EXPECT_EQ(text_of_items(splitter.take("9\nD 40\n")), "L<D 49|>L<D 40>");
}

TEST(InboundSplitter, DropsAProgramThatIsCutOffInItsFirstLine) {
  const RuleSet none;
  InboundSplitter splitter(none);
  EXPECT_EQ(cut_off(splitter, "O1 G0 X1"), "P<:!");
  splitter.take_programs_only(true);
  EXPECT_EQ(cut_off(splitter, "PN8 G20 ;G01 X1 Y1 F5 ;"), "P<:!");
}

TEST(InboundSplitter, TakesAProgramInOneLongLineForAProgram) {
  const RuleSet none;
  InboundSplitter splitter(none);
  splitter.take_programs_only(true);
  std::string text = "PN8 G20 ;";
  while (text.size() < 3 * InboundSplitter::kMaxLine) text += "G01 X1 Y1 F5 ;";
  EXPECT_EQ(whole(splitter, text), "P<:" + text + "\n%\n>");
}

/// What came before it went to another server, or is lost with the line.
TEST(InboundSplitter, TakesTheRestOfATextForNoProgram) {
  const RuleSet none;
  InboundSplitter splitter(none);
  splitter.take_programs_only(true);
  splitter.expect_rest();
  EXPECT_FALSE(splitter.may_be_program());
  EXPECT_EQ(text_of_items(splitter.take("X1 Y1\nG1\nPN8 G20 ;\nG0\n")),
            "L<X1 Y1|>L<G1>P<:PN8 G20 ;\nG0\n");
  EXPECT_TRUE(splitter.has_rest());
  EXPECT_EQ(text_of_items(splitter.end()), "%\n>");
  EXPECT_EQ(whole(splitter, "G1\n"), "P<:G1\n%\n>") << "the next text is whole";
  splitter.expect_rest();
  EXPECT_EQ(whole(splitter, "PN9 G20 ;\n"), "P<:PN9 G20 ;\n%\n>") << "it begins as one";
  splitter.take_programs_only(false);
  splitter.expect_rest();
  EXPECT_EQ(whole(splitter, "O1)\nM30\n"), "L<O1)|>L<M30>") << "the end of a comment";
  splitter.expect_rest();
  EXPECT_EQ(whole(splitter, "%\nO1\nM30\n%\n"), "P<:%\nO1\nM30\n%\n>");
}

TEST(InboundSplitter, MarksLinesUntilAProgramBeginsOrTheTransferIsOver) {
  const RuleSet none;
  InboundSplitter splitter(none);
  const auto marked = [&](std::vector<InboundSplitter::Item> items) {
    std::string words;
    for (const auto& item : items)
      if (item.what == InboundSplitter::Item::What::Line)
        words += item.text + (item.may_be_rest ? "? " : "! ");
    return words;
  };
  splitter.mark_rest();
  EXPECT_EQ(marked(splitter.take("V 1\nV 2\n")), "V 1? V 2? ");
  EXPECT_EQ(marked(splitter.take("O1\nM30\n")), "");
  EXPECT_EQ(marked(splitter.end()), "");
  EXPECT_EQ(marked(splitter.take("V 3\n")), "V 3! ");
  splitter.mark_rest();
  EXPECT_EQ(marked(splitter.end_silent()), "");
  EXPECT_EQ(marked(splitter.take("V 4\n")), "V 4! ");
}

TEST(InboundSplitter, KnowsPrintedLinesFromWhatMayBeAProgram) {
  const RuleSet none;
  InboundSplitter splitter(none);
  (void)splitter.take("V 1\nV 2");
  EXPECT_FALSE(splitter.may_be_program());
  (void)splitter.take("\nO12");
  EXPECT_TRUE(splitter.may_be_program());
  (void)splitter.take("\nG0\n");
  EXPECT_TRUE(splitter.may_be_program());
}

TEST(InboundSplitter, BoundsALine) {
  const RuleSet none;
  InboundSplitter splitter(none);
  const auto items = splitter.take(std::string(10'000, 'X') + "\n");
  ASSERT_EQ(items.size(), 3u);
  for (const auto& item : items) EXPECT_LE(item.text.size(), InboundSplitter::kMaxLine);
  EXPECT_TRUE(items[0].is_cut && items[1].is_cut) << "the last is the rest of them";
}

TEST(InboundSplitter, LetsRulesDecideWhatALineIs) {
  const auto set = rules(R"(
[[rule]]
matches = "^START "
action = "program"
[[rule]]
matches = "^O[0-9]+ READY"
action = "report"
)");
  InboundSplitter splitter(set);
  EXPECT_EQ(whole(splitter, "O12 READY\nSTART A\nX1\n"), "L<O12 READY>P<:START A\nX1\n>");
}

}  // namespace
}  // namespace dripline::line
