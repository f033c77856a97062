#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// BEGIN, `blocks - 2` pole blocks, END.
std::string program_text(int number, int blocks, const std::string& second = "") {
  std::string text = fmt::format("0 BEGIN PGM {} MM\n", number);
  for (int i = 1; i < blocks - 1; ++i) {
    text += i == 1 && !second.empty() ? fmt::format("1 {}\n", second) : fmt::format("{} CC\n", i);
  }
  return text + fmt::format("{} END PGM {} MM\n", blocks - 1, number);
}

/// A program calls the others one after the other.
std::string calling_text(int number, const std::vector<int>& called) {
  std::string text = fmt::format("0 BEGIN PGM {} MM\n", number);
  int block = 1;
  for (const int other : called) text += fmt::format("{} CALL PGM {}\n", block++, other);
  return text + fmt::format("{} END PGM {} MM\n", block, number);
}

class Tnc155Memory : public testing::Test {
 protected:
  MemoryVerdict fit(const std::string& text) {
    MemorySource source(text, [this](std::string_view name) -> std::optional<std::string> {
      const auto found = library_.find(std::string(name));
      if (found == library_.end()) return std::nullopt;
      return found->second;
    });
    auto verdict = check_memory(setup_, source);
    EXPECT_TRUE(verdict) << verdict.error().what;
    return verdict ? *std::move(verdict) : MemoryVerdict{};
  }
  std::vector<std::string> texts(const std::string& text) {
    std::vector<std::string> texts;
    for (const Diagnostic& refused : fit(text).refused) texts.push_back(refused.text);
    return texts;
  }
  void set(std::string_view options) {
    auto setup = parse_setup("[control]\n" + std::string(options));
    ASSERT_TRUE(setup) << setup.error().what;
    setup_ = *std::move(setup);
  }

  std::map<std::string, std::string> library_;
  interpreter::Setup setup_;
};

using Texts = std::vector<std::string>;

// HD-053
TEST_F(Tnc155Memory, Holds999BlocksOfAProgram) {
  EXPECT_EQ(texts(program_text(7, 999)), Texts{});
  const auto verdict = fit(program_text(7, 1000));
  EXPECT_FALSE(verdict.is_binding);
  ASSERT_EQ(verdict.refused.size(), 1u);
  EXPECT_EQ(verdict.refused[0].id, "TNC-MEMORY");
  EXPECT_EQ(verdict.refused[0].line, 1u);
  EXPECT_EQ(verdict.refused[0].text,
            "PROGRAM MEMORY EXCEEDED: program 7 has 1000 blocks, 999 is most; it can only be "
            "transferred blockwise");
}

// HD-235: what a control without transfer blockwise cannot keep it cannot run.
TEST_F(Tnc155Memory, IsBindingWhereNothingIsTransferredBlockwise) {
  set("model = \"TNC 155 E\"\n");
  const auto verdict = fit(program_text(7, 1000));
  EXPECT_TRUE(verdict.is_binding);
  ASSERT_EQ(verdict.refused.size(), 1u);
  EXPECT_EQ(verdict.refused[0].text,
            "PROGRAM MEMORY EXCEEDED: program 7 has 1000 blocks, 999 is most");
  set("model = \"TNC 155 P\"\n");
  EXPECT_FALSE(fit(program_text(7, 1000)).is_binding);
}

// HD-239: a TNC 151 may have 1200 blocks.
TEST_F(Tnc155Memory, IsThatOfTheModel) {
  set("model = \"TNC 151 A\"\nmemory_blocks = 1200\nmemory_limits = true\n");
  library_["1"] = program_text(1, 999);
  library_["2"] = program_text(2, 197);
  EXPECT_EQ(texts(calling_text(9, {1, 2})), Texts{});
  library_["2"] = program_text(2, 198);
  EXPECT_EQ(texts(calling_text(9, {1, 2})).size(), 1u);
}

// HD-052: 4 + 3 x 999 are 3001, so that 99 are vacant for the last one.
TEST_F(Tnc155Memory, CountsTheBlocksOfCalledPrograms) {
  for (const int number : {1, 2, 3}) library_[std::to_string(number)] = program_text(number, 999);
  library_["4"] = program_text(4, 97);
  EXPECT_EQ(texts(calling_text(9, {1, 2, 3, 4})), Texts{});
  library_["4"] = program_text(4, 98);
  const auto verdict = fit(calling_text(9, {1, 2, 3, 4}));
  ASSERT_EQ(verdict.refused.size(), 1u);
  EXPECT_EQ(verdict.refused[0].text,
            "PROGRAM MEMORY EXCEEDED: program 4 has 98 blocks, 97 are vacant (in program 4, which "
            "is called here); it can only be transferred blockwise");
  EXPECT_EQ(verdict.refused[0].line, 5u);
}

// HD-051
TEST_F(Tnc155Memory, Holds32Programs) {
  std::vector<int> called;
  for (int number = 1; number <= 32; ++number) {
    library_[std::to_string(number)] = program_text(number, 3);
    called.push_back(number);
  }
  const auto all = texts(calling_text(99, called));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].starts_with(
      "PROGRAM MEMORY EXCEEDED: program 32 is more than the 32 programs the control keeps"));
  called.pop_back();
  EXPECT_EQ(texts(calling_text(99, called)), Texts{});
}

