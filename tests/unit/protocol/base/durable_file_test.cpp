#include "protocol/base/durable_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <cerrno>

#include "protocol/base/descriptor.hpp"

namespace dripline {
namespace {

TEST(DurableFile, SaysWhyAWriteFails) {
  const Descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  ASSERT_TRUE(full);
  EXPECT_TRUE(write_all(full.get(), ""));
  EXPECT_FALSE(write_all(full.get(), "text"));
  EXPECT_EQ(errno, ENOSPC);
}

TEST(DurableFile, WritesAllOfIt) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  const Descriptor from(ends[0]);
  const Descriptor to(ends[1]);
  ASSERT_GT(::fcntl(to.get(), F_SETPIPE_SZ, 1024 * 1024), 0);
  EXPECT_TRUE(write_all(to.get(), std::string(100'000, 'x')));
  std::string got(200'000, '\0');
  EXPECT_EQ(::read(from.get(), got.data(), got.size()), 100'000);
}

TEST(DurableFile, KnowsAFolderThatIsNotThere) {
  EXPECT_TRUE(sync_folder("."));
  EXPECT_FALSE(sync_folder("/nowhere"));
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace dripline
