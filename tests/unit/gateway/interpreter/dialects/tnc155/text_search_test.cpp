#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dripline::interpreter::tnc155 {
namespace {

/// Gives never more than it is asked for, or `window` bytes.
class WindowedSource final : public ProgramSource {
 public:
  WindowedSource(std::string_view text, std::size_t window) : text_(text), window_(window) {}
  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    const std::size_t size = std::max(window_, min_bytes);
    shown_ = std::string(text_.substr(std::min<std::size_t>(offset, text_.size()), size));
    return {TextWindow::State::Ready, shown_, offset + shown_.size() >= text_.size(), {}};
  }
  ProgramLookup find(std::string_view) override {
    return {ProgramLookup::State::NotFound, kMainProgram};
  }

 private:
  std::string_view text_;
  std::size_t window_;
  std::string shown_;
};

/// The text from the place on that a search finds, in all windows; "-" when there is none.
template <class Find>
std::string found_in(const std::string& text, ReaderOptions options, Find find) {
  std::string first;
  for (const std::size_t window : {1u, 2u, 7u, 30u, 1000u}) {
    WindowedSource source(text, window);
    TextSearch search(source, options);
    TextPlace place;
    const auto outcome = find(search, place);
    const std::string found = outcome == TextSearch::Outcome::Found
                                  ? std::to_string(place.line) + ": " + text.substr(place.offset, 8)
                                  : "-";
    if (first.empty()) first = found;
    EXPECT_EQ(found, first) << "in windows of " << window;
  }
  return first;
}

std::string label_in(const std::string& text, std::uint32_t label, ReaderOptions options = {}) {
  return found_in(text, options, [&](TextSearch& search, TextPlace& place) {
    return search.find_label(kMainProgram, label, {}, place);
  });
}

const std::string kSeveralInALine =
    "%1 G71 *\nN10 L5 * N20 M02 *\nN30 X+50 * N40 G98 L5 * N50 Y+9 *\n  N60 G98 L6 X+1 *N70 X+2 "
    "*\nN80 G98 L0 * G98 L7 *\n";

// HD-034, HD-144: blocks end at their `*`, not with their line.
TEST(Tnc155TextSearch, FindsBlocksAfterOthersOfTheirLine) {
  EXPECT_EQ(label_in(kSeveralInALine, 5), "3: N40 G98 ");
  EXPECT_EQ(label_in(kSeveralInALine, 6), "4: N60 G98 ");
  EXPECT_EQ(label_in(kSeveralInALine, 7), "5: G98 L7 *");
  EXPECT_EQ(label_in(kSeveralInALine, 8), "-");
}

// HD-028: whether a line without N continues the block before it is an option.
TEST(Tnc155TextSearch, FollowsTheContinuationOfLines) {
  const std::string text = "%1 G71\nN10 X+1\nG98 L5\nY+9\nN20 X+2\n";
  EXPECT_EQ(label_in(text, 5), "2: N10 X+1\n");
  EXPECT_EQ(label_in(text, 5, {.iso_continuation = false}), "3: G98 L5\nY");
}

// HD-001, HD-018: a `*` of plain language ends nothing, and a block may have several lines.
TEST(Tnc155TextSearch, ReadsBlocksOfPlainLanguage) {
  const std::string text =
      "0 BEGIN PGM 1 MM\n1 FN 3: Q1 = +2 * +3\n2 * X+5\n   R F M\n12 LBL 4\n3 LB L 5\nEND PGM 1 MM";
  EXPECT_EQ(label_in(text, 4), "5: 12 LBL 4");
  EXPECT_EQ(label_in(text, 5), "6: 3 LB L 5");
}

/// Why a label cannot be found, in all windows.
std::string doubled_in(const std::string& text, bool is_itnc) {
  std::string reason;
  found_in(text, {.is_itnc = is_itnc}, [&](TextSearch& search, TextPlace& place) {
    const auto outcome = search.find_label(kMainProgram, 1, {}, place);
    reason = outcome == TextSearch::Outcome::Doubled ? search.doubled() : "";
    return outcome;
  });
  return reason;
}

TEST(Tnc155TextSearch, FindsNoLabelWhereOneIsSetTwice) {
  EXPECT_EQ(doubled_in("0 BEGIN PGM 1 MM\n1 LBL 1\n2 LBL 0\n7 LBL 5\n8 LBL 0\n9 LB L 5\n", false),
            "LBL 5 is set in block 7 (line 4) and in block 9 (line 6)");
  EXPECT_EQ(doubled_in("%1 G71 *\nN1 G98 L1 * N2 X+1 G98 L6 *\nN3 G98 L6 *\n", false),
            "LBL 6 is set in block 2 (line 2) and in block 3 (line 3)");
  EXPECT_EQ(doubled_in("BEGIN PGM A MM\nLBL 1\nLBL \"A;B\" ; \"\nL X+1\nLBL\"A;B\"\n", true),
            "LBL \"A;B\" is set in line 3 and in line 5");
  EXPECT_EQ(doubled_in("BEGIN PGM A MM\nLBL 01\nLBL 1 ; again\n", true),
            "LBL 1 is set in line 2 and in line 3");
}

TEST(Tnc155TextSearch, KeepsNamesApartFromNumbersAndProgramsFromWhatComesAfterThem) {
  EXPECT_EQ(doubled_in("BEGIN PGM A MM\nLBL 1\nLBL \"1\"\n; LBL 1\n* - LBL 1\nCALL LBL 1\n"
                       "END PGM A MM\nLBL 1\n",
                       true),
            "");
}

TEST(Tnc155TextSearch, ChecksTheFirstBlocksAlone) {
  const std::string text = "BEGIN PGM A MM\nLBL 1\nL X+1\nLBL 1\n";
  for (const std::uint64_t blocks : {3u, 4u}) {
    WindowedSource source(text, 7);
    TextSearch search(source, {.is_itnc = true});
    EXPECT_EQ(search.check_labels(kMainProgram, blocks) == TextSearch::Outcome::Doubled,
              blocks == 4)
        << blocks;
  }
}

TEST(Tnc155TextSearch, KeepsABoundedNumberOfNames) {
  std::string text = "BEGIN PGM A MM\nLBL 1\n";
  for (std::size_t i = 0; i < TextSearch::kMaxNames; ++i)
    text += "LBL \"N" + std::to_string(i) + "\"\n";
  WindowedSource source(text, 100'000);
  TextSearch search(source, {.is_itnc = true});
  TextPlace found;
  EXPECT_EQ(search.find_label(kMainProgram, 1, {}, found), TextSearch::Outcome::Found);
  text += "LBL \"ONE MORE\"\n";
  WindowedSource longer(text, 100'000);
  TextSearch refused(longer, {.is_itnc = true});
  EXPECT_EQ(refused.find_label(kMainProgram, 1, {}, found), TextSearch::Outcome::Doubled);
  EXPECT_EQ(refused.doubled(), "more than 10000 labels with names, or 524288 characters in them");
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