TEST_F(Tnc155Memory, FollowsCallsOfCalledProgramsAndCycle12ButNoRing) {
  library_["1"] = program_text(1, 3, "CALL PGM 2");
  library_["2"] = program_text(2, 1200, "CALL PGM 1");
  EXPECT_EQ(texts(calling_text(9, {1})).size(), 1u);
  const std::string cycle =
      "0 BEGIN PGM 9 MM\n1 CYCL DEF 12.0 PGM CALL\n2 CYCL DEF 12.1 PGM 2\n"
      "3 END PGM 9 MM\n";
  EXPECT_EQ(texts(cycle).size(), 1u);
  EXPECT_EQ(texts("%9 G71 *\nN10 %2 *\nN9999 %9 G71 *\n").size(), 1u);
  EXPECT_EQ(texts(calling_text(9, {77})), Texts{});  // the run says that it is missing
}

TEST_F(Tnc155Memory, IsAnAlarmWhereTheControlKeepsItsPrograms) {
  set("memory_limits = true\nmemory_blocks = 1200\n");
  library_["2"] = program_text(2, 999);
  const auto verdict = fit(program_text(1, 300, "CALL PGM 2"));
  EXPECT_TRUE(verdict.is_binding);
  ASSERT_EQ(verdict.refused.size(), 1u);
  EXPECT_EQ(
      verdict.refused[0].text,
      "PROGRAM MEMORY EXCEEDED: program 2 has 999 blocks, 900 are vacant (in program 2, which "
      "is called here)");
  EXPECT_TRUE(fit(program_text(1, 201, "CALL PGM 2")).refused.empty());
}

TEST_F(Tnc155Memory, RefusesALabelSetTwiceThoughItIsNeverMet) {
  set("memory_limits = true\n");
  EXPECT_EQ(texts("0 BEGIN PGM 7 MM\n1 STOP M02\n2 LBL 5\n3 LBL 0\n4 LBL 5\n5 LBL 0\n"
                  "6 END PGM 7 MM\n"),
            Texts{"NUMBER ALREADY ALLOCATED: LBL 5 is set twice"});
}

// HD-144: whether the run comes there or not, and whatever precedes it.
TEST_F(Tnc155Memory, WarnsOfALabelSetTwiceWhereverItStands) {
  const Texts twice{
      "NUMBER ALREADY ALLOCATED: LBL 4 is set twice; it can only be transferred blockwise"};
  const auto verdict = fit("0 BEGIN PGM 7 MM\n1 STOP M02\n2 LBL 4\n3 LBL 4\n4 END PGM 7 MM\n");
  ASSERT_EQ(verdict.refused.size(), 1u);
  EXPECT_EQ(verdict.refused[0].text, twice[0]);
  EXPECT_EQ(verdict.refused[0].id, "TNC-NUMBER-ALLOCATED");
  EXPECT_EQ(verdict.refused[0].line, 4u);
  EXPECT_EQ(texts("0 BEGIN PGM 7 MM\n1 LBL 4\n2 LBL ?\n3 LBL 4\n4 END PGM 7 MM\n"), twice);
  EXPECT_EQ(texts("%7 G71 *\nN10 G98 L4 * N20 M02 * N30 G98 L4 *\nN9999 %7 G71 *\n"), twice);
  EXPECT_EQ(texts("0 BEGIN PGM 7 MM\n1 LBL 4\n2 LBL 5\n3 LBL 0\n4 LBL 0\n5 END PGM 7 MM\n"),
            Texts{});
}

// HD-229: what is transferred blockwise may have numbers up to 65534, with gaps.
TEST_F(Tnc155Memory, HasRoomForThreeDigitsOfABlockNumber) {
  const std::string high = "0 BEGIN PGM 7 MM\n1200 CC\n65534 END PGM 7 MM\n";
  EXPECT_EQ(texts(high),
            Texts{"BLOCK NUMBER INCORRECT: 1200 is more than 999; it can only be transferred "
                  "blockwise"});
  EXPECT_EQ(texts("%7 G71 *\nN9998 G29 *\nN9999 %7 G71 *\n"), Texts{});
  EXPECT_EQ(texts("%7 G71 *\nN10000 G29 *\nN65534 %7 G71 *\n").size(), 1u);
}

TEST_F(Tnc155Memory, StopsCountingWhereNoBlockNumberIsLeft) {
  std::string text = "BEGIN PGM 7 MM\n";
  for (int i = 0; i < 65'600; ++i) text += "CC\n";
  const auto all = texts(text);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].starts_with(
      "PROGRAM MEMORY EXCEEDED: program 7 has more than 65534 blocks, 999 is most"));
}

TEST_F(Tnc155Memory, NamesAWrongOptionWithItsLimits) {
  set("memory_blocks = 0\n");
  MemorySource source("");
  const auto verdict = check_memory(setup_, source);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().what, "option memory_blocks: 0 is not a number from 1 to 100000");
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
