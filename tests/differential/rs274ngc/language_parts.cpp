#include "tests/differential/rs274ngc/maker.hpp"

#include <fmt/core.h>
#include <array>

namespace dripline::differential {
namespace {

constexpr std::array kComparisons{"eq", "ne", "gt", "GE", "lt", "le"};
constexpr std::array kOperators{"+",  "-",   "*",  "/",  "mod", "and",
                                "or", "xor", "gt", "le", "eq",  "**"};

}  // namespace

std::string Maker::label() {
  return fmt::format("o{}", ++label_);
}

void Maker::loop() {
  const std::string o = label();
  const std::uint64_t counter = 1 + below(20);
  line(fmt::format("#{}={}", counter, below(3)));
  // Once it has passed over a break, the peer ends a do after its first pass.
  switch (has_break_ ? 2 * below(2) : below(4)) {
    case 0:
      line(fmt::format("{} while [#{} lt {}]", o, counter, 2 + below(5)));
      body(counter, o);
      line(fmt::format("{} endwhile", o));
      break;
    case 1:
      line(fmt::format("{} do", o));
      body(counter, "");  // a continue would give the peer's next repeat more passes
      line(fmt::format("{} while [#{} le {}]", o, counter, 1 + below(4)));
      break;
    case 2:
      line(fmt::format("{} repeat [{}]", o, below(4)));
      body(counter, "");
      line(fmt::format("{} endrepeat", o));
      break;
    default:
      line(fmt::format("{} while [#{} ne 5 and #{} lt 9]", o, counter, counter));
      body(counter, o);
      line(fmt::format("{} endwhile", o));
      break;
  }
  known_position();
}

void Maker::body(std::uint64_t counter, const std::string& loop_label) {
  line(fmt::format("#{}=[#{}+1]", counter, counter));
  line(fmt::format("G1 X[#{}/4] Y[SIN[#{}*15]]", counter, counter));
  if (!loop_label.empty() && below(3) == 0) {
    const std::string o = label();
    has_break_ = true;
    line(fmt::format("{} if [#{} eq {}]", o, counter, 2 + below(3)));
    line(fmt::format("{} {}", loop_label, below(2) == 0 ? "break" : "continue"));
    line(fmt::format("{} endif", o));
  }
  line(fmt::format("G0 Z[#{} mod 3]", counter));
}

void Maker::conditions() {
  const std::string o = label();
  line(fmt::format("#5={}", between(0, 4)));
  line(fmt::format("{} if [#5 {} {}]", o, one_of(kComparisons), below(4)));
  line("G0 X1.25");
  if (below(2) == 0) {
    line(fmt::format("{} elseif [#5 {} {}]", o, one_of(kComparisons), below(4)));
    line("G0 X1.5 Y2");
  }
  if (below(2) == 0) {
    line(fmt::format("{} else", o));
    line("G0 Y1.75");
  }
  line(fmt::format("{} endif", o));
  known_position();
}

/// What a subprogram's definition holds, its first and last line too.
std::string Maker::sub_text(const std::string& o) {
  std::string text = o + " sub\n#<depth>=[#1+#2/2]\nG1 X#1 Y#2\n";
  if (below(2) == 0) {
    const std::string inner = label();
    text += inner + " if [#3 gt 1]\n" + o + " return [#3*2]\n" + inner + " endif\n";
  }
  return text + "G1 Z[0-#<depth>/8]\n" + o + (below(2) == 0 ? " endsub [#1]\n" : " endsub\n");
}

/// Calls with up to three arguments, comments between some of them.
void Maker::call_some(const std::string& o) {
  const std::uint64_t calls = 1 + below(3);
  for (std::uint64_t i = 0; i < calls; ++i) {
    std::string words = o + " call";
    const std::uint64_t arguments = below(4);
    for (std::uint64_t k = 0; k < arguments; ++k) {
      words += fmt::format(" [{}]", text_of(between(0, 30'000)));
      if (below(8) == 0) words += " (next)";
    }
    line(words);
    if (below(2) == 0) line("G0 X[#<_value>/4] Y#1");
  }
}

std::string Maker::sub_label() {
  return below(3) == 0 ? fmt::format("o<part{}>", ++label_) : label();
}

void Maker::subprogram() {
  const std::string o = sub_label();
  text_ += sub_text(o);
  call_some(o);
  known_position();
}

/// Subprograms after the end of the main program: one, or several that call one another, or one
/// that M98 calls.
void Maker::later_subprogram() {
  const std::string o = sub_label();
  switch (below(6)) {
    case 0:
      fanuc_subprogram();
      return known_position();
    case 1: {
      const std::string inner = sub_label();
      later_ += o + " sub\nG0 Z#2\n" + inner + " call [#1] [1.5]\n" + o + " endsub [#<_value>]\n";
      later_ += sub_text(inner);
      break;
    }
    case 2:  // also before the main program's end, where it may not be met once called
      if (below(4) == 0) {
        call_some(o);
        text_ += sub_text(o);
        break;
      }
      [[fallthrough]];
    default:
      later_ += sub_text(o);
      break;
  }
  call_some(o);
  if (below(3) == 0) call_some(o);
  known_position();
}

/// Called by M98, ended by M99; now and then mixed with the other form.
void Maker::fanuc_subprogram() {
  const std::uint64_t number = static_cast<std::uint64_t>(++label_);
  const bool is_mixed = below(6) == 0;
  later_ += fmt::format("o{}{}\n", number, is_mixed && below(2) == 0 ? " sub" : "");
  later_ += "G91 G1 X0.25\nG90\n";
  later_ += is_mixed && below(2) == 0 ? fmt::format("o{} endsub\n", number) : "M99\n";
  if (is_mixed && below(3) == 0) return line(fmt::format("o{} call", number));
  line(fmt::format("M98 P{}{}", number, below(2) == 0 ? fmt::format(" L{}", 1 + below(3)) : ""));
}

std::string Maker::term(int depth) {
  if (depth == 0 || below(3) == 0) return text_of(between(1'000, 40'000));
  switch (below(9)) {
    case 0:
      return fmt::format("SIN[{}]", term(depth - 1));
    case 1:
      return fmt::format("ATAN[{}]/[{}]", term(depth - 1), term(depth - 1));
    case 2:
      return fmt::format("SQRT[ABS[{}]]", term(depth - 1));
    case 3:
      return fmt::format("{}[{}]", one_of(std::array{"FIX", "FUP", "ROUND"}), term(depth - 1));
    case 4:
      return fmt::format("-{}", text_of(between(1, 30'000)));
    case 5:
      return fmt::format("#<_local{}>", 1 + below(2));
    default:
      return fmt::format("[{} {} {}]", term(depth - 1), one_of(kOperators), term(depth - 1));
  }
}

void Maker::expressions() {
  line("#<_local1>=1.5 #<_local2>=-2.25");
  line(fmt::format("#31=[{} {} {}]", term(2), one_of(kOperators), term(2)));
  line("#32=[[#31 gt 2.5]*3] #31=2");
  line("G1 X#31 Y#32");
  const std::string o = label();
  line(fmt::format("#34=[{}]", term(3)));
  line(o + " if [ABS[#34] lt 100]");
  line("G1 Y#34");
  line(o + " endif");
  line("#33=5420 G0 Z[#33 MOD 3 + #5422/9]");
  known_position();
}

}  // namespace dripline::differential
