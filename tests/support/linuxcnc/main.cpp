// The main program of tests with a real LinuxCNC: it starts itself again in namespaces of its own.
// LinuxCNC's shared memory has fixed keys, and its start script kills processes by name.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

constexpr const char* kVariable = "DRIPLINE_NAMESPACES";  // empty: they are there

bool may_unshare() {
  const pid_t child = ::fork();
  if (child == 0)
    ::_exit(::unshare(CLONE_NEWIPC | CLONE_NEWNET | CLONE_NEWNS | CLONE_NEWPID) == 0 ? 0 : 1);
  int status = 1;
  (void)::waitpid(child, &status, 0);
  return status == 0;
}

void start_again(char** arguments) {
  std::vector<const char*> words{"/usr/bin/unshare",
                                 "-n",
                                 "-i",
                                 "-m",
                                 "-p",
                                 "-f",
                                 "--mount-proc",
                                 "--kill-child",
                                 "/bin/sh",
                                 "-c",
                                 R"(PATH=$PATH:/usr/sbin:/sbin; ip link set lo up; "$@"; exit $?)",
                                 "sh"};
  for (; *arguments != nullptr; ++arguments) words.push_back(*arguments);
  words.push_back(nullptr);
  ::setenv(kVariable, "", 1);
  ::execv(words.front(), const_cast<char**>(words.data()));
  ::setenv(kVariable, "unshare cannot be started", 1);
}

}  // namespace

int main(int count, char** arguments) {
  bool lists = false;
  for (int i = 1; i < count; ++i) lists |= std::strcmp(arguments[i], "--gtest_list_tests") == 0;
  if (!lists && std::getenv(kVariable) == nullptr) {
    if (may_unshare())
      start_again(arguments);
    else
      ::setenv(kVariable, "namespaces of its own are not permitted here", 1);
  }
  testing::InitGoogleTest(&count, arguments);
  return RUN_ALL_TESTS();
}
