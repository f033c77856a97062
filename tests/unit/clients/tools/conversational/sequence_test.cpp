#include <gtest/gtest.h>

#include "clients/tools/conversational/events.hpp"
#include "clients/tools/conversational/sequence.hpp"
#include "tests/unit/clients/tools/conversational/posted_run.hpp"

namespace dripline::conversational {

namespace {

TEST(ConversationalEntry, ReadsNumbersAndFractions) {  // CEN-244
  EXPECT_EQ(parse_entry("1.75")->value, 1.75);
  EXPECT_EQ(parse_entry("-.5")->value, -0.5);
  EXPECT_EQ(parse_entry(" +3. ")->value, 3);
  EXPECT_EQ(parse_entry("7/8")->value, 0.875);
  EXPECT_EQ(parse_entry("-3/64")->value, -0.046875);
  EXPECT_TRUE(parse_entry("7/8")->is_fraction);
  EXPECT_FALSE(parse_entry(".875")->is_fraction);
}

TEST(ConversationalEntry, RefusesEverythingElseByName) {
  for (const std::string wrong : {"", ".", "-", "1e3", "1,5", "0x4", "inf", "1/2/3", "/4", "4/",
                                  "1.5/2", "--1", "1 2", "123456789012345678901", "1234567890/3"}) {
    const auto read = parse_entry(wrong);
    ASSERT_FALSE(read) << wrong;
    EXPECT_NE(read.error().what.find('"' + wrong), std::string::npos) << read.error().what;
  }
  EXPECT_EQ(parse_entry("3/0").error().what, "\"3/0\" divides by zero");
}

TEST(ConversationalEntry, WritesNumbersAsTheControlDoes) {
  EXPECT_EQ(number_text(0.25), ".25");
  EXPECT_EQ(number_text(-0.0625), "-.0625");
  EXPECT_EQ(number_text(12), "12");
  EXPECT_EQ(number_text(100), "100");
  EXPECT_EQ(number_text(-3.10), "-3.1");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0000001), "0");
  EXPECT_EQ(number_text(1.0 / 13), ".076923");
}

std::string rough(int pattern) {
  return event("rough_turning", "cut_increment = 0.1\nstart_x = 1\nstart_z = 0\npattern = " +
                                    std::to_string(pattern));
}
std::string finish(int pattern) {
  return event("finish_turning", "start_x = 1\nstart_z = 0\npattern = " + std::to_string(pattern));
}
const std::string kEnd = event("end_cycle", "");

std::string error_of(const Events& events) {
  const auto checked = check_sequence(events);
  return checked ? "" : checked.error().what;
}

TEST(ConversationalSequence, BeginsWithASetUpAndEndsOnce) {  // CEN-210
  EXPECT_EQ(error_of({}), "there is no event");
  EXPECT_EQ(error_of({ProgramSetup{}, EndOfProgram{}}), "");
  EXPECT_EQ(error_of({Line{}, EndOfProgram{}}),
            "event 0 (line): event 0 and no other is the program_setup");
  EXPECT_EQ(error_of({ProgramSetup{}, ProgramSetup{}, EndOfProgram{}}),
            "event 1 (program_setup): event 0 and no other is the program_setup");
  EXPECT_EQ(error_of({ProgramSetup{}, Line{}}),
            "event 1 (line): the last event and no other is the end_of_program");
  EXPECT_EQ(error_of({ProgramSetup{}, EndOfProgram{}, EndOfProgram{}}),
            "event 1 (end_of_program): the last event and no other is the end_of_program");
}

TEST(ConversationalSequence, KeepsPatternsApart) {  // CEN-236, CEN-237
  EXPECT_EQ(posted(rough(1) + rough(2)),
            "error: event 2 (rough_turning): pattern 1 has not ended: end_cycle is missing");
  EXPECT_EQ(posted(rough(1)),
            "error: event 2 (end_of_program): pattern 1 has not ended: end_cycle is missing");
  EXPECT_EQ(posted(rough(1) + finish(1)),
            "error: event 2 (finish_turning): pattern 1 has not ended: end_cycle is missing");
  EXPECT_EQ(posted(kEnd), "error: event 1 (end_cycle): no pattern has begun");
  EXPECT_EQ(posted(rough(3) + kEnd + rough(3)),
            "error: event 3 (rough_turning): there is a pattern 3 already");
  EXPECT_EQ(posted(rough(3) + kEnd + finish(4)),
            "error: event 3 (finish_turning): pattern = 4: no such pattern before it");
  EXPECT_EQ(posted(rough(3) + kEnd + rough(4) + kEnd + finish(3)).substr(0, 6), "G0 Z0 ");
}

}  // namespace

}  // namespace dripline::conversational
