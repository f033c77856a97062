#include "tests/support/postgresql/test_cluster.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>

namespace dripline::test {
namespace {

constexpr int kNotInstalled = 77;  // cluster.sh

int run_script(const std::string& name, const std::string& arguments) {
  const int status =
      ::system(fmt::format("tests/support/postgresql/{} {}", name, arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::unique_ptr<TestCluster> TestCluster::make() {
  static std::atomic<int> made = 0;
  const std::string folder = fmt::format("/tmp/dripline-cluster-{}-{}", ::getpid(), ++made);
  const int status = run_script("cluster.sh", fmt::format("{} {}", folder, ::getpid()));
  if (status == kNotInstalled) return nullptr;
  EXPECT_EQ(status, 0) << "cluster.sh " << folder;
  return std::unique_ptr<TestCluster>(new TestCluster(folder));
}

/// The server ends with this process (cluster.sh).
TestCluster::~TestCluster() {
  if (is_frozen_) thaw();
}

std::string TestCluster::url() const {
  return fmt::format("postgresql://dripline@/dripline?host={}", folder_);
}

void TestCluster::freeze() {
  control("freeze");
  is_frozen_ = true;
}

void TestCluster::thaw() {
  control("thaw");
  is_frozen_ = false;
}

void TestCluster::control(const std::string& what) const {
  EXPECT_EQ(run_script("cluster_control.sh", folder_ + " " + what), 0) << what;
}

}  // namespace dripline::test
