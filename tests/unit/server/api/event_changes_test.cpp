// The event stream with changes=yes, as its readers put it together.
#include <map>
#include <random>
#include <sstream>

#include "server/api/views.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

using Json = nlohmann::json;

class ApiEvents : public ApiTest {};

/// The machines of a stream with changes=yes, as a client has them.
class KnownMachines {
 public:
  explicit KnownMachines(std::shared_ptr<api::EventSubscription> events)
      : events_(std::move(events)) {}

  std::size_t changes = 0;
  std::map<std::string, Json> machines;

  void read() {
    std::istringstream text(events_->take());
    for (std::string event, data, blank; std::getline(text, event);) {
      std::getline(text, data);
      std::getline(text, blank);
      Json read = Json::parse(data.substr(std::string("data: ").size()));
      Json& known = machines[read["name"]];
      if (event == "event: machine") {
        known = read;
        continue;
      }
      ASSERT_EQ(event, "event: change");
      ASSERT_EQ(known["version"], read["after"]);
      read.erase("after");
      join(known, read);
      ++changes;
    }
  }

 private:
  static void join(Json& into, const Json& change) {
    for (const auto& [name, value] : change.items()) {
      const bool are_objects = value.is_object() && into[name].is_object();
      are_objects ? join(into[name], value) : void(into[name] = value);
    }
  }
  std::shared_ptr<api::EventSubscription> events_;
};

dds::Status random_status(std::mt19937& random, const std::string& machine) {
  const auto one_of = [&](unsigned n) { return random() % n == 0; };
  dds::Status status;
  status.machine = machine;
  status.execution = static_cast<dds::Execution>(random() % 9);
  status.message = one_of(3) ? "asks: \"how\" {deep}?" : "";
  status.line = random() % 4;
  status.axes = one_of(9) ? 0b101 : 0b111;
  status.position = {static_cast<double>(random() % 4), 0.1 * static_cast<double>(random() % 4), 2};
  if (!one_of(9)) status.modes.emplace().feed = static_cast<double>(random() % 2);
  if (!one_of(9)) {
    auto& coordinates = status.coordinates.emplace();
    coordinates.target = status.position;
    if (!one_of(5)) coordinates.program.emplace().mirrored = random() % 8;
  }
  return status;
}

TEST_F(ApiEvents, SendChangesThatMakeUpTheWholeState) {
  for (const char* name : {"lathe-1", "lathe-2"}) show_machine(name);
  const auto listener = api::publish_to(events_);
  std::mt19937 random(7);
  KnownMachines known(get("/api/v1/events?changes=yes").events);
  known.read();
  ASSERT_EQ(known.machines.size(), 2U);
  for (int i = 0; i < 500; ++i) {
    auto& view = machines_.views[random() % 2];
    view.is_connected = random() % 20 != 0;
    if (random() % 20 == 0) {
      view.status.reset();
    } else {
      view.status = random_status(random, view.machine.name);
    }
    listener.on_machine(view);
    if (random() % 2 == 0) continue;  // a slow reader
    known.read();
    for (const auto& each : machines_.views) {
      Json machine = known.machines[each.machine.name];
      machine.erase("version");
      ASSERT_EQ(machine, api::machine_json(each)) << i;
    }
  }
  EXPECT_GT(known.changes, 50U);
}

TEST_F(ApiEvents, RefuseAnEventStreamWithWhatIsNeitherYesNorNo) {
  expect_error(get("/api/v1/events?changes=maybe"), 400, "syntax", "changes");
}

}  // namespace
}  // namespace dripline::server_test
