#include <gtest/gtest.h>

#include "tests/unit/clients/tools/conversational/posted_run.hpp"

namespace dripline::conversational {
namespace {

std::string whole_program(const std::string& file) {
  const auto events = read_events(file);
  if (!events) return "error: " + events.error().what;
  const auto text = post(*events);
  return text ? *text : "error: " + text.error().what;
}

TEST(PostTools, BeginsWithTheSetUpAndEndsAsProgrammed) {  // CEN-232, CEN-243
  EXPECT_EQ(whole_program(event("program_setup",
                                "program = 512\nname = \"SHAFT 7\"\ndimensions = \"INCREMENTAL\"\n"
                                "units = \"metric\"\nmaterial_length = 80\n"
                                "material_diameter = 32.5") +
                          event("end_of_program", "x = 0\nz = -12.5")),
            "O0512 (SHAFT 7)\nG21 G91\nP156 = 80\nP157 = 32.5\nM5\nM9\nG53 G0 X0 Z-12.5\n");
  EXPECT_EQ(whole_program(event("program_setup", "program = 9999") +
                          event("end_of_program", "coolant_off = \"no\"")),
            "O9999\nG20 G93\nM5\n");
}

TEST(PostTools, ChangesTools) {  // CEN-242
  EXPECT_EQ(posted(event("tool_change",
                         "tool = 9\ndescription = \"GROOVER\"\nfeed = 0.008\n"
                         "maximum_speed = 1800\nspeed = 420\nrestart = \"cw\"\n"
                         "coolant = \"on\"")),
            "G40 G501 G550 G569 G80 M5 M9\nP268 = 9\nM6 (GROOVER)\nT0909\nG99 F.008\nG50 S1800\n"
            "G96 S420\nM3\nM8\n");
  EXPECT_EQ(posted(event("tool_change",
                         "tool = 24\nfeed_per = \"minute\"\nspindle = \"rpm\"\n"
                         "speed = 900\nrestart = \"ccw\"")),
            "G40 G501 G550 G569 G80 M5 M9\nP268 = 24\nM6\nT2424\nG98\nG97 S900\nM4\n");
}

TEST(PostTools, CallsToolsWithoutAChange) {  // CEN-242
  EXPECT_EQ(posted(event("tool_call", "tool = 3\nfeed = 0.02\nspeed = 300")),
            "T0303\nG99 F.02\nG96 S300\n");
}

TEST(PostTools, PostsEachMiscellaneousChoice) {  // CEN-243
  EXPECT_EQ(posted(event("miscellaneous",
                         "feed_per = \"minute\"\nfeed = 12\nspindle_mode = \"rpm\"\nspeed = 1200\n"
                         "gear = \"high\"\nspindle = \"ccw\"\ncoolant = \"on\"\n"
                         "compensation = \"off\"\nstop = \"optional\"\nretract = \"x-z clear\"\n"
                         "cutting_mode = \"exact stop\"\nprogram_mode = \"incremental\"\n"
                         "work_coordinate = 3\noption = \"parts catcher in\"\n"
                         "text = \"P20 = 4 (COUNT)\"")),
            "G98 F12\nG97 S1200\nM43\nM4\nM8\nG40\nM1\nG46 G45\nG61\nG91\nG56\nM26\n"
            "P20 = 4 (COUNT)\n");
  EXPECT_EQ(posted(event("miscellaneous", "retract = \"z-x home\"\noption = \"accessory 5\"")),
            "G47 G48\nM35\n");
  EXPECT_EQ(posted(event("miscellaneous", "")), "");
}

TEST(PostTools, LimitsTheSpeedBeforeConstantSurfaceSpeed) {  // CEN-243
  EXPECT_EQ(posted(event("miscellaneous",
                         "spindle_mode = \"surface speed\"\nmaximum_speed = 1800\nspeed = 420")),
            "G50 S1800\nG96 S420\n");
}

TEST(PostTools, CallsPrograms) {  // CEN-243
  EXPECT_EQ(posted(event("program_call", "program = 250\nrepeats = 4")), "CALL 250 L4\n");
  EXPECT_EQ(posted(event("program_call", "program = 3")), "CALL 3\n");
}

TEST(PostTools, PostsTheSpecials) {  // CEN-243
  EXPECT_EQ(posted(event("scaling", "i = 1\nk = -1\nx = 0.5\nz = 2") +
                   event("scaling", "state = \"off\"")),
            "G551 I1 K-1 X.5 Z2\nG550\n");
  EXPECT_EQ(
      posted(event("rotation", "x = 2\nz = 0\naa = -15") + event("rotation", "state = \"off\"")),
      "G568 X2 Z0 AA-15\nG569\n");
  EXPECT_EQ(posted(event("mirror", "z = -3") + event("mirror", "state = \"off\"")),
            "G511 Z-3\nG501\n");
  EXPECT_EQ(posted(event("floating_zero", "x = 0\nz = 4.5")), "G50 X0 Z4.5\n");
}

}  // namespace
}  // namespace dripline::conversational
