/* Preloaded into a program under test: while the file DRIPLINE_TEST_HANG names is there, a file is not moved, and the
 * thread that moves it waits, as on a share of a network that does not answer. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

int renameat2(int from, const char* name, int to, const char* target, unsigned int flags) {
  const char* hang = getenv("DRIPLINE_TEST_HANG");
  while (hang != NULL && access(hang, F_OK) == 0) usleep(20000);
  return (int)syscall(SYS_renameat2, from, name, to, target, flags);
}
