// A cable between two serial ports that are not there: what goes into one link comes out of the
// other. For trying a serial machine on one computer; the quickstart does.
//
//   null_modem HOST CONTROL    makes both links; SIGTERM or SIGINT takes them away
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "tests/support/line/pty.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: null_modem HOST CONTROL\n");
    return 2;
  }
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // the cable's thread too
  const dripline::test_support::PtyCable cable;
  namespace fs = std::filesystem;
  std::error_code error;
  for (int i = 1; i < 3; ++i) {
    fs::remove(argv[i], error);  // of a cable that was killed
    fs::create_symlink(i == 1 ? cable.host() : cable.control(), argv[i], error);
    if (!error) continue;
    std::fprintf(stderr, "null_modem: %s: %s\n", argv[i], error.message().c_str());
    return 1;
  }
  int signal = 0;
  sigwait(&ends, &signal);
  for (int i = 1; i < 3; ++i) fs::remove(argv[i], error);
  return 0;
}
