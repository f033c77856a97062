#include "tests/support/program_generator.hpp"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace dripline::test_support {
namespace {

constexpr std::uint64_t kStepsPerPass = 2000;
constexpr double kPartLength = 5.5;  // inch
constexpr std::size_t kPieceBytes = 1 << 20;

/// Collects blocks into pieces, and counts both.
class BlockWriter {
 public:
  explicit BlockWriter(const TextSink& sink) : sink_(sink) {}
  ~BlockWriter() { flush(); }
  BlockWriter(const BlockWriter&) = delete;
  BlockWriter& operator=(const BlockWriter&) = delete;

  template <class... Args>
  void block(fmt::format_string<Args...> format, Args&&... args) {
    const std::size_t before = piece_.size();
    fmt::format_to(fmt::appender(piece_), format, std::forward<Args>(args)...);
    piece_.push_back('\n');
    bytes_ += piece_.size() - before;
    ++blocks_;
    if (piece_.size() >= kPieceBytes) flush();
  }
  std::uint64_t blocks() const { return blocks_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void flush() {
    sink_(std::string_view(piece_.data(), piece_.size()));
    piece_.clear();
  }
  const TextSink& sink_;
  fmt::memory_buffer piece_;
  std::uint64_t blocks_ = 0;
  std::uint64_t bytes_ = 0;
};

double profile_diameter(double z) {
  return 1.9 + 0.5 * std::sin(2.1 * z) + 0.2 * std::sin(7.3 * z + 1);
}

/// One block of the endless job: block 0 of a pass returns to the front, the others cut along the
/// profile.
void write_cut(BlockWriter& out, std::uint64_t index) {
  const std::uint64_t pass = index / kStepsPerPass;
  const std::uint64_t step = index % kStepsPerPass;
  const double allowance = 0.6 / static_cast<double>(1 + pass % 20);
  const double z = -kPartLength * static_cast<double>(step) / kStepsPerPass;
  if (step == 0) {
    out.block("G0 X3.2 Z0.1");
  } else if (step == 1) {
    out.block("G1 X{:.4f} Z{:.4f} F0.012", profile_diameter(z) + allowance, z);
  } else {
    out.block("X{:.4f} Z{:.4f}", profile_diameter(z) + allowance, z);
  }
}

void write_job(std::uint64_t max_blocks, std::uint64_t min_bytes, const TextSink& sink) {
  constexpr std::uint64_t kClosingBlocks = 2;
  BlockWriter out(sink);
  for (const char* line :
       {"O0200", "(WAVY SHAFT, EVERY PASS WRITTEN OUT)", "G20 G93 G99", "G97 S1200 M3"}) {
    out.block("{}", line);
  }
  for (std::uint64_t i = 0; out.blocks() + kClosingBlocks < max_blocks && out.bytes() < min_bytes;
       ++i) {
    write_cut(out, i);
  }
  out.block("G0 X3.2 Z0.5");
  out.block("M30");
}

}  // namespace

void write_contour(std::uint64_t blocks, const TextSink& sink) {
  write_job(blocks, std::numeric_limits<std::uint64_t>::max(), sink);
}

void write_contour_of_size(std::uint64_t bytes, const TextSink& sink) {
  constexpr std::uint64_t kClosing = sizeof("G0 X3.2 Z0.5\nM30\n") - 1;
  write_job(std::numeric_limits<std::uint64_t>::max(), bytes - kClosing, sink);
}

void write_report_program(std::uint64_t lines, std::uint64_t moves_per_line, const TextSink& sink) {
  BlockWriter out(sink);
  for (const char* line : {"O0300", "G20 G93 G98", "G0 X2 Z0", "POPEN P0", "P1=0", "N10 P1=P1+1"})
    out.block("{}", line);
  for (std::uint64_t i = 0; i < moves_per_line; ++i) {
    out.block("G1 X{:.3f} Z{:.3f} F50", 2.0 + 0.001 * static_cast<double>(i % 2),
              -0.001 * static_cast<double>(i % 7));
  }
  out.block("DPRNT [LINE #1[50]]");
  out.block("IF P1<{} GOTO 10", lines);
  out.block("PCLOS");
  out.block("M30");
}

}  // namespace dripline::test_support
