#include "tests/load/process_use.hpp"

#include <unistd.h>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace dripline::load {

ProcessUse use_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const auto name_end = text.rfind(')');  // the name may hold blanks
  if (name_end == std::string::npos) return {};
  std::istringstream rest(text.substr(name_end + 1));
  std::vector<std::string> fields;
  for (std::string field; rest >> field;) fields.push_back(field);
  // proc(5): the state is field 3 and comes first here.
  constexpr std::size_t kState = 3, kUser = 14, kSystem = 15, kThreads = 20, kResident = 24;
  if (fields.size() <= kResident - kState) return {};
  const auto field = [&](std::size_t number) { return std::stoull(fields[number - kState]); };
  const auto ticks = static_cast<double>(field(kUser) + field(kSystem));
  return {.cpu_seconds = ticks / static_cast<double>(::sysconf(_SC_CLK_TCK)),
          .memory_bytes = field(kResident) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)),
          .threads = field(kThreads)};
}

}  // namespace dripline::load
