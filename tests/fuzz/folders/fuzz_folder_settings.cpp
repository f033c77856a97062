// The tables [[folder]] of a configuration, a NUL, and the name of a file. Properties: any table is
// read or refused with a text; a file gets a name that is one, or is refused with a text; what is
// printed of a name has no control characters.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "protocol/base/names.hpp"
#include "server/folders/name_rules.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto end = input.find('\0');
  const auto read = folders::read_folders(input.substr(0, end));
  if (!read && read.error().what.empty()) std::abort();
  const std::string name(end == std::string_view::npos ? std::string_view()
                                                       : input.substr(end + 1));
  const std::string shown = folders::printable_name(name);
  if (!folders::is_printable_name(shown) && shown.find('%') == std::string::npos) std::abort();
  for (const char c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/') std::abort();
  }
  if (!read) return 0;
  for (const auto& folder : *read) {
    const auto named = folders::name_program(folder, name, "anna");
    if (!named && named.error().what.empty()) std::abort();
    if (named && !named->is_ignored && !check_program_name(named->program)) std::abort();
  }
  return 0;
}
