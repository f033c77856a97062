/* Loaded into the peer (LD_PRELOAD): it prints lengths with four decimals, too few to compare with. Every "%.4f" of its
   prints becomes "%.9f"; nothing else changes. */
#define _GNU_SOURCE
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void widen(const char* from, char* to, size_t room) {
  size_t used = 0;
  for (; *from != '\0' && used + 1 < room; ++from) {
    to[used++] = strncmp(from, "4f", 2) == 0 && used > 1 && to[used - 1] == '.' ? '9' : *from;
  }
  to[used] = '\0';
}

int __fprintf_chk(FILE* stream, int flag, const char* format, ...) {
  char wide[1024];
  va_list arguments;
  (void)flag;
  widen(format, wide, sizeof wide);
  va_start(arguments, format);
  const int written = vfprintf(stream, wide, arguments);
  va_end(arguments);
  return written;
}

int __printf_chk(int flag, const char* format, ...) {
  char wide[1024];
  va_list arguments;
  (void)flag;
  widen(format, wide, sizeof wide);
  va_start(arguments, format);
  const int written = vprintf(wide, arguments);
  va_end(arguments);
  return written;
}
