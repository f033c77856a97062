#include "gateway/interpreter/dialects/tnc155/errors.hpp"

#include <gtest/gtest.h>

#include <set>

/// HD-236: what stops a program, in the control's words.
namespace dripline::interpreter::tnc155 {
namespace {

std::set<std::string_view> texts() {
  std::set<std::string_view> texts;
  for (std::size_t i = 1; i < static_cast<std::size_t>(ErrorCode::Count); ++i) {
    texts.insert(error_row(static_cast<ErrorCode>(i)).text);
  }
  return texts;
}

TEST(TncErrors, AreTheControlsWords) {
  const auto ours = texts();
  for (const char* text : {
           "ANGLE REFERENCE MISSING",
           "BLK FORM DEFINITION INCORRECT",
           "BLOCK FORMAT INCORRECT",
           "CIRCLE END POS. INCORRECT",
           "CYCL INCOMPLETE",
           "EXCESSIVE SUBPROGRAMMING",
           "G-CODE GROUP ALREADY ASSIGNED",
           "ILLEGAL G-CODE",
           "JUMP TO LABEL 0 NOT PERMITTED",
           "MIRROR IMAGE ON TOOL AXIS",
           "NUMBER ALREADY ALLOCATED",
           "PATH OFFSET WRONGLY STARTED",
           "PLANE WRONGLY DEFINED",
           "PROGRAM MEMORY EXCEEDED",
           "PROGRAM START UNDEFINED",
           "ROUNDING RADIUS TOO LARGE",
           "SELECTED BLOCK NOT ADDRESSED",
           "SPINDLE ROTATES MISSING",
           "TOOL CALL MISSING",
           "TOOL RADIUS TOO LARGE",
           "TOUCH POINT INACCESSIBLE",
           "WRONG AXIS PROGRAMMED",
           "WRONG RPM",
       }) {
    EXPECT_TRUE(ours.contains(text)) << text;
  }
}

TEST(TncErrors, HaveAnIdAndATextEach) {
  std::set<std::string_view> ids;
  for (std::size_t i = 1; i < static_cast<std::size_t>(ErrorCode::Count); ++i) {
    const DiagnosticRow& row = error_row(static_cast<ErrorCode>(i));
    EXPECT_TRUE(row.id.starts_with("TNC-")) << i;
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_FALSE(row.text.empty()) << row.id;
  }
  EXPECT_EQ(texts().size(), ids.size());
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
