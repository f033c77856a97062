#include <cstddef>
#include <cstdint>
#include <string_view>

#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"

namespace dripline::conversational {
namespace {

/// Any text becomes either a program of plain lines or an error with a text.
void read_and_post(std::string_view text) {
  const auto events = read_events(text);
  if (!events) {
    if (events.error().what.empty()) __builtin_trap();
    return;
  }
  for (const bool is_printed : {false, true}) {
    const auto program = post(*events, {is_printed});
    if (!program) {
      if (program.error().what.empty()) __builtin_trap();
      continue;
    }
    if (program->empty() || program->front() != 'O' || program->back() != '\n') __builtin_trap();
    for (const char c : *program) {
      if (c != '\n' && (c < ' ' || c > '~')) __builtin_trap();
    }
  }
}

}  // namespace
}  // namespace dripline::conversational

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dripline::conversational::read_and_post({reinterpret_cast<const char*>(data), size});
  return 0;
}
