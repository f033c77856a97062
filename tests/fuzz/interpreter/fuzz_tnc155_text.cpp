#include <cstddef>
#include <cstdint>
#include <string>

#include "clients/tools/program_editing/tnc155/whole_program.hpp"
#include "clients/tools/tnc_conversion/conversion.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/tnc155_trace.hpp"

namespace {

using namespace dripline::interpreter;
using namespace dripline::interpreter::tnc155;
using namespace dripline::tnc_conversion;
using dripline::program_editing::renumbered;

void insist(bool holds) {
  if (!holds) __builtin_trap();
}

/// A whole program, its blocks numbered, and its conversion do the same.
void check_conversion(const std::string& text, Form form) {
  const auto program = renumbered(text);
  if (!program) return;
  const auto there = convert_program(*program, form == Form::Plain ? Form::Iso : Form::Plain);
  if (!there) return;
  const std::string trace = tnc155_trace(*program);
  const std::string trace_there = tnc155_trace(*there);
  const bool is_cut_off = trace.ends_with("...") || trace_there.ends_with("...");
  insist(is_cut_off || trace_there == trace);  // the forms count blocks differently
}

}  // namespace

/// Any text is read or refused; what was written is read again to the same text; a conversion does
/// what the program did.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 4096) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto written = rewrite_program(text);
  if (!written || written->empty()) return 0;
  const auto again = rewrite_program(*written);
  insist(again && *again == *written);
  check_conversion(text, detect_form(text));
  return 0;
}
