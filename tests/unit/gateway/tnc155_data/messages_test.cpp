#include <gtest/gtest.h>

#include <set>

#include "gateway/interpreter/tnc155/messages.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

ErrorCode code_of(std::string_view text) {
  const auto found = recognise_message(text);
  return found ? found->message->code : ErrorCode::None;
}

// HD-236: the messages of the manual's list, word for word.
TEST(Tnc155Messages, AreAllThere) {
  for (const char* text : {
           "ANGLE REFERENCE MISSING",
           "BLK FORM DEFINITION INCORRECT",
           "BLOCK FORMAT INCORRECT",
           "CIRCLE END POS. INCORRECT",
           "CYCL INCOMPLETE",
           "EMERGENCY STOP",
           "EXCESSIVE SUBPROGRAMMING",
           "EXCHANGE BUFFER BATTERY",
           "EXCHANGE TOUCH PROBE BATTERY",
           "EXCHANGE CASSETTE - ME START",
           "G-CODE GROUP ALREADY ASSIGNED",
           "ILLEGAL G-CODE",
           "JUMP TO LABEL 0 NOT PERMITTED",
           "ME: PROGRAM INCOMPLETE",
           "MIRROR IMAGE ON TOOL AXIS",
           "NUMBER ALREADY ALLOCATED",
           "PATH OFFSET WRONGLY STARTED",
           "PGM ? UNAVAILABLE",
           "PGM-SECTION CANNOT BE SHOWN",
           "PLANE WRONGLY DEFINED",
           "POWER INTERRUPTED",
           "PROBE SYSTEM NOT READY",
           "PROGRAM MEMORY EXCEEDED",
           "PROGRAM START UNDEFINED",
           "RELAY EXT. DC VOLTAGE MISSING",
           "ROUNDING RADIUS TOO LARGE",
           "SELECTED BLOCK NOT ADDRESSED",
           "SPINDLE ROTATES MISSING",
           "TOOL CALL MISSING",
           "TOOL RADIUS TOO LARGE",
           "TOUCH POINT INACCESSIBLE",
           "WRONG AXIS PROGRAMMED",
           "WRONG RPM",
       }) {
    const auto found = recognise_message(text);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(found->message->text, text);
    EXPECT_TRUE(found->message->is_error) << text;
  }
}

// HD-237: what it says while it works is no error.
TEST(Tnc155Messages, OfWhatTheControlDoesAreNoErrors) {
  for (const char* text : {"MEMORY TEST", "TRANSFER BLOCKWISE", "EXTERNAL DATA INPUT",
                           "EXTERNAL DATA OUTPUT", "TRANSFER GRAPHICS DETAIL", "BLOCK COMPLETE",
                           "MACHINE PARAMETER PROGRAMMING", "CAUTION: SOFTWARE LIMITS INACTIVE",
                           "PASS OVER Z-REFERENCE MARK", "REFERENCE MARK AXIS 4"}) {
    const auto found = recognise_message(text);
    ASSERT_TRUE(found) << text;
    EXPECT_FALSE(found->message->is_error) << text;
  }
  for (const char* text : {"OPERATION PARAMETERS ERASED", "NC: PROGRAM MEMORY ERASED"}) {
    ASSERT_TRUE(recognise_message(text)) << text;
  }
}

// HD-236: as they come: with numbers, blanks, a detail, the index's spelling.
TEST(Tnc155Messages, AreRecognisedAsTheyCome) {
  EXPECT_EQ(code_of("PGM 4711 UNAVAILABLE"), ErrorCode::ProgramUnavailable);
  EXPECT_EQ(recognise_message("PGM 4711 UNAVAILABLE")->argument, "4711");
  EXPECT_EQ(recognise_message("PASS OVER Z- REFERENCE MARK")->argument, "Z");
  EXPECT_EQ(recognise_message("LIMIT SWITCH X+")->argument, "X+");
  EXPECT_EQ(code_of("  WRONG  RPM \r\n"), ErrorCode::WrongRpm);
  EXPECT_EQ(code_of("WRONG RPM: S 40000 is not 0 to 30000"), ErrorCode::WrongRpm);
  EXPECT_EQ(code_of("ROUNDING RADIUS TOOL LARGE"), ErrorCode::RoundingRadiusTooLarge);
  EXPECT_EQ(code_of("CYCLE INCOMPLETE"), ErrorCode::CycleIncomplete);
  EXPECT_EQ(code_of("CIRCUIT END POS. INCORRECT"), ErrorCode::CircleEndIncorrect);
  EXPECT_FALSE(recognise_message("WRONG"));
  EXPECT_FALSE(recognise_message("WRONG RPMX"));
  EXPECT_FALSE(recognise_message(""));
}

// HD-236: what our runs raise in the control's words is in the list once.
TEST(Tnc155Messages, StandInTheListOnce) {
  std::set<std::string_view> texts;
  for (const ControlMessage& message : control_messages()) {
    EXPECT_TRUE(texts.insert(message.text).second) << message.text;
    if (message.code == ErrorCode::None || message.text.find('?') != std::string_view::npos)
      continue;
    EXPECT_EQ(error_row(message.code).text, message.text);
  }
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
