#include "clients/tools/comparison/sequence_diff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>

namespace dripline::comparison {
namespace {

using Sequence = std::vector<std::uint32_t>;

/// `first` with every run replaced by that of `second`; empty where the runs do not fit.
Sequence apply(const Sequence& first, const Sequence& second, const std::vector<EditRun>& runs) {
  Sequence made;
  std::size_t at = 0;
  for (const EditRun& run : runs) {
    if (run.first < at || run.first + run.first_count > first.size()) return {};
    made.insert(made.end(), first.begin() + static_cast<std::ptrdiff_t>(at),
                first.begin() + static_cast<std::ptrdiff_t>(run.first));
    if (made.size() != run.second) return {};
    const auto begin = second.begin() + static_cast<std::ptrdiff_t>(run.second);
    made.insert(made.end(), begin, begin + static_cast<std::ptrdiff_t>(run.second_count));
    at = run.first + run.first_count;
  }
  made.insert(made.end(), first.begin() + static_cast<std::ptrdiff_t>(at), first.end());
  return made;
}

std::size_t edits_of(const std::vector<EditRun>& runs) {
  std::size_t edits = 0;
  for (const EditRun& run : runs) edits += run.first_count + run.second_count;
  return edits;
}

std::size_t shortest(const Sequence& a, const Sequence& b) {
  std::vector<std::size_t> common(b.size() + 1, 0);
  for (const std::uint32_t x : a) {
    std::size_t diagonal = 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = common[j + 1];
      common[j + 1] = x == b[j] ? diagonal + 1 : std::max(common[j], above);
      diagonal = above;
    }
  }
  return a.size() + b.size() - 2 * common.back();
}

Sequence random_sequence(std::size_t size, std::uint32_t values) {
  return *rc::gen::container<Sequence>(size, rc::gen::inRange<std::uint32_t>(0, values));
}

RC_GTEST_PROP(SequenceDiff, ItsRunsTurnTheFirstIntoTheSecondByTheFewestEdits, ()) {
  const auto values = *rc::gen::inRange<std::uint32_t>(1, 8);
  const Sequence a = random_sequence(*rc::gen::inRange<std::size_t>(0, 60), values);
  const Sequence b = random_sequence(*rc::gen::inRange<std::size_t>(0, 60), values);
  const auto runs = diff_sequences(a, b);
  RC_ASSERT(apply(a, b, runs) == b);
  RC_ASSERT(edits_of(runs) == shortest(a, b));
}

TEST(SequenceDiff, SequencesThatHaveLittleInCommonAreDoneInBoundedTimeAndStillFit) {
  Sequence a, b;
  for (std::uint32_t i = 0; i < 60'000; ++i) {
    a.push_back(i * 2654435761u % 1000);
    b.push_back(i * 40503u % 997);
  }
  EXPECT_EQ(apply(a, b, diff_sequences(a, b)), b);
}

TEST(SequenceDiff, EqualSequencesHaveNoRuns) {
  EXPECT_TRUE(diff_sequences(Sequence{1, 2, 3}, Sequence{1, 2, 3}).empty());
}

TEST(SequenceDiff, OneElementPutInIsOneRun) {
  const std::vector<EditRun> expected{{1, 0, 1, 1}};
  EXPECT_EQ(diff_sequences(Sequence{1, 2}, Sequence{1, 9, 2}), expected);
}

}  // namespace
}  // namespace dripline::comparison
