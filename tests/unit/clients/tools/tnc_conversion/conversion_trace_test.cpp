#include <gtest/gtest.h>

#include <random>

#include <fmt/format.h>

#include "clients/tools/tnc_conversion/conversion.hpp"
#include "tests/golden/golden_case.hpp"
#include "tests/support/tnc155_trace.hpp"

/// A program and its conversion do the same: over the golden programs, and over programs made at
/// random with a fixed seed.
namespace dripline::tnc_conversion {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

Form other(Form form) {
  return form == Form::Plain ? Form::Iso : Form::Plain;
}

/// Without the warning of an order of words that one form alone has.
std::string motion_of(const std::string& text) {
  constexpr std::string_view kOfIso = "\"code\":\"TNC-DISTANCE-ORDER\"\n";
  std::string trace = tnc155_trace(text);
  for (auto at = trace.find(kOfIso); at != std::string::npos; at = trace.find(kOfIso, at))
    trace.erase(at, kOfIso.size());
  return trace;
}

/// Converts there and back, and compares what the three do. False: it has no counterpart.
bool does_the_same(const std::string& text) {
  const auto there = convert_program(text, other(detect_form(text)));
  if (!there) {
    EXPECT_EQ(there.error().code, Errc::Unsupported) << there.error().what << "\n" << text;
    return false;
  }
  const std::string trace = motion_of(text);
  EXPECT_EQ(motion_of(*there), trace) << text << "\n" << *there;
  const auto back = convert_program(*there, detect_form(text));
  EXPECT_TRUE(back.has_value()) << (back ? "" : back.error().what) << "\n" << *there;
  if (back) {
    EXPECT_EQ(motion_of(*back), trace) << text << "\n" << *back;
  }
  return true;
}

TEST(Tnc155ConversionTrace, OfGoldenProgramsIsTheSame) {
  int converted = 0;
  for (const GoldenCase& golden : golden_cases("tnc155")) {
    SCOPED_TRACE(golden.name);
    const std::string text = golden.program();
    const auto readable = rewrite_program(text);
    if (!readable) continue;  // a case of a block that cannot be read
    converted += does_the_same(text) ? 1 : 0;
  }
  EXPECT_GE(converted, 20);
}

TEST(Tnc155ConversionTrace, OfACornerInTheBlockOfAToolIsTheSame) {
  const std::string corner =
      "%7 G71\nN1 T0 G17 S70\nN2 G01 G40 G90 X+59 Y-8 F90\nN3 T0 S80 G25 R2\nN4 X+9 Y+9\n";
  EXPECT_TRUE(does_the_same(corner));
  const std::string approach =
      "%7 G71\nN1 T0 G17 S70\nN2 G01 G41 G90 X+59 Y-8 F90\nN3 T0 S80 G26 R2\nN4 X+9 Y+9\n";
  does_the_same(approach);
}

/// In plain language what precedes the corner is a block between it and its move: which
/// of two alarms is the first depends on it.
TEST(Tnc155ConversionTrace, OfACornerAfterOtherWordsIsTheSame) {
  for (const char* words : {"G40", "G41", "F70", "M08", "G90 F70"}) {
    for (const char* move : {"X+59 Y-8", "X+59", "X+Q1 Y-8 Z+1"}) {
      EXPECT_TRUE(
          does_the_same(fmt::format("%7 G71\nN1 G99 T1 L+0 R+2\nN2 T1 G17 S70\nN3 G01 G40 "
                                    "G90 X+0 Y+0 F90\nN4 {}\nN5 {} G25 R1\nN6 X+9 Y+9\n",
                                    move, words)));
    }
  }
}

/// Ends of blocks take no room between two moves: a loop has more of them in plain language.
TEST(Tnc155ConversionTrace, OfALongWaitBetweenMovesIsTheSame) {
  EXPECT_TRUE(
      does_the_same("%7 G71\nN1 G99 T1 L+0 R+2\nN2 T1 G17 S70\nN3 G01 G40 G90 X+0 Y+0 F90\n"
                    "N4 G41 X+20 Y+0\nN5 X+20 Y+20\nN6 G98 L1\nN7 G04 F0,1 M08\nN8 L1.23\n"
                    "N9 X+0 Y+20\nN10 G40 X+0 Y+0\n"));
}

/// The plane that ISO has to say before the first move is not always the one that it runs in.
TEST(Tnc155ConversionTrace, OfMovesBeforeTheFirstPlaneIsTheSame) {
  const std::string definition =
      "0 BEGIN PGM 7 MM\n1 DEF BLK FORM MIN Y X+0 Y+0 Z+0\n2 DEF BLK FORM MAX X+9 Y+9 Z+9\n"
      "3 TOOL DEF 1 L+7 R+2\n4 L X+1 Y+2 Z+3 R0 F100\n";
  const std::string rest =
      "7 TOOL CALL 1 X S 100\n8 L X+5 Y+6\n9 CC Y+0 Z+0\n10 CP IPA+90 DR+\n11 END PGM 7 MM\n";
  for (const char* between :
       {"", "5 L X+9 Z+9\n", "5 CC X+0 Y+0\n6 CP IPA+90 DR+\n", "5 CC Y+0 Z+0\n",
        "5 LP PR+5 PA+9 R0\n", "5 L X+5 Y+5\n6 RND R1\n", "5 X+20 R+\n", "5 TOOL CALL 1\n",
        "5 LBL 1\n6 L IX+1\n", "5 CALL LBL 1 REP\n6 LBL 1\n", "5 CALL PGM 8\n"}) {
    EXPECT_TRUE(does_the_same(fmt::format("{}{}{}", definition, between, rest))) << between;
  }
}

/// END PGM, where the text ends without it.
TEST(Tnc155ConversionTrace, OfProgramsWithoutTheirEndIsTheSame) {
  const std::string head =
      "0 BEGIN PGM 7 MM\n1 TOOL DEF 1 L+0 R+2\n2 TOOL CALL 1 Z S 100\n3 L X+0 Y+0 R0 F100\n";
  for (const char* last : {"4 L X+20 Y+0 RL\n5 L X+20 Y+30\n", "4 L X+20 Y+0\n5 RND R2\n",
                           "4 LBL 1\n5 L IX+1\n6 CALL LBL 1 REP 2/2\n", "4 STOP M02\n"}) {
    does_the_same(head + last);
  }
  EXPECT_TRUE(does_the_same(head));
}

/// Programs of plain language whose blocks all can be read.
class ProgramMaker {
 public:
  explicit ProgramMaker(unsigned seed) : random_(seed) {}

