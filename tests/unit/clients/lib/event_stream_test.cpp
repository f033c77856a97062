#include <gtest/gtest.h>

#include "clients/lib/event_stream.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline::client {

namespace {

std::string joined(const std::vector<ServerEvent>& events) {
  std::string text;
  for (const auto& event : events) text += event.name + "=" + event.data + ";";
  return text;
}

std::string parse_in_pieces(const std::string& text, std::size_t size) {
  EventParser parser;
  std::string all;
  for (std::size_t i = 0; i < text.size(); i += size) {
    auto events = parser.feed(std::string_view(text).substr(i, size));
    if (!events) return "error";
    all += joined(*events);
  }
  return all;
}

TEST(EventParser, GivesTheSameEventsHoweverTheyArrive) {
  const std::string text =
      ": ping\n\nevent: run\ndata: {\"a\":1}\n\nid: 7\r\nevent:machine\r\ndata:x\r\ndata: y\r\n\r\n"
      "data: plain\r\revent: half\ndata: never ended";
  for (std::size_t size = 1; size <= text.size(); ++size) {
    EXPECT_EQ(parse_in_pieces(text, size), "run={\"a\":1};machine=x\ny;message=plain;") << size;
  }
}

TEST(EventParser, DeliversNothingForAnEventWithoutData) {
  EXPECT_EQ(parse_in_pieces("event: run\n\ndata: x\n\n", 5), "message=x;");
}

TEST(EventParser, RefusesAnEndlessEvent) {
  EventParser parser;
  const std::string piece(100'000, 'x');
  bool is_refused = false;
  for (int i = 0; i < 20 && !is_refused; ++i) is_refused = !parser.feed(piece);
  EXPECT_TRUE(is_refused);
}

using namespace std::chrono_literals;
using test_support::FakeServer;

/// The next item of kind T, others skipped; nullopt after ten seconds.
template <class T>
std::optional<T> next_of(EventStream& stream) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (std::chrono::steady_clock::now() < end) {
    auto item = stream.next(100ms);
    if (!item) continue;
    if (auto* wanted = std::get_if<T>(&*item)) return std::move(*wanted);
  }
  return std::nullopt;
}

TEST(EventStream, DeliversRunsAndMachines) {
  FakeServer server;
  EventStream stream({server.url(), FakeServer::kToken, {}}, "");
  ASSERT_TRUE(next_of<StreamOpened>(stream));
  server.publish("unknown", {{"x", 1}});
  server.publish("run", test_support::run_json("r1", "active"));
  const auto run = next_of<client::Run>(stream);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->id, "r1");
  server.publish("machine", test_support::machine_json("lathe-1"));
  const auto machine = next_of<client::Machine>(stream);
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->name, "lathe-1");
}

TEST(EventStream, ConnectsAgainAfterACut) {
  FakeServer server;
  EventStream stream({server.url(), FakeServer::kToken, {}}, "lathe-1");
  ASSERT_TRUE(next_of<StreamOpened>(stream));
  server.cut_events_once();
  const auto lost = next_of<StreamLost>(stream);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->failure.kind, Failure::Kind::Unreachable);
  EXPECT_TRUE(next_of<StreamOpened>(stream));
}

TEST(EventStream, ReportsAWrongToken) {
  FakeServer server;
  EventStream stream({server.url(), "wrong", {}}, "");
  const auto lost = next_of<StreamLost>(stream);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->failure.kind, Failure::Kind::Denied);
}

TEST(EventStream, EndsWhileNothingComes) {
  FakeServer server;
  const auto begun = std::chrono::steady_clock::now();
  { EventStream stream({server.url(), FakeServer::kToken, {}}, ""); }
  {
    EventStream stream({server.url(), FakeServer::kToken, {}}, "");
    EXPECT_TRUE(next_of<StreamOpened>(stream));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 5s);
}

}  // namespace

}  // namespace dripline::client
