#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_calls.hpp"
#include "gateway/interpreter/registry.hpp"

/// The dialect itnc: what its golden programs do not show.
namespace dripline::interpreter {
namespace {

std::vector<std::string> detected(std::string_view head) {
  std::vector<std::string> names;
  for (const Dialect* dialect : detect_dialect(head, "PART.H")) names.emplace_back(dialect->name);
  return names;
}
using Names = std::vector<std::string>;

TEST(ItncControls, AreKnownByTheNameOfTheProgramAndTheirOwnWords) {
  EXPECT_EQ(detected("0 BEGIN PGM PART MM\n1 L X+1\n"), Names{"itnc"});
  EXPECT_EQ(detected("0 BEGIN PGM 2.5D PART INCH\n"), Names{"itnc"});
  EXPECT_EQ(detected("0 BEGIN PGM 17 MM\n1 CYCL DEF 200 DRILLING ~\n"), Names{"itnc"});
  EXPECT_EQ(detected("0 BEGIN PGM 17 MM\n1 L X+1\n"), Names{"tnc155"});
}

TEST(ItncControls, CallProgramsByTheirNames) {
  MemorySource source(
      "BEGIN PGM A MM\nCALL PGM TNC:\\PARTS\\SUB-1.H\n5 CALL PGM \"SUB 2\"\nEND PGM A MM\n");
  const auto calls = call_reader("itnc")({}, source, kMainProgram);
  ASSERT_TRUE(calls) << calls.error().what;
  ASSERT_EQ(calls->calls.size(), 2u);
  EXPECT_EQ(calls->calls[0].name, "SUB-1");
  EXPECT_EQ(calls->calls[0].line, 2u);
  EXPECT_EQ(calls->calls[1].name, "SUB 2");
}

std::string refusal(std::string_view setup) {
  const auto read = parse_setup(setup);
  if (!read) return read.error().what;
  MemorySource source("");
  EventSink sink;
  const auto made = (*find_dialect("itnc"))->make(*read, source, sink);
  return made ? "" : made.error().what;
}

TEST(ItncControls, RefuseSetupsThatTheyHaveNotWithTheName) {
  EXPECT_EQ(
      refusal("[[variable]]\nname = \"Q1999\"\nvalue = 1\n[[offset]]\nname = \"preset3\"\nX = 1\n"),
      "");
  EXPECT_EQ(refusal("[[variable]]\nname = \"Q2000\"\nvalue = 1\n"),
            "variable Q2000: this control has Q0 to Q1999");
  EXPECT_EQ(refusal("[[offset]]\nname = \"presets\"\nX = 1\n"),
            "offset presets: this control has datum and preset0, preset1 ...");
  EXPECT_NE(refusal("[control]\nmodel = \"TNC 155 A\"\n").find("model"), std::string::npos);
  EXPECT_NE(refusal("[[tool]]\nnumber = 32768\n").find("32767"), std::string::npos);
}

}  // namespace
}  // namespace dripline::interpreter