  std::string make() {
    text_ = pick(4) == 0 ? "0 BEGIN PGM 7 INCH\n" : "0 BEGIN PGM 7 MM\n";
    number_ = 1;
    if (pick(6) == 0) {
      add("DEF BLK FORM MIN {} X+0 Y+0 Z+0", "XYZ"[pick(3)]);
      add("DEF BLK FORM MAX X+9 Y+9 Z+9");
    }
    if (pick(4) != 0) add("TOOL DEF 1 L+0 R+{}", pick(4));
    if (pick(6) == 0) add("L X{} Y{} Z{} R0 F70", length(), length(), length());
    if (pick(12) == 0) add_block();
    if (pick(8) != 0) add("TOOL CALL 1 {} S 500", "ZZZZYX"[pick(6)]);
    add("L X{} Y{} Z{} R0 F{} M03", length(), length(), length(), 10 + pick(500));
    const unsigned blocks = 3 + pick(14);
    for (unsigned i = 0; i < blocks; ++i) add_block();
    if (has_label_) add("CALL LBL 1 REP {}", pick(3) + 1);
    if (pick(8) != 0) add("END PGM 7 {}", text_.find("INCH") == std::string::npos ? "MM" : "INCH");
    return text_;
  }

 private:
  unsigned pick(unsigned choices) { return static_cast<unsigned>(random_() % choices); }
  template <class... Args>
  void add(std::string_view block, const Args&... args) {
    text_ += fmt::format("{} ", number_++) + fmt::format(fmt::runtime(block), args...) + "\n";
  }
  std::string length() {
    return fmt::format("{}{},{:03}", pick(2) ? "+" : "-", pick(40), pick(8) * 125);
  }
  std::string axis(char name) { return fmt::format("{}{}{}", pick(4) ? "" : "I", name, length()); }
  std::string compensation() {
    static constexpr std::array kWords{"R", "R", "R", "R", "R0", "R0", "RL", "RR"};
    return kWords[pick(kWords.size())];
  }
  std::string tail() {
    static constexpr std::array kFeeds{"F", "F", "F90", "F200"};
    static constexpr std::array kAuxiliary{"M", "M", "M", "M", "M", "M08", "M97", "M98", "M99"};
    return fmt::format("{} {} {}", compensation(), kFeeds[pick(kFeeds.size())],
                       kAuxiliary[pick(kAuxiliary.size())]);
  }
  std::string turn() { return pick(2) ? "DR+" : "DR-"; }

