#include <fmt/core.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include "tests/differential/rs274ngc/peer.hpp"
#include "tests/differential/rs274ngc/program_maker.hpp"
#include "tests/support/temporary_folder.hpp"

/// Rows: NGC-082, NGC-083, NGC-084, NGC-085, NGC-086
///
/// Our profile `linuxcnc` beside the stand-alone interpreter of linuxcnc-uspace: the same moves to
/// a millionth of an inch, and the same programs refused. Skipped, with a word, where the peer is
/// not installed.
namespace dripline::differential {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-6 * 25.4;
constexpr std::uint64_t kPrograms = 1'000;

std::uint64_t number_of(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  return text == nullptr ? fallback : std::strtoull(text, nullptr, 10);
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The peer begins in millimeters, ours in the unit of the setup: a program that selects none
/// begins with G20, after its `%`.
std::string in_inches(std::string program) {
  for (const char* code : {"G20", "G21", "g20", "g21"}) {
    if (program.find(code) != std::string::npos) return program;
  }
  std::size_t at = program.find_first_not_of(" \t\r\n");
  at = at == std::string::npos || program[at] != '%' ? 0 : program.find('\n', at) + 1;
  return program.insert(at, "G20\n");
}

/// The README's list: with an arc after it the peer makes a move that its corners have eaten up,
/// backwards or nearly all around; we refuse it.
/// Of lathe cycles it makes moves through the contour; we refuse them before the first, but for the
/// one to the start.
bool is_listed(const Behavior& ours, const Behavior& peer) {
  const bool is_refused =
      ours.complaint.starts_with("NGC0282") || ours.complaint.starts_with("NGC0354");
  if (!is_refused || ours.moves.size() > peer.moves.size()) return false;
  Behavior beginning = peer;
  beginning.moves.resize(ours.moves.size());
  beginning.is_accepted = false;
  return difference(ours, beginning, kTolerance).empty();
}

/// The README's list: of arcs in a lathe cycle that are shorter than a thousandth the peer makes
/// some, others as lines or not at all, and we others.
bool is_tiny_arc_apart(const Behavior& ours, const Behavior& peer) {
  constexpr double kTiny = 1e-3 * 25.4;
  bool is_any = false;
  const auto without = [&is_any](const Behavior& behavior) {
    Behavior kept = behavior;
    kept.moves.clear();
    for (const Move& move : behavior.moves) {
      const bool is_arc = move.kind == Move::Kind::Arc && move.plane == 1;
      const bool is_tiny =
          !kept.moves.empty() && (is_arc || move.kind == Move::Kind::Feed) &&
          std::hypot(move.to[0] - kept.moves.back().to[0], move.to[1] - kept.moves.back().to[1],
                     move.to[2] - kept.moves.back().to[2]) <= kTiny;
      if (!is_tiny) kept.moves.push_back(move);
      is_any |= is_tiny && is_arc;
    }
    return kept;
  };
  return difference(without(ours), without(peer), kTiny).empty() && is_any;
}

struct Difference {
  std::string name;
  std::string what;
  std::string program;
};

/// Compares programs on every core; each worker has a folder of its own.
class Comparison {
 public:
  Comparison() { std::ofstream(folder_.path() / "tool.tbl") << tool_table(); }

  std::size_t listed() const { return listed_; }
  /// Programs that the peer does not end, or crashes with.
  std::size_t hung() const { return hung_; }

  /// `next` gives the programs one after the other, an empty name at the end.
  template <class Next>
  std::vector<Difference> run(Next next) {
    std::vector<std::thread> workers;
    const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
    for (unsigned i = 0; i < count; ++i) {
      workers.emplace_back([this, i, &next] {
        const fs::path own = folder_.path() / std::to_string(i);
        fs::create_directory(own);
        while (const auto program = next()) compare(program->first, program->second, own);
      });
    }
    for (std::thread& worker : workers) worker.join();
    std::sort(differences_.begin(), differences_.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return differences_;
  }

 private:
  void compare(const std::string& name, const std::string& text, const fs::path& own) {
    const fs::path file = own / "program.ngc";
    std::ofstream(file, std::ios::binary) << text;
    Behavior peer = run_peer(file, folder_.path() / "tool.tbl");
    Behavior ours = run_ours(text, "tests/differential/rs274ngc/programs");
    join_feeds(peer);
    join_feeds(ours);
    const std::string what = difference(ours, peer, kTolerance);
    if (what.empty()) return;
    const std::lock_guard lock(mutex_);
    if (peer.is_hung) {
      ++hung_;
      return;
    }
    if (is_listed(ours, peer) || is_tiny_arc_apart(ours, peer)) {
      ++listed_;
      return;
    }
    differences_.push_back({name, what, text});
  }

  test_support::TemporaryFolder folder_;
  std::mutex mutex_;
  std::vector<Difference> differences_;
  std::size_t listed_ = 0;
  std::size_t hung_ = 0;
};

void report(const std::vector<Difference>& differences) {
  const char* keep = std::getenv("DRIPLINE_KEEP_PROGRAMS");
  for (const Difference& each : differences) {
    ADD_FAILURE() << each.name << ": " << each.what;
    if (keep != nullptr) std::ofstream(fs::path(keep) / (each.name + ".ngc")) << each.program;
  }
}

using Program = std::optional<std::pair<std::string, std::string>>;

TEST(Rs274NgcPeer, DoesTheSameWithGeneratedPrograms) {
  if (!has_peer()) GTEST_SKIP() << "rs274 (Debian's linuxcnc-uspace) is not installed";
  const std::uint64_t first = number_of("DRIPLINE_FIRST", 1);
  const std::uint64_t count = number_of("DRIPLINE_PROGRAMS", kPrograms);
  std::atomic<std::uint64_t> next{first};
  Comparison comparison;
  report(comparison.run([&]() -> Program {
    const std::uint64_t number = next++;
    if (number >= first + count) return std::nullopt;
    return std::pair(fmt::format("{:06}", number), make_program(number));
  }));
  fmt::print("{} listed, {} hung\n", comparison.listed(), comparison.hung());
  EXPECT_LE(comparison.listed(), count / 100) << "more than a rare corner differs";
  EXPECT_LE(comparison.hung(), count / 200) << "of more than a rare one nothing is known";
}

TEST(Rs274NgcPeer, DoesTheSameWithOurPrograms) {
  if (!has_peer()) GTEST_SKIP() << "rs274 (Debian's linuxcnc-uspace) is not installed";
  std::vector<fs::path> files;
  const char* folder = std::getenv("DRIPLINE_COMPARE");
  const fs::path own = "tests/differential/rs274ngc/programs";
  for (const auto& entry : fs::directory_iterator(folder != nullptr ? fs::path(folder) : own)) {
    if (entry.path().extension() == ".ngc") files.push_back(entry.path());
  }
  std::atomic<std::size_t> next{0};
  Comparison comparison;
  report(comparison.run([&]() -> Program {
    const std::size_t at = next++;
    if (at >= files.size()) return std::nullopt;
    return std::pair(files[at].stem().string(), in_inches(read_file(files[at])));
  }));
  fmt::print("{} programs, {} listed, {} hung\n", files.size(), comparison.listed(),
             comparison.hung());
}

}  // namespace
}  // namespace dripline::differential
