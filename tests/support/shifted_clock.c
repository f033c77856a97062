/* Preloaded into a program under test: its time of day is DRIPLINE_TEST_SHIFT seconds off. Its steady clock is right.
 * The kernel does not know of it, so waits until a time of day are shifted back. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

static long shift(void) {
  const char* text = getenv("DRIPLINE_TEST_SHIFT");
  return text == NULL ? 0 : atol(text);
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  static int (*real)(clockid_t, struct timespec*);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "clock_gettime");
  const int result = real(clock, time);
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += shift();
  return result;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const struct timespec* until) {
  static int (*real)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  struct timespec time = *until;
  const long beginning_of_2001 = 978307200; /* a steady clock shows less */
  if (time.tv_sec > beginning_of_2001) time.tv_sec -= shift();
  return real(condition, mutex, &time);
}
