#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "clients/tools/offline/offline_run.hpp"
#include "tests/unit/clients/tools/conversational/posted_run.hpp"

/// The examples of deploy/examples do what they say.
namespace dripline::conversational {
namespace {

std::string text_of(const std::string& name) {
  std::ifstream file("deploy/examples/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Examples, TheCenturionsPagesAreTaken) {  // CEN-214, CEN-215, CEN-216, CEN-219
  const std::string setup = text_of("centurion.toml");
  EXPECT_EQ(moves_of("G0 X2 Z1\nG53 X3 Z-1\n", setup), "rapid X2 Z-9\nrapid X3 Z-1\n");
  EXPECT_NE(moves_of("G0 X20\n", setup).find("alarm CEN0401"), std::string::npos);
  EXPECT_EQ(moves_of("G28 X4\n", setup), "rapid X4 Z0\nrapid X10 Z0\n");
}

TEST(Examples, ThePinIsCut) {  // CEN-210, CEN-232, CEN-236, CEN-237
  const auto events = read_events(text_of("pin.toml"));
  ASSERT_TRUE(events) << events.error().what;
  const auto program = post(*events);
  ASSERT_TRUE(program) << program.error().what;
  const std::string moves = moves_of(*program, text_of("centurion.toml"));
  EXPECT_EQ(moves.find("alarm"), std::string::npos) << moves;
  // The finished shape, the groove, the thread, the hole, and home.
  for (const std::string move : {"line X.625 Z-11", "line X.5 Z-11", "thread X.5135 Z-10.95",
                                 "line X0 Z-10.75", "rapid X0 Z0"}) {
    EXPECT_NE(moves.find(move), std::string::npos) << move << "\n" << moves;
  }
}

}  // namespace
}  // namespace dripline::conversational
