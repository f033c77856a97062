#include "clients/lib/event_parser.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dripline::client
