// What a text calls, as each control's interpreter reads calls: without executing it, with the
// branches that a run may not take.
#include "gateway/interpreter/core/program_calls.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {
namespace {

Result<ProgramCalls> calls_of(std::string_view control, std::string_view text,
                              std::string_view setup_text = "", ProgramIndex program = 0) {
  const Dialect* dialect = find_dialect(control).value();
  const auto setup = parse_control_data(setup_text, dialect->units).value();
  const std::string kept(text);
  MemorySource source(kept, [&](std::string_view) { return std::optional(kept); });
  if (program != 0) program = source.find("O0001").program;
  return call_reader(control)(setup, source, program);
}

/// "O0002:3 O0003:4~ ?:5": the name and line of each call; ~ the text has it too, ? computed.
std::string words_of(const Result<ProgramCalls>& found) {
  if (!found) return found.error().what;
  std::string words;
  for (const ProgramCall& call : found->calls) {
    words += words.empty() ? "" : " ";
    if (!call.earlier.empty()) words += call.earlier + "|";
    words += fmt::format("{}:{}{}", call.name.empty() ? "?" : call.name, call.line,
                         call.is_contained ? "~" : "");
  }
  return words;
}

struct CallCase {
  const char* name;
  const char* control;
  const char* text;
  const char* expected;
  const char* setup = "";
};
class ProgramCallsOf : public testing::TestWithParam<CallCase> {};

TEST_P(ProgramCallsOf, AreThoseOfItsBlocks) {
  const CallCase& c = GetParam();
  EXPECT_EQ(words_of(calls_of(c.control, c.text, c.setup)), c.expected);
}

INSTANTIATE_TEST_SUITE_P(
    Fanuc, ProgramCallsOf,
    testing::Values(
        CallCase{"m98", "fanuc", "O0001\nM98 P2\nm98p0003\nM98P2\nM30\n", "O0002:2 O0003:3"},
        CallCase{"repeats_before_the_number", "fanuc", "M98 P30004\nM98 P5 L2\n",
                 "O0004:1 O0005:2"},
        CallCase{"m198_and_macros", "fanuc", "M198 P6\nG65 P9001 A1. M98.\nG66 P9002 X1\nG67\n",
                 "O0006:1 O9001:2 O9002:3"},
        CallCase{"m198_of_a_folder", "fanuc",
                 "M198 P6\nM98 P7\nM198 <A>\nG65 P9001 A1. M198.\nO0008\nM198 P8\n",
                 "CARD.O0006:1 O0007:2 CARD.A:3 O9001:4 CARD.O0008:6",
                 "[control]\nmodel = \"30i\"\nm198_folder = \"CARD.\"\n"},
        CallCase{"branches_not_taken", "fanuc", "IF [#1 EQ 2] GOTO 10\nM98 P7\nN10 /M98 P8\n",
                 "O0007:2 O0008:3"},
        CallCase{"not_in_comments_and_output", "fanuc",
                 "(M98 P2)\nG1 X1 (M98 P3\nDPRNT[M98*P4]\nM97 P5\nG1 P6\n", ""},
        CallCase{"computed", "fanuc", "M98 P#100\nG65 P[#1+9000] A1\nM98 P2\n", "?:1 O0002:3"},
        CallCase{"variables_are_no_words", "fanuc", "#98=1\n#[98]=2\nG65 P9001 M#1\n", "O9001:3"},
        CallCase{"blocks_of_a_line", "fanuc", "G0 X1;M98 P2;(;M98 P3;)M98 P4\n", "O0002:1 O0004:1"},
        CallCase{"bound_codes", "fanuc", "G100 P5\nM60\nT3\nG101\n", "O9010:1 O9020:2 O9000:3",
                 "control.g_macro = [100]\ncontrol.m_macro = [60]\ncontrol.t_macro = true\n"},
        CallCase{"names", "fanuc",
                 "<A>\nM98 <G65P3>\nG65 <M98P4> A1.\nM198 <B> L2\nG0 X1 <C>\nM98 <D\n",
                 "G65P3:2 M98P4:3 B:4"},
        CallCase{"after_the_tape_end", "fanuc", "%\nO1\nM98 P2\n%\nM98 P3\n", "O0002:3"}),
    [](const auto& i) { return std::string(i.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Centurion, ProgramCallsOf,
    testing::Values(
        CallCase{"m98_call_and_g65", "centurion", "M98 P2\nCALL 3\nG65 P9001 X1.\nC A L L 4\n",
                 "O0002:1 O0003:2 O9001:3 O0004:4"},
        CallCase{"conditions", "centurion", "IF P1 EQ 2 THEN M98 P7\nIF P1 EQ 2 THEN CALL 8\n",
                 "O0007:1 O0008:2"},
        CallCase{"gosub_stays_in_the_program", "centurion", "GOSUB 100\nM98 P2\n", "O0002:2"},
        CallCase{"g65_without_p", "centurion", "G65 X1.\n", ""},
        CallCase{"computed", "centurion", "CALL [P1]\nM98 P[P2+1]\n", "?:1"},
        CallCase{"not_in_comments_and_output", "centurion",
                 "(CALL 2)\nPRINT[M98 P3]\nDPRNT[CALL 4]\nG0 X1. (M98 P5)\n", ""},
        CallCase{"bound_codes", "centurion", "G100\nM60\nM6\n",
                 "RAM-O9010|O9010:1 RAM-O9020|O9020:2 RAM-O9100|O9100:3",
                 "control.custom_g = [100]\ncontrol.custom_m = [60]\ncontrol.m6_macro = 9100\n"}),
    [](const auto& i) { return std::string(i.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Tnc155, ProgramCallsOf,
    testing::Values(
        CallCase{"plain_language", "tnc155",
                 "0 BEGIN PGM 1 MM\n1 CALL PGM 12\n2 CALL LBL 3\n3 LBL 3\n4 LBL 0\n"
                 "5 CYCL DEF 12.0 PGM CALL\n6 CYCL DEF 12.1 PGM 13\n7 END PGM 1 MM\n",
                 "12:2 13:7"},
        CallCase{"without_block_numbers", "tnc155", "CALL PGM 12\n", "12:1"},
        CallCase{"iso", "tnc155", "%1 G71 *\nN10 %12 *\nN20 L3,0 *\nN9999 %1 G71 *\n", "12:2"},
        CallCase{"past_a_block_that_is_none", "tnc155",
                 "0 BEGIN PGM 1 MM\n1 L X+WRONG\n2 CALL PGM 12\n3 END PGM 1 MM\n", "12:3"}),
    [](const auto& i) { return std::string(i.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Rs274Ngc, ProgramCallsOf,
    testing::Values(
        CallCase{"files", "rs274ngc", "o<Pocket Side> call [1] [2]\nO100 CALL\nM2\n",
                 "pocketside:1 100:2"},
        CallCase{"a_sub_before_its_call", "rs274ngc", "o100 sub\no100 endsub\no100 call\nM2\n", ""},
        CallCase{"a_sub_after_its_call_may_be_a_file", "rs274ngc",
                 "o100 call\nM2\no100 sub\no100 endsub\n", "100:1~"},
        CallCase{"m98", "rs274ngc", "M98 P200 L3\nM98 P300\nM2\no300\nM99\n", "200:1"},
        CallCase{"lathe_cycles", "rs274ngc",
                 "G71.1 Q200 X5\nG70 X1 Q[#1]\nG83 X1 Q3\nG7.1 Q4\nM2\n", "200:1 ?:2"},
        CallCase{"computed", "rs274ngc", "o[#1] call\nM98 P#2\n", "?:1"},
        CallCase{"not_in_comments", "rs274ngc", "(o1 call)\n; M98 P2\nG1 X1 (M98) P3\n", ""},
        CallCase{"other_o_words", "rs274ngc", "o1 while [1]\no1 endwhile\no2 if [1]\no2 endif\n",
                 ""}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(ProgramCalls, AreContainedInTheTextThatIsStarted) {
  const std::string text = "O0001\nM98 P2\nM30\nO0002\nM98 P3\nM99\n";
  EXPECT_EQ(calls_of("fanuc", text)->contained, (std::set<std::string>{"O0001", "O0002"}));
  EXPECT_EQ(calls_of("centurion", text)->contained, (std::set<std::string>{"O0001", "O0002"}));
  const std::string named = "<A>\nM98 <B>\nM30\nO<B>\nM98 <C>\nM99\n";
  EXPECT_EQ(calls_of("fanuc", named)->contained, (std::set<std::string>{"A", "B"}));
  // A text that is called is left at its next program.
  EXPECT_EQ(words_of(calls_of("fanuc", text, "", 1)), "O0002:2");
  EXPECT_EQ(words_of(calls_of("centurion", text, "", 1)), "O0002:2");
}

TEST(ProgramCalls, AreRefusedWhereTheTextIsNotUnderstood) {
  EXPECT_EQ(calls_of("fanuc", "M98 P2\n" + std::string(70000, 'X')).error().code,
            Errc::LimitExceeded);
  std::string many;
  for (int i = 1; i <= 1100; ++i) many += fmt::format("M98 P{}\n", i);
  EXPECT_EQ(calls_of("fanuc", many).error().code, Errc::LimitExceeded);
  EXPECT_EQ(calls_of("tnc155", "1 L X" + std::string(70000, '1') + "\n").error().code,
            Errc::Syntax);
}

TEST(ProgramCalls, ControlsWithoutCallsHaveNone) {
  EXPECT_EQ(call_reader("tektronix-1704"), nullptr);
  EXPECT_EQ(call_reader("prototrak-plus"), nullptr);
}

}  // namespace
}  // namespace dripline::interpreter
