#include "server/mtconnect/observation_buffer.hpp"

#include <gtest/gtest.h>

namespace dripline::mtconnect {
namespace {

NewObservation value(std::uint32_t item, std::string text) {
  return {item, UtcTime{}, std::move(text), std::nullopt};
}
NewObservation state(Level level, std::string code = "") {
  ConditionState made;
  made.level = level;
  made.native_code = std::move(code);
  return {0, UtcTime{}, std::nullopt, std::move(made)};
}
void add(ObservationBuffer& buffer, const NewObservation& made) {
  buffer.add({&made, 1});
}
/// Values 1, 2, 3 ... of items 0 and 1 in turn.
void fill(ObservationBuffer& buffer, unsigned count) {
  for (unsigned i = 1; i <= count; ++i) add(buffer, value(i % 2, std::to_string(i)));
}
std::vector<std::uint64_t> numbers(const ObservationBuffer::Answer& answer) {
  std::vector<std::uint64_t> numbers;
  for (const auto& observation : answer.observations) numbers.push_back(observation->sequence);
  return numbers;
}
std::vector<std::string> codes(const ObservationBuffer& buffer) {
  std::vector<std::string> codes;
  const auto state = buffer.latest();
  for (const auto& active : state.latest.at(0)->active) codes.push_back(active->native_code);
  return codes;
}
using Numbers = std::vector<std::uint64_t>;
using Codes = std::vector<std::string>;

TEST(ObservationBuffer, NumbersFromOneWithoutGaps) {
  ObservationBuffer buffer(8);
  fill(buffer, 3);
  const auto answer = buffer.sample({}).value();
  EXPECT_EQ(numbers(answer), (Numbers{1, 2, 3}));
  EXPECT_EQ(answer.next, 4U);
}

TEST(ObservationBuffer, LeavesOutWhatChangesNothing) {
  ObservationBuffer buffer(8);
  add(buffer, value(0, "a"));
  add(buffer, value(0, "a"));
  EXPECT_EQ(buffer.next(), 2U);
  auto again = value(0, "a");
  again.is_discrete = true;
  add(buffer, again);
  EXPECT_EQ(buffer.next(), 3U);
  add(buffer, {0, UtcTime{}, std::nullopt, std::nullopt});
  EXPECT_EQ(buffer.next(), 4U) << "unavailable is a value";
}

TEST(ObservationBuffer, KeepsTheLastAsManyAsItHasRoomFor) {
  ObservationBuffer buffer(4);
  fill(buffer, 10);
  const auto range = buffer.range();
  EXPECT_EQ(range.first, 7U);
  EXPECT_EQ(range.next, 11U);
  EXPECT_FALSE(buffer.sample({.from = 6}));
  EXPECT_TRUE(buffer.sample({.from = 7}));
  EXPECT_TRUE(buffer.sample({.from = 11})->observations.empty());
  EXPECT_FALSE(buffer.sample({.from = 12}));
}

TEST(ObservationBuffer, ContinuesWhereAnAnswerEnded) {
  ObservationBuffer buffer(64);
  fill(buffer, 50);
  Numbers all;
  std::uint64_t from = 1;
  while (from < buffer.next()) {
    const auto answer = buffer.sample({.from = from, .count = 7}).value();
    for (const auto number : numbers(answer)) all.push_back(number);
    from = answer.next;
  }
  ASSERT_EQ(all.size(), 50U);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i + 1);
}

TEST(ObservationBuffer, CountsOnlySelectedItems) {
  ObservationBuffer buffer(64);
  fill(buffer, 20);
  ItemSet items;
  items.add(1);
  const auto answer = buffer.sample({.from = 1, .count = 3, .items = &items}).value();
  EXPECT_EQ(numbers(answer), (Numbers{1, 3, 5}));
  EXPECT_EQ(answer.next, 6U);
}

TEST(ObservationBuffer, ANegativeCountGoesBackwardAndAnswersInOrder) {
  ObservationBuffer buffer(64);
  fill(buffer, 20);
  EXPECT_EQ(numbers(buffer.sample({.count = -3}).value()), (Numbers{18, 19, 20}));
  const auto answer = buffer.sample({.from = 10, .count = -2}).value();
  EXPECT_EQ(numbers(answer), (Numbers{9, 10}));
  EXPECT_EQ(answer.next, 8U);
  EXPECT_EQ(numbers(buffer.sample({.from = 2, .count = -9}).value()), (Numbers{1, 2}));
}

TEST(ObservationBuffer, AnswersWhenItIsEmpty) {
  ObservationBuffer buffer(4);
  EXPECT_TRUE(buffer.sample({})->observations.empty());
  EXPECT_TRUE(buffer.sample({.count = -5})->observations.empty());
  EXPECT_FALSE(buffer.at(1));
  EXPECT_TRUE(buffer.latest().latest.empty());
}

/// Against the whole history, at every number that the ring still has.
TEST(ObservationBuffer, KnowsTheStateAtEveryNumberInTheRing) {
  constexpr unsigned kItems = 5;
  ObservationBuffer buffer(16);
  std::vector<std::vector<std::string>> history{std::vector<std::string>(kItems)};
  unsigned random = 1;
  for (unsigned i = 1; i <= 100; ++i) {
    random = random * 1103515245 + 12345;
    const unsigned item = (random >> 16U) % kItems;
    add(buffer, value(item, std::to_string(i)));
    history.push_back(history.back());
    history.back()[item] = std::to_string(i);
  }
  const auto range = buffer.range();
  for (std::uint64_t at = range.first; at < range.next; ++at) {
    const auto state = buffer.at(at).value();
    for (unsigned item = 0; item < kItems; ++item)
      EXPECT_EQ(state.latest.at(item) ? state.latest[item]->value.value() : "", history[at][item]);
  }
  EXPECT_FALSE(buffer.at(range.first - 1));
  EXPECT_FALSE(buffer.at(range.next));
}

TEST(ObservationBuffer, AConditionKeepsItsStatesUntilTheyAreNormal) {
  ObservationBuffer buffer(64);
  add(buffer, state(Level::Unavailable));
  add(buffer, state(Level::Normal));
  add(buffer, state(Level::Fault, "A1"));
  add(buffer, state(Level::Warning, "A2"));
  EXPECT_EQ(codes(buffer), (Codes{"A1", "A2"}));
  add(buffer, state(Level::Normal, "A1"));
  EXPECT_EQ(codes(buffer), (Codes{"A2"}));
  add(buffer, state(Level::Fault, "A2"));
  EXPECT_EQ(codes(buffer), (Codes{"A2"})) << "one state for each code";
  add(buffer, state(Level::Normal));
  EXPECT_EQ(codes(buffer), (Codes{""}));
  const auto before = buffer.next();
  add(buffer, state(Level::Normal));
  EXPECT_EQ(buffer.next(), before) << "normal already";
}

TEST(ObservationBuffer, AConditionHasABoundedNumberOfStates) {
  ObservationBuffer buffer(64);
  for (int i = 0; i < 100; ++i) add(buffer, state(Level::Fault, "A" + std::to_string(i)));
  const auto active = codes(buffer);
  EXPECT_EQ(active.size(), ObservationBuffer::kMaxActive);
  EXPECT_EQ(active.back(), "A99");
}

}  // namespace
}  // namespace dripline::mtconnect
