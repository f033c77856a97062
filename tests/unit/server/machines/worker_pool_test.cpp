#include "server/machines/worker_pool.hpp"

#include <gtest/gtest.h>
#include <future>
#include <stdexcept>

#include "tests/support/patience.hpp"

namespace dripline::machines {
namespace {

TEST(WorkerPool, TriesATaskThatThrowsAgain) {
  WorkerPool pool(1);
  std::promise<int> done;
  pool.post([&, tries = 0]() mutable {
    if (++tries == 1) throw std::runtime_error("once");
    done.set_value(tries);
  });
  auto result = done.get_future();
  ASSERT_EQ(result.wait_for(test_support::kPatience), std::future_status::ready);
  EXPECT_EQ(result.get(), 2);
}

TEST(WorkerPool, RunsWhatWaitsBeforeItStops) {
  int ran = 0;
  {
    WorkerPool pool(1);
    for (int i = 0; i < 10; ++i) pool.post([&] { ++ran; });
    pool.post_after(std::chrono::hours(1), [&] { ran = -1; });
  }
  EXPECT_EQ(ran, 10);
}

}  // namespace
}  // namespace dripline::machines
