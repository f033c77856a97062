#include "server/api/impl/connection_table.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace dripline::api {
namespace {

using State = ConnectionTable::State;

ConnectionTable table() {
  return ConnectionTable(
      {.connections = 4, .per_address = 3, .reserve = 2, .streams = 2, .streams_per_address = 1});
}

TEST(ConnectionTable, ANewcomerTakesTheSeatOfTheLongestSilent) {
  auto seats = table();
  const auto first = seats.admit("a");
  const auto second = seats.admit("a");
  seats.admit("b");
  seats.admit("b");
  seats.set(first.id, State::Busy);
  const auto newcomer = seats.admit("c");
  EXPECT_EQ(newcomer.evicted, second.id);
  EXPECT_FALSE(newcomer.is_reserve);
  EXPECT_EQ(seats.size(), 4u);
}

TEST(ConnectionTable, AnAddressThatHasAllItMayHaveMakesRoomItself) {
  auto seats = table();
  const auto other = seats.admit("b");
  const auto first = seats.admit("a");
  seats.admit("a");
  seats.admit("a");
  EXPECT_EQ(seats.admit("a").evicted, first.id);
  seats.leave(other.id);
}

TEST(ConnectionTable, WhoSentARequestBeforeGoesAfterWhoSentNone) {
  auto seats = table();
  const auto idle = seats.admit("a");
  seats.set(idle.id, State::Busy);
  seats.set(idle.id, State::Idle);
  const auto silent = seats.admit("a");
  seats.admit("b");
  seats.admit("b");
  EXPECT_EQ(seats.admit("c").evicted, silent.id);
}

TEST(ConnectionTable, WhenAllAreBusyOnlyTheReserveIsLeft) {
  auto seats = table();
  for (const char* address : {"a", "a", "b", "b"}) {
    seats.set(seats.admit(address).id, State::Busy);
  }
  const auto fifth = seats.admit("c");
  EXPECT_TRUE(fifth.is_reserve);
  EXPECT_FALSE(fifth.evicted);
  EXPECT_FALSE(seats.begin_stream(fifth.id));
  seats.admit("c");
  const auto seventh = seats.admit("c");
  EXPECT_TRUE(seventh.is_reserve);
  EXPECT_EQ(seventh.evicted, fifth.id);
  EXPECT_EQ(seats.size(), 6u);
}

TEST(ConnectionTable, AReserveSeatIsKeptWhileARequestIsInProgressAndSomeAreLeft) {
  ConnectionTable seats({.connections = 1, .per_address = 1, .reserve = 4});
  EXPECT_TRUE(seats.begin_request(seats.admit("a").id, true));
  std::vector<ConnectionTable::Id> stops;
  for (int i = 0; i < 3; ++i) {
    stops.push_back(seats.admit("b").id);
    EXPECT_TRUE(seats.begin_request(stops.back(), true));
  }
  const auto fourth = seats.admit("b");
  EXPECT_TRUE(fourth.is_reserve);
  EXPECT_FALSE(seats.begin_request(fourth.id, true)) << "the last is for health";
  const auto health = seats.admit("b");
  EXPECT_EQ(health.evicted, fourth.id);
  EXPECT_FALSE(seats.begin_request(fourth.id, true)) << "it was evicted";
  seats.leave(stops.front());
  EXPECT_TRUE(seats.begin_request(seats.admit("b").id, true));
  EXPECT_EQ(seats.size(), 5u);
}

TEST(ConnectionTable, StreamsAreFewerThanConnections) {
  auto seats = table();
  const auto a = seats.admit("a"), a2 = seats.admit("a"), b = seats.admit("b"),
             c = seats.admit("c");
  EXPECT_TRUE(seats.begin_stream(a.id));
  EXPECT_FALSE(seats.begin_stream(a2.id)) << "one for each address";
  EXPECT_TRUE(seats.begin_stream(b.id));
  EXPECT_FALSE(seats.begin_stream(c.id)) << "two for all";
  seats.leave(a.id);
  EXPECT_TRUE(seats.begin_stream(c.id));
}

TEST(ConnectionTable, WhoLeavesGivesEverythingBackOnce) {
  auto seats = table();
  for (int round = 0; round < 1000; ++round) {
    Seat seat(seats, seats.admit("a").id);
    EXPECT_TRUE(seat.begin_stream());
    seats.leave(seat.id());
  }
  EXPECT_EQ(seats.size(), 0u);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(seats.admit("a").evicted);
}

TEST(ConnectionTable, SomebodySilentGoesWhenDescriptorsRunOut) {
  auto seats = table();
  const auto busy = seats.admit("a"), silent = seats.admit("b");
  seats.set(busy.id, State::Busy);
  EXPECT_EQ(seats.evict_any(), silent.id);
  EXPECT_EQ(seats.evict_any(), std::nullopt);
}

}  // namespace
}  // namespace dripline::api