  void add_block() {
    switch (pick(19)) {
      case 0:
        return add("CC {} {}", axis('X'), axis('Y'));
      case 1:
        return add("CC");
      case 2:
        return add("LP PR+{} PA{} {}", 1 + pick(30), length(), tail());
      case 3:
        return add("LP {}PA{} {}", pick(2) ? "I" : "", length(), tail());
      case 4:
        return add("CP {}PA{} {} {}", pick(2) ? "I" : "", length(), turn(), tail());
      case 5:
        return add("CP IPA+720 IZ{} {} {}", length(), turn(), tail());
      case 6:
        return add("C {} {} {} {}", axis('X'), axis('Y'), turn(), tail());
      case 7:
        return add("CT {} {} {}", axis('X'), axis('Y'), tail());
      case 8:
        return add("RND R{}", 1 + pick(3));
      case 9:
        return add("L {}", 1 + pick(3));
      case 10:
        return add("{} {} F80 M", axis('Y'), pick(2) ? "R+" : "R-");
      case 11:
        return add("L Z{} R F MAX M", length());
      case 12: {
        const unsigned function = 1 + pick(3);
        return add("FN {}: Q1 = {} {} {}", function, length(), "+-*"[function - 1], length());
      }
      case 13:
        add("CYCL DEF 7.0 DATUM SHIFT");
        return add("CYCL DEF 7.1 {}", axis('X'));
      case 14:
        add("CYCL DEF 10.0 ROTATION");
        return add("CYCL DEF 10.1 {}ROT{}", pick(2) ? "I" : "", length());
      case 15:
        if (has_label_ || pick(3) != 0) return add("STOP M09");
        has_label_ = true;
        return add("LBL 1");
      case 16:
        if (pick(2)) return add("CALL PGM {}", 8 + pick(2));
        add("CYCL DEF 12.0 PGM CALL");
        add("CYCL DEF 12.1 PGM {}", 8 + pick(2));
        return add("L {} {} {} F {}", axis('X'), axis('Y'), compensation(),
                   pick(2) ? "M99" : "M89");
      default:
        return add("L {} {} {}", axis('X'), axis('Y'), tail());
    }
  }

  std::mt19937 random_;
  std::string text_;
  int number_ = 0;
  bool has_label_ = false;
};

TEST(Tnc155ConversionTrace, OfProgramsMadeAtRandomIsTheSame) {
  int converted = 0;
  for (unsigned seed = 1; seed <= 1500 && !testing::Test::HasFailure(); ++seed) {
    const std::string text = ProgramMaker(seed).make();
    if (!rewrite_program(text)) continue;
    converted += does_the_same(text) ? 1 : 0;
  }
  EXPECT_GE(converted, 300);
}

}  // namespace
}  // namespace dripline::tnc_conversion
