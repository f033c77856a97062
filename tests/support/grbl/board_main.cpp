// A board of the Grbl class that is not there, for trying a gateway with --motion grbl:LINK. Its
// settings are those of deploy/examples/grbl/setup.toml.
//
//   grbl_board LINK    makes the link, a serial port; SIGTERM or SIGINT takes it away
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "tests/support/grbl/board_port.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: grbl_board LINK\n");
    return 2;
  }
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // the board's thread too
  const dripline::test_support::GrblBoardPort board(dripline::test_support::example_board());
  namespace fs = std::filesystem;
  std::error_code error;
  fs::remove(argv[1], error);  // of a board that was killed
  fs::create_symlink(board.path(), argv[1], error);
  if (error) {
    std::fprintf(stderr, "grbl_board: %s: %s\n", argv[1], error.message().c_str());
    return 1;
  }
  int signal = 0;
  sigwait(&ends, &signal);
  fs::remove(argv[1], error);
  return 0;
}
