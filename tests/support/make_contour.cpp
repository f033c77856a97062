// Writes a generated lathe contour to standard output: for the quickstart, benches and trials by
// hand.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/support/program_generator.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app{
      "Writes a Centurion lathe contour, every pass written out as short blocks, to standard "
      "output."};
  std::uint64_t blocks = 0;
  std::uint64_t bytes = 0;
  auto* by_blocks = app.add_option("--blocks", blocks, "exactly this many blocks");
  auto* by_bytes =
      app.add_option("--bytes", bytes, "at least this many bytes")->excludes(by_blocks);
  CLI11_PARSE(app, argc, argv);
  const auto print = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  };
  if (*by_bytes) {
    dripline::test_support::write_contour_of_size(bytes, print);
  } else {
    dripline::test_support::write_contour(blocks > 0 ? blocks : 200'000, print);
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "make_contour: %s\n", failure.what());
    return 1;
  }
}
