// The calls in a text of any control. The first byte chooses the control. Properties: short windows
// give the same calls as long ones, every call has a line of the text, and a refusal has a text.
#include <algorithm>
#include <cstdlib>

#include "gateway/interpreter/registry.hpp"

namespace {

using namespace dripline::interpreter;

/// Gives no more than was asked for.
class ShortWindows final : public ProgramSource {
 public:
  ShortWindows(std::string_view text, std::size_t most) : text_(text), most_(most) {}
  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    TextWindow window;
    window.state = TextWindow::State::Ready;
    const std::size_t from = std::min<std::size_t>(offset, text_.size());
    kept_ = std::string(text_.substr(from, std::max(min_bytes, most_)));
    window.text = kept_;
    window.reaches_end = from + kept_.size() == text_.size();
    return window;
  }
  ProgramLookup find(std::string_view) override { return {ProgramLookup::State::NotFound, 0}; }

 private:
  std::string_view text_;
  std::size_t most_;
  std::string kept_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Dialect& dialect = dialects()[data[0] % dialects().size()];
  const CallReader read_calls = call_reader(dialect.name);
  if (read_calls == nullptr) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  const Setup setup = parse_control_data("", dialect.units).value();
  ShortWindows whole(text, text.size() + 1), pieces(text, 1);
  const auto calls = read_calls(setup, whole, kMainProgram);
  const auto again = read_calls(setup, pieces, kMainProgram);
  if (calls.has_value() != again.has_value()) std::abort();
  if (!calls) return calls.error().what.empty() ? std::abort(), 0 : 0;
  if (calls->calls != again->calls || calls->contained != again->contained) std::abort();
  const auto lines = static_cast<std::uint64_t>(std::ranges::count_if(
                         text, [](char c) { return c == '\n' || c == '\r'; })) +
                     1;
  for (const ProgramCall& call : calls->calls) {
    if (call.line == 0 || call.line > lines) std::abort();
  }
  return 0;
}
