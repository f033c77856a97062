// A gateway's text about what its control keeps. Properties: it is understood or refused with a
// reason; what was understood can be given back as variables of a setup, which then reads as TOML
// and has no name twice, however often it is done.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "clients/cli/server/kept_memory.hpp"
#include "server/library/history/kept_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::cli;
  std::vector<std::string> texts;  // one a line
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line);) texts.push_back(line);
  const auto read = dripline::library::read_memory_texts(texts);
  if (!read && read.error().what.empty()) std::abort();
  std::map<std::string, double> variables;
  if (read) {
    for (const auto& [name, cell] : *read) {
      if (cell.value) variables[name] = *cell.value;
    }
  }
  const auto once = with_variables("", variables);
  if (!once || with_variables(*once, variables).value() != *once) std::abort();
  return 0;
}
