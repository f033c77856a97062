// Replays the seeds of a fuzz target: every line of the files named on the command line (see
// tests/fuzz/seeds for their form) goes through the target once.
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

[[noreturn]] void refuse(std::string_view line) {
  std::fprintf(stderr, "a seed with a wrong escape: %.60s\n", std::string(line).c_str());
  std::exit(2);
}

/// Takes the escape that `rest` begins with, after its backslash.
std::uint8_t take_escape(std::string_view& rest, std::string_view line) {
  if (rest.empty()) refuse(line);
  const char kind = rest.front();
  rest.remove_prefix(1);
  switch (kind) {
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
      return '\\';
    case 'x': {
      std::uint8_t byte = 0;
      const char* begin = rest.data();
      if (rest.size() < 2 || std::from_chars(begin, begin + 2, byte, 16).ptr != begin + 2) {
        refuse(line);
      }
      rest.remove_prefix(2);
      return byte;
    }
    default:
      refuse(line);
  }
}

std::vector<std::uint8_t> unescaped(std::string_view line) {
  std::vector<std::uint8_t> seed;
  for (std::string_view rest = line; !rest.empty();) {
    const char byte = rest.front();
    rest.remove_prefix(1);
    seed.push_back(byte == '\\' ? take_escape(rest, line) : static_cast<std::uint8_t>(byte));
  }
  return seed;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t replayed = 0;
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("token ")) continue;  // a word for the fuzzer's dictionary
      const auto seed = unescaped(line);
      LLVMFuzzerTestOneInput(seed.data(), seed.size());
      ++replayed;
    }
  }
  std::printf("replayed %zu inputs\n", replayed);
  return replayed > 0 ? 0 : 1;  // an empty corpus proves nothing
}
