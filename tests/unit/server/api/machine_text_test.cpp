#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "server/api/views.hpp"

namespace dripline::api {
namespace {

machines::MachineView a_view() {
  machines::MachineView view;
  view.machine.name = "mill-7";
  view.machine.control = "fanuc";
  view.status.emplace();
  view.status.edit().machine = "mill-7";
  view.status.edit().axes = 0b101;
  return view;
}

TEST(MachineText, EscapesWhatJsonCannotHold) {
  auto view = a_view();
  view.machine.description = "a \"mill\" \\ of\nD\xC3\xBCsen\x01";
  view.status.edit().message = "cut \xFF off \xE2\x82";
  const auto json = machine_json(view);
  EXPECT_EQ(json["description"], view.machine.description);
  EXPECT_EQ(json["status"]["message"], "cut \xEF\xBF\xBD off \xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(machine_text(view).find('\n'), std::string::npos) << "an event is one line";
}

TEST(MachineText, KeepsEveryNumberWhole) {
  auto view = a_view();
  view.status.edit().position = {0.1 + 0.2, 7, -1e-7};
  view.status.edit().feed_mm_per_min = 1e300;
  view.status.edit().executed = std::numeric_limits<std::uint64_t>::max();
  const auto status = machine_json(view)["status"];
  EXPECT_EQ(status["position"].size(), 2U) << "of the axes that it has";
  EXPECT_EQ(status["position"]["X"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(status["position"]["Z"].get<double>(), -1e-7);
  EXPECT_EQ(status["feed_mm_per_min"].get<double>(), 1e300);
  EXPECT_TRUE(status["rapid_override"].is_number_float()) << "also 1";
  EXPECT_TRUE(status["outbox"].is_number_integer());
  EXPECT_EQ(status["executed"].get<std::uint64_t>(), std::numeric_limits<std::uint64_t>::max());
}

TEST(MachineText, HasNullForWhatIsNoNumber) {
  auto view = a_view();
  view.status.edit().spindle_rpm = std::numeric_limits<double>::quiet_NaN();
  view.status.edit().feed_mm_per_min = -std::numeric_limits<double>::infinity();
  const auto status = machine_json(view)["status"];
  EXPECT_TRUE(status["spindle_rpm"].is_null());
  EXPECT_TRUE(status["feed_mm_per_min"].is_null());
}

TEST(MachineText, SaysThatTheStatusDoesNotArrive) {
  auto view = a_view();
  view.is_connected = true;
  EXPECT_EQ(machine_json(view)["stale"], false);
  view.is_stale = true;
  view.status_taken = UtcTime{std::chrono::seconds(1'600'000'000)};
  const auto json = machine_json(view);
  EXPECT_EQ(json["stale"], true);
  EXPECT_NE(
      json["notices"][0].get<std::string>().find("no status of it has arrived since 2020-09-13"),
      std::string::npos)
      << json["notices"];
}

TEST(MachineText, HasNullForWhatIsAbsent) {
  machines::MachineView view;
  view.machine.name = "mill-7";
  const auto json = machine_json(view);
  for (const char* member :
       {"control", "description", "clock_ahead_seconds", "held", "queue_hold", "display", "status"})
    EXPECT_TRUE(json.at(member).is_null()) << member;
  EXPECT_TRUE(json["notices"].is_array() && json["notices"].empty());
}

}  // namespace
}  // namespace dripline::api
