// MDI of each control at its gateway: what is keyed in moves the axes, in the control's own words.
#include <gtest/gtest.h>
#include <fstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

/// Keyed in after one another; `position` in mm and as machine axes afterwards.
struct Step {
  const char* text;
  const char* axis;
  double position;
};
struct MdiCase {
  const char* control;
  std::vector<Step> steps;
  const char* setup = "";
};
std::ostream& operator<<(std::ostream& out, const MdiCase& one) {
  return out << one.control;
}

class MdiOfControl : public testing::TestWithParam<MdiCase> {
 protected:
  void SetUp() override {
    std::vector<std::string> arguments;
    if (*GetParam().setup != '\0') {
      const std::string file = folder_.path() / "setup.toml";
      std::ofstream(file) << GetParam().setup;
      arguments = {"--setup", file};
    }
    system_.emplace(System::Options{.speed = "max",
                                    .server_arguments = {},
                                    .gateway_arguments = std::move(arguments),
                                    .control = GetParam().control});
    system_->start_server();
    system_->start_gateway("m-1");
    system_->wait_connected("m-1");
  }
  json mdi(const std::string& text) {
    const auto reply = system_->rest().post("/api/v1/machines/m-1/mdi", {{"text", text}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.status == 201 ? system_->wait_ended(reply.json().value("id", "")) : json();
  }
  json status() { return system_->rest().get("/api/v1/machines/m-1").json()["status"]; }

  test_support::TemporaryFolder folder_;
  std::optional<System> system_;
};

TEST_P(MdiOfControl, MovesTheAxesOneTextAfterTheOther) {
  for (const Step& step : GetParam().steps) {
    const json run = mdi(step.text);
    ASSERT_TRUE(run.is_object());
    EXPECT_EQ(run.value("state", ""), "completed") << step.text << ": " << run.dump();
    json now;
    EXPECT_TRUE(eventually([&] {
      now = status();
      return now.is_object() && now["run"].is_null() &&
             std::abs(now["position"].value(step.axis, -1e9) - step.position) < 1e-6;
    })) << step.text
        << ": " << now.dump();
  }
}

const MdiCase kCases[] = {
    {.control = "centurion",
     .steps = {{"G21 G98 G1 X20 F500", "X", 10}, {"Z-3", "Z", -3}, {"G91 Z1", "Z", -2}}},
    {.control = "fanuc",
     .steps = {{"G21 G1 X10. F500", "X", 10}, {"G91 X1.", "X", 11}, {"X1.", "X", 12}}},
    {.control = "fanuc-t",
     .steps = {{"G21 G98 G1 X10. F500", "X", 5}, {"U2.", "X", 6}, {"T0101", "X", 6}}},
    {.control = "rs274ngc",
     .steps = {{"G21 G1 X10 F500", "X", 10}, {"T1 M6", "X", 10}, {"G91 X1", "X", 11}}},
    {.control = "tektronix-1704",
     .steps = {{"G01X+01000Y+00000F100", "X", 2.54}, {"G91X+00500", "X", 3.81}}},
    // TOOL CALL from the store, then along the tool's axis: its length is taken in.
    {.control = "tnc155",
     .steps = {{"X+12,5 R0 F MAX M", "X", 12.5},
               {"IX+1 R0 F1000 M03", "X", 13.5},
               {"TOOL CALL 1 Z S1000", "X", 13.5},
               {"Z+5 R0 F100 M", "Z", 5}},
     .setup = "[[tool]]\nnumber = 1\nlength = 20.0\nradius = 5.0\n"},
    // The shift of a text is in force in the next one.
    {.control = "itnc",
     .steps = {{"L X+12.5 Y+1 R0 FMAX M3", "X", 12.5},
               {"CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nL X+5 R0 F1000", "X", 15},
               {"L IX+1", "X", 16},
               {"TOOL CALL 1 Z S1000\nL Z+5 R0 FMAX", "Z", 5},
               {"L X+1 FMAX", "X", 11}},
     .setup = "[[tool]]\nnumber = 1\nlength = 20.0\nradius = 5.0\n"},
};
INSTANTIATE_TEST_SUITE_P(, MdiOfControl, testing::ValuesIn(kCases), [](const auto& i) {
  std::string name = i.param.control;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dripline::integration
