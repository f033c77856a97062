#include "clients/cli/text/error_output.hpp"

#include <cstdio>

namespace dripline::cli {

void write_error(std::string_view text) {
  std::fflush(stdout);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace dripline::cli
